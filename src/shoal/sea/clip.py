"""A ring clipped to a box, so that even-odd filling inside the box is as before."""

import numpy as np
from numpy.typing import NDArray

Ring = NDArray[np.float64]


def clipped(ring: Ring, low: NDArray[np.float64], high: NDArray[np.float64]) -> Ring:
    """Return the closed ring inside a box, (0, 2) if there is nothing; parts are joined along the sides of the box.

    Sutherland and Hodgman, "Reentrant polygon clipping", Communications of the ACM 17, 1974.

    Parameters
    ----------
    ring : (n, 2), closed
    low, high : (2,) corners of the box
    """
    if (ring.max(axis=0) < low).any() or (ring.min(axis=0) > high).any():
        return ring[:0]
    for axis in (0, 1):
        for bound, sign in ((low[axis], 1.0), (high[axis], -1.0)):
            ring = _half_plane(ring, axis, bound, sign)
            if not len(ring):
                return ring
    return ring


def _half_plane(ring: Ring, axis: int, bound: float, sign: float) -> Ring:
    """The part where sign * (ring[:, axis] - bound) >= 0."""
    depth = sign * (ring[:, axis] - bound)
    inside = depth >= 0.0
    if inside.all():
        return ring
    if not inside.any():
        return ring[:0]
    start, end = ring[:-1], ring[1:]
    crosses = inside[:-1] != inside[1:]
    length = np.where(crosses, depth[:-1] - depth[1:], 1.0)
    meets = start + (depth[:-1] / length)[:, None] * (end - start)
    meets[:, axis] = bound
    both = np.stack((meets, end), axis=1)  # after each start: where the edge crosses, then its end
    kept = both[np.stack((crosses, inside[1:]), axis=1)]
    return np.concatenate((kept, kept[:1]))
