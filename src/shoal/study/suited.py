"""Whether a scenario is one that its strategies were made for, told from what it says."""

import math
from collections.abc import Iterator
from typing import Any, get_type_hints

from shoal.core.units import Follows, Unit
from shoal.scenario.assumptions import airtime
from shoal.scenario.radios import RADIOS
from shoal.scenario.scales import Scales, scales_of
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice, following

FEW = 0.1  # of the spacing: a reach below it sees less than a thirtieth of what each agent has to watch
COLLIDING = 0.1  # of the reports: what collides less often than this is not said
FAR_OFF = 10.0  # times the default: where a parameter that was said no longer suits the scenario


def unsuited(scenario: Scenario) -> list[str]:
    """Return what is likely to be a mistake, in sentences: steps, reach, radio and lengths against each other."""
    scales = scales_of(scenario)
    choices = [scenario.strategy, *(fleet.strategy for fleet in scenario.fleets if fleet.strategy)]
    used = {fleet.strategy or scenario.strategy for fleet in scenario.fleets}
    lengths = [note for choice in dict.fromkeys(choices) if choice in used for note in _lengths(choice, scales)]
    return [*_steps(scenario, scales), *_distances(scenario, scales), *_channel(scenario), *lengths]


def _steps(scenario: Scenario, scales: Scales) -> Iterator[str]:
    reach = rounded(scales.reach)
    if scales.step > scales.reach:
        yield (
            f"the fastest agent goes {rounded(scales.step)} m in a time-step, farther than the {reach} m at which "
            f"targets are detected: it jumps over them; lower time_step below {rounded(scales.reach / scales.speed)} s"
        )
    target = max((getattr(each, "speed", None) or 0.0 for each in scenario.targets), default=0.0)
    if target * scenario.time_step > 2 * scales.reach:
        yield (
            f"a target goes {rounded(target * scenario.time_step)} m in a time-step, farther than across the {reach} m "
            "around an agent in which it is detected: it slips through unseen; lower time_step below "
            f"{rounded(2 * scales.reach / target)} s"
        )


def _distances(scenario: Scenario, scales: Scales) -> Iterator[str]:
    spacing, radio = rounded(scales.spacing), scenario.network.range
    if scales.reach < FEW * scales.spacing:
        seen = 100 * math.pi * (scales.reach / scales.spacing) ** 2
        yield (
            f"agents detect a target within {rounded(scales.reach)} m, but are {spacing} m apart if spread evenly: "
            f"together they see {seen:.2g} % of the area; is a sensor_radius missing, or are agents?"
        )
    if radio is not None and radio < scales.spacing:
        yield (
            f"the radio reaches {rounded(radio)} m, less than the {spacing} m between agents that are spread evenly: "
            "most hear nobody"
        )


def _channel(scenario: Scenario) -> Iterator[str]:
    """A channel that all agents share, and that has no room for all they say.

    Of messages sent at random times, a share of 1 - exp(-2 G) collides, G the share of the time that all take: pure
    ALOHA (Abramson, AFIPS Conf. Proc. 37, 1970, 281-285).
    """
    name, interval = scenario.network.radio, scenario.report_interval
    time = airtime(scenario)
    if name is None or time > interval:  # which is told as what cannot be sent
        return
    load = scenario.agents * time / interval
    taken = f"{scenario.agents} agents on one channel of {name} take {rounded(load)} of its time (channel_load)"
    mend = "take a longer network.interval, or count on more channels"
    collide = 1.0 - math.exp(-2.0 * load)
    if not RADIOS[name].listens and collide > max(COLLIDING, scenario.network.loss):
        yield (
            f"{taken}: of reports sent at random times {100 * collide:.0f} % would collide (pure ALOHA, 1 - exp(-2 G), "
            f"Abramson 1970), and no run loses any by that; say so by network.loss, {mend}"
        )
    elif RADIOS[name].listens and load > 1.0:
        yield f"{taken}: more than there is, and no run loses any report by that; {mend}"


def _lengths(choice: StrategyChoice, scales: Scales) -> Iterator[str]:
    """Parameters that were said and are far from what suits."""
    hints: dict[str, Any] = get_type_hints(choice.owner.params, include_extras=True)
    marks = following(choice.owner)
    for name in (each for each in choice.params if each not in choice.open):
        value, default = choice.params[name], choice.defaults[name]
        unit = next((each.symbol for each in getattr(hints[name], "__metadata__", ()) if isinstance(each, Unit)), "")
        if name in marks and value and default and not 1 / FAR_OFF <= value / default <= FAR_OFF:
            yield (
                f"strategy {choice.name}: {name} is {rounded(value)} {unit}; what suits a "
                f"{_and(marks[name], scales)} is about {rounded(default)} {unit}, its default; leave it out"
            )
        elif unit == "m" and name not in marks and value and not 0.01 <= abs(value) / scales.spacing <= 100:
            apart = rounded(scales.spacing)
            yield f"strategy {choice.name}: {name} is {rounded(value)} m, but agents are {apart} m apart"


def _and(follows: Follows, scales: Scales) -> str:
    return " and a ".join(f"{each} of {rounded(getattr(scales, each))} m" for each in dict.fromkeys(follows.lengths))


def rounded(value: float) -> str:
    """Three digits of a number: 0.501, 79.3, 1,420."""
    return f"{float(f'{value:.3g}'):,.0f}" if 1000 <= abs(value) < 1e9 else f"{value:.3g}"
