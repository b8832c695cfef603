"""A body without a vehicle: a point that goes as it is told and knows its place exactly, to try a buoy on a desk."""

import math
import time
from collections.abc import Callable

from shoal.buoy.detector import Detector, no_detector
from shoal.buoy.errors import BodyError
from shoal.buoy.fence import Fence, fence_of, kept_inside
from shoal.core.messages import Reading
from shoal.core.text import quoted
from shoal.scenario.schema import Scenario

STRIDE = 0.2  # [s] at most between two cuts at the fence, as a vehicle hears set-points
HORIZON = 3.0  # [s] for which a vehicle goes on with what it was told last


class SimulatedBody:
    """A point in still water. It takes the velocity that it is told at once: what a buoy says is within its limits.

    It stays inside the fence, and stops when nobody calls `go` for `silence` seconds, as a vehicle does.

    Parameters
    ----------
    x, y : where it begins [m]
    fence : where it may be, and its top speed
    detector : what says whether a target is there
    silence : [s] without a command after which it stops
    clock : [s], never goes back
    """

    def __init__(
        self,
        x: float,
        y: float,
        fence: Fence,
        *,
        detector: Detector = no_detector,
        silence: float = 3.0,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._x, self._y, self._vx, self._vy = x, y, 0.0, 0.0
        self._wanted = (0.0, 0.0)
        self._fence, self._detector, self._silence, self._clock = fence, detector, silence, clock
        self._now = self._told_at = clock()

    def read(self) -> Reading:
        """Where it is and how it moves, and whether the detector has a target."""
        self._advance()
        return Reading(self._x, self._y, self._vx, self._vy, bool(self._detector(self._x, self._y)))

    def go(self, vx: float, vy: float) -> None:
        """Go with this velocity [m/s] until told otherwise, as far as the fence permits.

        Raises
        ------
        BodyError : it is not finite; the point stops
        """
        self._advance()
        finite = math.isfinite(vx) and math.isfinite(vy)
        self._told_at = self._now
        self._wanted = (float(vx), float(vy)) if finite else (0.0, 0.0)
        self._steer()
        if not finite:
            raise BodyError("velocity", f"({vx}, {vy}) is not finite", "say it in m/s; the point was stopped")

    def stop(self) -> None:
        """Stop, until the next `go`."""
        self.go(0.0, 0.0)

    def close(self) -> None:
        """Stop for good."""
        self.stop()

    def _advance(self) -> None:
        """Go on until now, in strides, but no longer than it heeds what it was told."""
        now, until = self._clock(), self._told_at + self._silence
        while self._now < min(now, until) and self._wanted != (0.0, 0.0):
            self._steer()
            stride = min(STRIDE, min(now, until) - self._now)
            self._x, self._y = self._x + self._vx * stride, self._y + self._vy * stride
            self._now += stride
        if now > until:
            self._wanted = (0.0, 0.0)
            self._steer()
        self._now = now

    def _steer(self) -> None:
        """Take the velocity that is wanted, cut at the fence."""
        still = self._wanted == (0.0, 0.0)
        self._vx, self._vy = (0.0, 0.0) if still else kept_inside(self._fence, self._x, self._y, *self._wanted, HORIZON)


def open_simulated_body(text: str, scenario: Scenario, id: int, *, detector: Detector | None = None) -> SimulatedBody:
    """Return the body that begins at a place.

    Parameters
    ----------
    text : X,Y [m] within the fence; nothing: on a circle around the middle, all agents evenly
    scenario : where the fence is
    id : number of the agent
    detector : default: no target is ever there

    Raises
    ------
    BodyError : no place within the fence
    ScenarioError : no such agent
    """
    fence = fence_of(scenario, id)
    try:
        x, y = map(float, text.split(",")) if text else _on_a_circle(fence, id / scenario.agents)
    except ValueError:
        raise BodyError("--body", f"{quoted(text)} is no place", "write simulated:X,Y [m], or simulated") from None
    if not (math.isfinite(x) and math.isfinite(y)) or fence.outside(x, y) > 0.0:
        problem = f"{x:g}, {y:g} m is outside the fence"
        raise BodyError("--body", problem, "write simulated:X,Y with a place on the water, inside the arena's margin")
    return SimulatedBody(x, y, fence, detector=detector or no_detector, silence=2.0 * scenario.time_step + 1.0)


def _on_a_circle(fence: Fence, turns: float) -> tuple[float, float]:
    radius = 0.5 * min(fence.half_x, fence.half_y)
    return radius * math.sin(2 * math.pi * turns), radius * math.cos(2 * math.pi * turns)
