"""What is large and what is long in a scenario: the lengths that defaults of strategies follow.

The published strategies were made for one scenario, the paper's: 50 agents in 20 m x 20 m, up to 2.6 m/s fast, that
detect a target within 1 m and decide every 0.1 s. A parameter that is marked `Follows` has its default there, and
elsewhere as many times that as its length is longer.

Each is known before the swarm leaves: the speed of a target is not, so no default follows it.
"""

import math
from typing import TYPE_CHECKING, NamedTuple

from shoal.core.units import Follows, Range

if TYPE_CHECKING:
    from shoal.scenario.schema import Scenario


class Scales(NamedTuple):
    """Lengths of a scenario [m], and the speed [m/s] that makes times of them.

    spacing : sqrt(width x height / N), N the agents that it starts with: side of the square that each has to watch
    reach : how far away the middle of the smallest target is when it is detected, the mean over these agents
    step : how far the fastest agent goes in a time-step
    speed : top speed of the fastest agent; a time follows a length by the time that it takes for it
    """

    spacing: float
    reach: float
    step: float
    speed: float

    def ratio(self, follows: Follows, symbol: str) -> float:
        """Return how many times the paper's a quantity in m or s is here.

        follows : which lengths; symbol : SI unit of the quantity, "m" or "s"
        """
        first, *others = (self._times(length, symbol) for length in follows.lengths)
        mean = math.prod(each / first for each in others) ** (1 / len(follows.lengths))  # 1 where all are alike
        return first * mean

    def _times(self, length: str, symbol: str) -> float:
        here, there = getattr(self, length), getattr(PAPER, length)
        return float((here / self.speed) / (there / PAPER.speed) if symbol == "s" else here / there)


PAPER = Scales(spacing=math.sqrt(20.0 * 20.0 / 50), reach=1.0, step=2.6 * 0.1, speed=2.6)


def scales_of(scenario: "Scenario") -> Scales:
    """Return the lengths of a scenario. One whose agents reach nothing at all has the spacing for a reach."""
    fleets, agents = scenario.fleets, sum(fleet.count for fleet in scenario.fleets)
    spacing = math.sqrt(scenario.area.width * scenario.area.height / agents)
    sensors = sum(fleet.count * fleet.sensor_radius for fleet in fleets) / agents
    speed = max(fleet.max_speed for fleet in fleets)
    return Scales(
        spacing=spacing,
        reach=sensors + min(target.radius for target in scenario.targets) or spacing,
        step=speed * scenario.time_step,
        speed=speed,
    )


def followed(default: float, follows: Follows, symbol: str, allowed: Range | None, scales: Scales) -> float:
    """Return what a default is in a scenario, within what is allowed.

    Parameters
    ----------
    default : in the paper's scenario, in the unit `symbol`
    allowed : the parameter's range, if it has one
    """
    value = default * scales.ratio(follows, symbol)
    return min(max(value, allowed.least), allowed.most) if allowed else value
