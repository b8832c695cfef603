"""The k nearest of those who spoke, for several listeners at once.

It calls no other kernel, so that numba by itself notices when this file is another.
"""

import numpy as np

from shoal.compiler.kernel import entry_kernel


@entry_kernel
def link_nearest(near, ids, readings, speakers, numbers, most, reaches):
    """Set `near` to whom each listener hears: the k nearest of the others that reach it, ties to the first.

    near : (n, k, 2) rows of the speakers, ascending, and how many of them are nearer; -1: no more
    ids, most : (n,) who listens, and its k; readings : (n, 8) where
    speakers : (m,) who spoke; numbers : (m, 5) from where
    reaches : (n, m) whose words reach whom; of no rows: everybody's
    """
    square, order = np.empty(near.shape[1]), np.empty(near.shape[1], np.int64)
    for n in range(ids.size):
        x, y, count = readings[n, 0], readings[n, 1], 0
        for m in range(speakers.size):
            if speakers[m] == ids[n] or (reaches.shape[0] > 0 and not reaches[n, m]):
                continue
            dx, dy = x - numbers[m, 0], y - numbers[m, 1]
            far = dx * dx + dy * dy
            if count < most[n]:
                count += 1
            elif count == 0 or far >= square[count - 1]:
                continue
            place = count - 1  # the farthest makes room, if there was none
            while place > 0 and far < square[place - 1]:
                square[place], order[place] = square[place - 1], order[place - 1]
                place -= 1
            square[place], order[place] = far, m
        for rank in range(count):
            place = rank
            while place > 0 and near[n, place - 1, 0] > order[rank]:
                near[n, place, 0], near[n, place, 1] = near[n, place - 1, 0], near[n, place - 1, 1]
                place -= 1
            near[n, place, 0], near[n, place, 1] = order[rank], rank
