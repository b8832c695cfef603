"""What must be true of a fleet at every step, worked out from what was done to it and not from what it did."""

from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.tether import READINGS, Tick
from shoal.core.wire import wire_dtype

CONTENT = ("x", "y", "vx", "vy", "time", "id", "on_target")  # of what was said, and then what is told
_TIME = CONTENT.index("time")
_layout = cache(wire_dtype)
Floats = npt.NDArray[np.float64]


class BrokenInvariantError(AssertionError):
    """Something that must be true is not.

    Parameters
    ----------
    invariant : its name; detail : what was found instead
    """

    def __init__(self, invariant: str, detail: str) -> None:
        super().__init__(invariant, detail)
        self.invariant, self.detail = invariant, detail

    def __str__(self) -> str:
        return f"{self.invariant}: {self.detail}"


def demand(invariant: str, found: Any, wanted: Any) -> None:
    """Two things must be equal.

    Raises
    ------
    BrokenInvariantError : they are not
    """
    if found != wanted:
        raise BrokenInvariantError(invariant, f"{str(found)[:300]} instead of {str(wanted)[:300]}")


def demand_array(invariant: str, found: Any, wanted: Any) -> None:
    """Two arrays must be equal.

    Raises
    ------
    BrokenInvariantError : they are not
    """
    if not np.array_equal(found, wanted):
        raise BrokenInvariantError(invariant, f"{str(found)[:300]} instead of {str(wanted)[:300]}")


def together(ticks: Iterable[Tick]) -> Any:
    """The readings of several ticks as one array of tether.READINGS."""
    return np.frombuffer(b"".join([tick.readings.tobytes() for tick in ticks]), READINGS)


def truths(said: list[bytes], readings: Any, steps: list[int], told: tuple[str, ...], time_step: float) -> list[bytes]:
    """What reports say, as numbers in the order of CONTENT, which must be what instruments do, at their steps.

    Parameters
    ----------
    said : n reports; readings : (n,) of tether.READINGS, of those who said them; steps : by the clock of each
    told : names of the fields that reports tell; time_step : [s]

    Raises
    ------
    BrokenInvariantError : another content or another time
    """
    kind = _layout(told)
    demand("every report has its size", {len(each) for each in said}, {kind.itemsize})
    rows = np.frombuffer(b"".join(said), kind)
    found = np.array([*(rows[name] for name in CONTENT), *(rows["told"][name] for name in told)]).T.copy()
    demand_array("reports say when", np.round(found[:, _TIME] / time_step, 6), np.array(steps, float))
    true = np.array([found[:, _TIME] if name == "time" else readings[name] for name in CONTENT]).T
    demand_array("reports say what instruments do", found[:, : len(CONTENT)], true)
    numbers, size = found.tobytes(), found.itemsize * found.shape[1]
    return [numbers[begin : begin + size] for begin in range(0, len(numbers), size)]
