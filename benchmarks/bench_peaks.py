"""How often the 95 % interval of a peak's place covers the true one, on made-up curves like the paper's.

    python benchmarks/bench_peaks.py [--curves 500] [--draws 2000]

Each curve is a smooth one plus noise as the paper's runs have it: 0.29 % from seed to seed, a third of its variance
shared by all points of a seed. The shapes are those that a review of Shoal tried (its own simulator, smoothed) and the
published curves of the predecessor; the places are those of `shoal reproduce`. tests/paper/test_peaks.py holds 93 %.
"""

import argparse
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.interpolate import make_smoothing_spline

from shoal.paper import plan
from shoal.paper.curves import RunCurve, peak, peak_difference
from shoal.paper.published import NEIGHBORS, PUBLISHED

DEVIATION, SHARED = 0.0029, 0.3
_AT = (2, 10, 13, 16, 18, 20, 22, 24, 26, 28, 30, 34, 40, 49)
_TIME_ON_TARGET = {
    "mixed, 3 m/s": (.55, .767, .80, .823, .835, .8375, .833, .817, .795, .773, .757, .708, .653, .564),
    "all slow, 3 m/s": (.5, .715, .742, .758, .768, .777, .784, .785, .776, .752, .725, .681, .62, .55),
    "mixed, 5 m/s": (.5, .685, .71, .728, .7315, .7310, .7295, .727, .721, .711, .698, .658, .598, .508),
}  # fmt: skip
SHAPES: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    **{name: make_smoothing_spline(np.array(_AT, float), np.array(y), lam=2.0) for name, y in _TIME_ON_TARGET.items()},
    **{
        f"published {name.replace('_', ' ')}": make_smoothing_spline(np.array(NEIGHBORS, float), np.array(y), lam=0.5)
        for name, y in PUBLISHED.items()
    },
}
PLACES = {
    "full": plan._NEIGHBORS,
    "quick": plan._NEIGHBORS_QUICK,
    "variants": plan._SENSITIVITY_NEIGHBORS,
    "variants, quick": plan._SENSITIVITY_NEIGHBORS_QUICK,
}


class Coverage(NamedTuple):
    """Share of intervals that hold the truth, their median width, and mean error of the value."""

    share: float
    width: float
    bias: float


def true_peak(shape: str) -> float:
    """The place where a shape is highest."""
    fine = np.linspace(2.0, 49.0, 9401)
    return float(fine[SHAPES[shape](fine).argmax()])


def made_up(shape: str, places: str, seeds: int, curves: int, chance: int = 11) -> list[RunCurve]:
    """Noisy curves of a shape; those of two shapes share their noise if their `chance` is the same."""
    x = np.array(PLACES[places], float)
    rng = np.random.default_rng(chance)
    shared, own = rng.normal(size=(curves, seeds, 1)), rng.normal(size=(curves, seeds, x.size))
    noise = DEVIATION * (SHARED**0.5 * shared + (1 - SHARED) ** 0.5 * own)
    return [RunCurve(x, runs) for runs in SHAPES[shape](x) * (1 + noise)]


def place_coverage(shape: str, places: str, seeds: int, curves: int, draws: int) -> Coverage:
    """How often the interval of the place holds the true one."""
    found = [peak(each, draws).place for each in made_up(shape, places, seeds, curves)]
    return _coverage(found, true_peak(shape))


def difference_coverage(shape: str, other: str, places: str, seeds: int, curves: int, draws: int) -> Coverage:
    """How often the interval of a difference of places holds the true one; the curves pair seed by seed."""
    pairs = zip(*(made_up(each, places, seeds, curves) for each in (shape, other)), strict=True)
    found = [peak_difference(peak(one, draws), peak(two, draws)) for one, two in pairs]
    return _coverage(found, true_peak(shape) - true_peak(other))


def _coverage(found: list, truth: float) -> Coverage:
    value, low, high = np.array(found).T
    return Coverage(
        float(np.mean((low <= truth) & (truth <= high))), float(np.median(high - low)), float(np.mean(value)) - truth
    )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--curves", type=int, default=500)
    parser.add_argument("--draws", type=int, default=2000)
    asked = parser.parse_args()
    print(f"{'shape':28}{'k of':18}{'seeds':>5}{'covered':>9}{'width':>7}{'bias':>7}")
    for places in PLACES:
        for seeds in (2, 3, 5):
            for shape in SHAPES:
                _print(shape, places, seeds, place_coverage(shape, places, seeds, asked.curves, asked.draws))
            pair = ("all slow, 3 m/s", "mixed, 3 m/s")
            _print(
                "all slow - mixed", places, seeds, difference_coverage(*pair, places, seeds, asked.curves, asked.draws)
            )


def _print(shape: str, places: str, seeds: int, known: Coverage) -> None:
    print(f"{shape:28}{places:18}{seeds:5d}{known.share:9.3f}{known.width:7.2f}{known.bias:+7.2f}", flush=True)


if __name__ == "__main__":
    main()
