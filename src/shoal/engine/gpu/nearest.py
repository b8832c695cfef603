"""The k nearest of one agent, by the thread that decides for it: what world/neighbors.py does for all lanes at once.

Loops on a card count by themselves: numba's `range` costs as much there as what such a loop does.
"""

from typing import Any

import numba.cuda

_device: Any = numba.cuda.jit(device=True)  # numba has no types that mypy sees
FARTHEST = 1e300
_ABOVE, _BELOW = 1.0 + 2.0**-52, 1.0 - 2.0**-52
_FEW = 4  # speakers to step over; with more missing, a guess is nearer
_ROUNDS = 20


@_device
def measure(square, x, y, own_x, own_y, agents, i):
    """Fill the squared distances (R, 1) from agent i to all; nobody is in a row that is there for an even number."""
    j = 0
    while j < agents:
        dx = own_x - x[j]
        dy = own_y - y[j]
        square[j, 0] = dx * dx + dy * dy
        j += 1
    if j < square.shape[0]:
        square[j, 0] = float("inf")
    square[i, 0] = float("inf")


@_device
def find_reach(square, reach, k, agents):
    """A reach within which k are, near a first guess; more or fewer if the k-th and the next are equally far."""
    if k >= agents - 1:
        return FARTHEST
    missing = k - _count(square, reach, agents)
    attempt = 0
    while attempt < _ROUNDS and abs(missing) > _FEW:
        reach *= (k + 0.5) / (k - missing + 0.5)  # counts grow like the square of the distance
        missing = k - _count(square, reach, agents)
        attempt += 1
    sign = 1.0 if missing > 0 else -1.0  # step to the next one beyond, or from the last one within: one loop for both
    steps = abs(missing)
    while steps > 0:
        first = reach * _ABOVE if missing > 0 else -reach
        found = FARTHEST
        j = 0
        while j < agents:
            d = sign * square[j, 0]
            found = d if d >= first and d < found else found
            j += 1
        reach = found if missing > 0 else -found * _BELOW
        steps -= 1
    return reach


@_device
def _count(square, reach, agents):
    """How many are within reach."""
    count = 0
    j = 0
    while j < agents:
        count += 1 if square[j, 0] <= reach else 0
        j += 1
    return count
