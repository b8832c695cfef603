"""What is written where a field says nothing: over gaps in time, beside the shore, on land."""

import numpy as np
from numpy.typing import NDArray

Values = NDArray[np.float32]
Mask = NDArray[np.bool_]

BESIDE = ((0, 1), (0, -1), (1, 0), (-1, 0))
ACROSS = ((1, 1), (1, -1), (-1, 1), (-1, -1))


def bridge_gaps(u: Values, v: Values, time: NDArray[np.float64]) -> tuple[Mask, float]:
    """Fill, in place, nodes that are known at some times: linearly in time, constant at both ends.

    Parameters
    ----------
    u, v : (T, J, I), NaN where missing
    time : (T,) [s]

    Returns
    -------
    unknown : (J, I) nodes that are missing at all times
    share : of the values at the other nodes, those that were missing
    """
    known = np.isfinite(u) & np.isfinite(v)
    unknown: Mask = np.logical_not(known.any(axis=0))
    partly = ~unknown & ~known.all(axis=0)
    if not partly.any():
        return unknown, 0.0
    there = known[:, partly]
    steps = np.arange(len(time))[:, None]
    before = np.maximum.accumulate(np.where(there, steps, -1), axis=0)
    after = np.minimum.accumulate(np.where(there, steps, len(time))[::-1], axis=0)[::-1]
    before, after = np.where(before < 0, after, before), np.where(after == len(time), before, after)
    length = time[after] - time[before]
    weight = np.where(length > 0.0, (time[:, None] - time[before]) / np.where(length > 0.0, length, 1.0), 0.0)
    for field in (u, v):
        part = field[:, partly]
        low, high = np.take_along_axis(part, before, axis=0), np.take_along_axis(part, after, axis=0)
        field[:, partly] = (1.0 - weight) * low + weight * high
    return unknown, float((~there).sum() / (known[:, ~unknown].size or 1))


def fill_fringe(u: Values, v: Values, unknown: Mask) -> None:
    """Fill unknown nodes in place: next to the sea by the mean of the nearest known nodes, elsewhere by 0.

    A bilinear value between a known node and the shore is then that of the sea, not half of it.

    Parameters
    ----------
    u, v : (T, J, I), finite but where unknown
    unknown : (J, I)
    """
    for field in (u, v):
        field[:, unknown] = 0.0
    j, i = np.nonzero(unknown)
    todo = np.ones(len(j), dtype=bool)
    padded = np.pad(~unknown, 1)
    for directions in (BESIDE, ACROSS):
        known = np.stack([padded[j + 1 + dj, i + 1 + di] for dj, di in directions]) & todo
        count = known.sum(axis=0)
        for field in (u, v):
            total = np.zeros((field.shape[0], len(j)))
            for there, (dj, di) in zip(known, directions, strict=True):
                total[:, there] += field[:, j[there] + dj, i[there] + di]
            near = count > 0
            field[:, j[near], i[near]] = total[:, near] / count[near]
        todo &= count == 0
