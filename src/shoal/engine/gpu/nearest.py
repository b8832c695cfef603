"""The k nearest of one agent, by the thread that decides for it: what world/neighbors.py does for all lanes at once."""

from typing import Any

import numba.cuda

_device: Any = numba.cuda.jit(device=True)  # numba has no types that mypy sees
FARTHEST = 1e300
_ABOVE, _BELOW = 1.0 + 2.0**-52, 1.0 - 2.0**-52
_FEW = 4  # speakers to step over; with more missing, a guess is nearer
_ROUNDS = 20


@_device
def measure(square, x, y, own_x, own_y, agents, i):
    """Fill the squared distances (R, 1) from agent i to all; nobody is in rows that are there for an even number."""
    for j in range(agents):
        dx = own_x - x[j]
        dy = own_y - y[j]
        square[j, 0] = dx * dx + dy * dy
    for j in range(agents, square.shape[0]):
        square[j, 0] = float("inf")
    square[i, 0] = float("inf")


@_device
def find_reach(square, reach, k, agents):
    """A reach within which k are, near a first guess; more or fewer if the k-th and the next are equally far."""
    if k >= agents - 1:
        return FARTHEST
    missing = k - _count(square, reach, agents)
    for _ in range(_ROUNDS):
        if abs(missing) <= _FEW:
            break
        reach *= (k + 0.5) / (k - missing + 0.5)  # counts grow like the square of the distance
        missing = k - _count(square, reach, agents)
    sign = 1.0 if missing > 0 else -1.0  # step to the next one beyond, or from the last one within: one loop for both
    for _ in range(abs(missing)):
        first = reach * _ABOVE if missing > 0 else -reach
        found = FARTHEST
        for j in range(agents):
            d = sign * square[j, 0]
            found = d if d >= first and d < found else found
        reach = found if missing > 0 else -found * _BELOW
    return reach


@_device
def _count(square, reach, agents):
    """How many are within reach."""
    count = 0
    for j in range(agents):
        count += 1 if square[j, 0] <= reach else 0
    return count
