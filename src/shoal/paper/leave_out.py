"""What the best of several choices gains, without the luck of the best: seeds are judged by what the others chose."""

import numpy as np

from shoal.paper.curves import Floats


def best_gain(options: Floats, base: Floats) -> Floats:
    """Gain of the best of P options over a base in every seed, (R,).

    The option of a seed is the one whose mean over the other seeds is highest: the highest mean of all would be partly
    luck, as an estimate of what it gains.

    Parameters
    ----------
    options : (R, P) a number of each seed under each option
    base : (R,) the number to compare with
    """
    seeds = len(options)
    if seeds < 2:
        return np.full(seeds, np.nan)
    others = (options.sum(axis=0) - options) / (seeds - 1)
    gain: Floats = options[np.arange(seeds), others.argmax(axis=1)] - base
    return gain


def best_place(options: Floats) -> int:
    """Which option has the highest mean, among P of them, (R, P)."""
    return int(options.mean(axis=0).argmax())
