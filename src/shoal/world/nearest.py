"""How far each of some listeners must hear to hear its k nearest: a count and a guess, again and again.

Any reach between the squares of the k-th and the (k+1)-th distance serves, and neighborhoods change slowly, so that the
last step's is a good first guess. `square` are squared distances [m^2] from speakers (rows) to listeners (lanes).
"""

import numpy as np

from shoal.compiler.kernel import kernel
from shoal.compiler.lanes import almost_one, any_of, either, farthest, larger, narrow, smaller, take, wide

_ROUNDS = 40


@kernel
def reach_of(square, rows, i, wanted, reach):
    """The squares of how far the listeners from i on must hear, as many as `reach` has lanes.

    Where the k-th and the next are equally far, they hear more or fewer. A reach steps over the one speaker by which it
    is off; where it is off by more, it is estimated: counts grow like the square of the distance. An estimate stays
    inside the bracket found so far, which is bisected after a few rounds.

    wanted : k of each; reach : a first guess
    """
    zero = 0.0 * wanted
    low, high, shrunk = zero, farthest(reach), almost_one(reach)
    for attempt in range(_ROUNDS):
        heard, below, above = count_within(square, rows, i, reach, zero)
        low = either(heard < wanted, above, low)
        high = either(heard > wanted, below, high)
        stepped = either(heard < wanted, above, below * shrunk)
        middle = 0.5 * (below + smaller(above, 4.0 * below))
        reach = either(heard == wanted, middle, stepped)
        missing = wanted - heard
        far_off = (missing * missing > 1.0) & (low < high)
        if not any_of(far_off):
            break
        fewer, more = low * ((wanted + 0.5) / (heard + 1.5)), high * ((wanted + 0.5) / (heard - 0.5))
        guess = either(heard < wanted, fewer, more)
        half = 0.5 * (low + smaller(high, 4.0 * low))
        if attempt > 3:
            guess = half
        guess = either((guess < low) | (guess >= high), half, guess)
        reach = either(far_off, guess, reach)
    return reach


@kernel
def square_between(x, y, to_x, to_y, single):
    """The square of a distance [m^2]; as it is in single precision, if that is asked for."""
    if single:
        short_x, short_y = narrow(x) - narrow(to_x), narrow(y) - narrow(to_y)
        return wide(short_x * short_x + short_y * short_y)
    dx, dy = x - to_x, y - to_y
    return dx * dx + dy * dy


@kernel
def count_within(square, rows, i, reach, zero):
    """How many speakers are within reach of the listeners from i on; the farthest of them, the nearest beyond."""
    heard, below, above = zero, zero, zero + np.inf
    for j in range(rows):
        d = take(square, (j, i), reach)
        inside = d <= reach
        heard = either(inside, heard + 1.0, heard)
        below = larger(below, either(inside, d, 0.0))
        above = smaller(above, either(inside, np.inf, d))
    return heard, below, above


@kernel
def settle_tie(square, rows, i, k, reach):
    """Listener i's reach, moved to its k-th distance; of those at it, the surplus is put out, highest indices first."""
    while True:
        within = 0
        equal = 0
        farthest = -1.0
        second = -1.0
        beyond = np.inf
        for j in range(rows):
            d = square[j, i]
            if not d <= reach:
                beyond = min(beyond, d)
                continue
            within += 1
            if d > farthest:
                second = farthest
                farthest = d
                equal = 1
            elif d == farthest:
                equal += 1
            elif d > second:
                second = d
        if within < k and beyond < np.inf:
            reach = beyond
        elif within - equal >= k and second >= 0.0:
            reach = second
        else:
            break
    surplus = within - k
    for j in range(rows - 1, -1, -1):
        if surplus > 0 and square[j, i] == farthest:
            square[j, i] = np.inf
            surplus -= 1
    return reach
