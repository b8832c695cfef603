"""A recorded track, and where its target is between two fixes."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, eq=False)  # arrays have no single answer to ==; compare digests
class Track:
    """A recorded target path, cleaned, in local meters."""

    time: NDArray[np.float64]  # (F,) [s] since the first kept fix, strictly increasing
    x: NDArray[np.float64]  # (F,) [m] east of origin
    y: NDArray[np.float64]  # (F,) [m] north of origin
    origin: tuple[float, float]  # (lon, lat) [deg] of local (0, 0)
    start: str  # ISO 8601 UTC time of the first fix
    max_gap: float  # [s] longer silence between two fixes means that the target is absent
    notes: tuple[str, ...]  # what was dropped or assumed, one sentence each
    digest: str  # sha256 hex over time, x, y bytes and max_gap


def position_at(track: Track, t: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return where the target is at `t` [s], and whether it is present.

    p(t) = p_i + (p_i+1 - p_i) (t - t_i) / (t_i+1 - t_i)     for t_i <= t <= t_i+1

    It is absent before the first fix, after the last one, and between two fixes more than
    `track.max_gap` apart; at a fix it is always present.

    Returns
    -------
    (x, y, present) : [m], [m], bool, each of the shape of `t`; x and y are NaN where absent.
    """
    t = np.asarray(t, dtype=np.float64)
    time = track.time
    before = np.clip(np.searchsorted(time, t, side="right") - 1, 0, len(time) - 2)
    after = before + 1
    recorded = (time[0] <= t) & (t <= time[-1])
    heard = time[after] - time[before] <= track.max_gap
    at_fix = (t == time[before]) | (t == time[after])
    present = recorded & (heard | at_fix)
    x = np.where(present, np.interp(t, time, track.x), np.nan)
    y = np.where(present, np.interp(t, time, track.y), np.nan)
    return x, y, np.asarray(present)
