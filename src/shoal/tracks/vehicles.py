"""Whether a column tells vehicles apart, judged by where its values go and not by its name."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.tracks.ground import steps
from shoal.tracks.numbers import number
from shoal.tracks.table import Fixes, Labels

MOST_VALUES = 60_000
FEWEST_PER_VALUE = 2.0  # fixes, on average
FEWEST_OF_ATTRIBUTE = 6.0  # a course has many values, of few fixes each
STANDS_OUT = 3.0  # a step between two vehicles is so many times longer, and faster, than nearly all of their own
NEARLY_ALL = 0.9
MUCH_LONGER = 5.0  # the joined path, than all of their own
ZIGZAG = 0.75  # two steps take a vehicle nearly twice as far as one; jumping to and fro, they lead back
LOOKED_AT = 1000  # values


def tells_vehicles_apart(fixes: Fixes, label: Labels, *, attribute: bool = False) -> bool:
    """Return whether each value of a column has a track of its own, apart from the others.

    Joined in the order of time, several vehicles jump to and fro: the steps from one value to another are longer
    and faster than those that each value makes by itself, and two of them lead back to where they began; or all of
    them together are much longer than the paths of each value. Vehicles
    one after the other make one long step each. A status, a course or a part of one trip does neither.

    Parameters
    ----------
    fixes : of all values
    label : the column
    attribute : whether its name says something else; then it must be plain that it tells vehicles apart
    """
    codes, own_codes = np.unique(label.codes, return_inverse=True)
    filled = np.array([bool(label.values[code]) for code in codes], np.bool_)
    rows = filled[own_codes]
    values = int(filled.sum())
    fewest = FEWEST_OF_ATTRIBUTE if attribute else FEWEST_PER_VALUE
    if not 2 <= values <= MOST_VALUES or values * fewest > rows.sum() or _is_measured(label, codes):
        return False
    order = np.flatnonzero(rows)[np.argsort(fixes.unix[rows], kind="stable")]
    track = fixes.where(order)
    value = own_codes[order].astype(np.uint16)
    meters, seconds = steps(track)
    switches = value[1:] != value[:-1]
    grouped = np.argsort(value, kind="stable")
    own = value[grouped][1:] == value[grouped][:-1]
    own_meters, own_seconds = (each[own] for each in steps(track.where(grouped)))
    if not own.any():
        return False
    is_far = _stands_out(meters[switches], own_meters)
    is_fast = _stands_out(_speed(meters, seconds)[switches], _speed(own_meters, own_seconds))
    if int(switches.sum()) == values - 1:  # one after the other
        return is_far and (is_fast or not attribute)
    is_long = meters.sum() > MUCH_LONGER * own_meters.sum() + 1.0
    return ((is_far and is_fast) or bool(is_long)) and _straightness(track) < ZIGZAG


def _is_measured(label: Labels, codes: NDArray[Any]) -> bool:
    """Whether the values are numbers with decimals: a temperature is not a name."""
    numbers = np.array([number(label.values[code]) for code in codes[:LOOKED_AT]])
    return bool(np.any(numbers[np.isfinite(numbers)] % 1.0 > 0.0))


def _speed(meters: NDArray[np.float64], seconds: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(meters / np.maximum(seconds, 1.0))


def _stands_out(switches: NDArray[np.float64], own: NDArray[np.float64]) -> bool:
    return bool(np.median(switches) > max(STANDS_OUT * float(np.quantile(own, NEARLY_ALL)), 1.0))


def _straightness(track: Fixes) -> float:
    """How far two steps lead, of how far they go: 1 on a line, 0 to and fro."""
    meters, _ = steps(track)
    two = [steps(track.where(np.arange(start, len(track.unix), 2)))[0].sum() for start in (0, 1)]
    return float(sum(two) / max(np.sum(meters[1:] + meters[:-1]), 1e-9))
