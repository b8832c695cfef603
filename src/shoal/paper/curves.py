"""From rows of runs to curves, and from curves to numbers with intervals: means, slopes, differences, peaks."""

import math
import zlib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.experiments.rows import Row
from shoal.metrics.heading_bearing import CENTERS
from shoal.metrics.summary import ANYTHING, METRICS, Bounds, bounds_of
from shoal.paper.peaks import tops
from shoal.paper.plan import AGENTS
from shoal.record.statistics import estimate, inside, t_quantile

Floats = npt.NDArray[np.float64]
Measured = str | Callable[[Row], float]  # a column, or a number made of a row

DRAWS = 2000  # bootstrap
FEW = 4  # with fewer seeds the spread is pooled over cases
_SEED = 2020
_BLOCK = 4  # neighboring points whose residuals stay together: with shared chance they are correlated
_SMALLEST = 1e-3  # error of a curve's points, relative to its range: equal runs are not infinitely sure


class Interval(NamedTuple):
    """A number and its 95 % interval; NaN bounds where it cannot be determined."""

    value: float
    low: float
    high: float

    def times(self, factor: float) -> "Interval":
        """In another unit; `factor` is positive."""
        return Interval(*(factor * number for number in self))


@dataclass(frozen=True)
class RunCurve:
    """A metric at places x (K,) in each seed's run (R, K). Column k of two curves shares its chance run by run."""

    x: Floats
    runs: Floats
    bounds: Bounds = ANYTHING

    @property
    def mean(self) -> Floats:
        """Over seeds, (K,)."""
        mean: Floats = self.runs.mean(axis=0)
        return mean

    def intervals(self) -> list[Interval]:
        """Student's t over seeds, at every place."""
        return [_interval(values, self.bounds) for values in self.runs.T]

    def at(self, x: float) -> Floats:
        """The runs at one place, (R,).

        Raises
        ------
        KeyError : the curve has no such place
        """
        places = np.flatnonzero(self.x == x)
        if not places.size:
            raise KeyError(x)
        values: Floats = self.runs[:, places[0]]
        return values

    def between(self, low: float, high: float) -> "RunCurve":
        """The part with low <= x <= high."""
        inside = (self.x >= low) & (self.x <= high)
        return RunCurve(self.x[inside], self.runs[:, inside], self.bounds)

    def minus(self, other: "RunCurve") -> "RunCurve":
        """The paired difference at the places that both have."""
        x, mine, its = np.intersect1d(self.x, other.x, return_indices=True)
        seeds = min(len(self.runs), len(other.runs))
        return RunCurve(x, self.runs[:seeds, mine] - other.runs[:seeds, its])


@dataclass(frozen=True)
class Peak:
    """Where a curve is highest and how high; `draws` are the bootstrap's places, for differences between peaks."""

    place: Interval
    height: Interval
    draws: Floats
    at_edge: bool


def curve(rows: Iterable[Row], metric: Measured, along: str = "neighbors", **where: object) -> RunCurve:
    """Return a metric over the field `along`, of the finished runs whose fields have the values `where`.

    Only seeds that every place has are kept, so that columns pair.
    """
    cells: dict[float, dict[int, float]] = {}
    for row in rows:
        if row.get("status", "done") == "done" and all(row.get(name) == value for name, value in where.items()):
            value = row[metric] if isinstance(metric, str) else metric(row)
            cells.setdefault(float(row[along]), {})[row["run"]] = float(value)
    x = sorted(cells)
    seeds = sorted(set.intersection(*(set(cell) for cell in cells.values()))) if cells else []
    runs = np.array([[cells[at][seed] for at in x] for seed in seeds]).reshape(len(seeds), len(x))
    return RunCurve(np.array(x), runs, bounds_of(metric, agents=AGENTS) if metric in METRICS else ANYTHING)


def heading_there(row: Row) -> float:
    """Agents in the last two bins of phi, from 0.7 on."""
    return float(np.sum(np.array(row["phi_histogram"])[CENTERS > 0.7]))


def heading_nowhere(row: Row) -> float:
    """Agents in the middle bin of phi."""
    return float(row["phi_histogram"][len(CENTERS) // 2])


def cells(rows: Iterable[Row], metric: Measured) -> list[Floats]:
    """The values in all seeds of each combination of fast, neighbors and target_speed that has two or more."""
    found: dict[tuple[object, ...], list[float]] = {}
    for row in rows:
        if row.get("status", "done") == "done":
            value = row[metric] if isinstance(metric, str) else metric(row)
            found.setdefault((row["fast"], row["neighbors"], row["target_speed"]), []).append(value)
    return [np.array(values) for values in found.values() if len(values) > 1]


def values_of(rows: Iterable[Row], field: str) -> list[float]:
    """The values of a field, each once, sorted."""
    return sorted({row[field] for row in rows if row.get(field) is not None})


def intervals(cases: Sequence[Floats], bounds: Bounds = ANYTHING) -> list[Interval]:
    """Mean and 95 % interval of each case from its values in the seeds, (R,).

    From four seeds on by each case's own spread (Student's t, R - 1 degrees of freedom). A spread of two or three
    values says next to nothing (t = 12.7 for two), so then it is pooled over all cases of as many seeds, which supposes
    that they are about equally noisy. On 30 seeds of 20,000 steps, paired differences over k: pairs of seeds covered
    the truth in 94 % of cases, but k = 2, noisier than the rest, in as few as 50 %.
    """
    found = []
    for values, degrees in zip(cases, degrees_of_freedom(cases), strict=True):
        if degrees == len(values) - 1 or len(values) < 2:
            found.append(_interval(values, bounds))
            continue
        alike = [other for other in cases if len(other) == len(values)]
        spread = math.sqrt(float(np.mean([np.var(other, ddof=1) for other in alike])))
        half = t_quantile(degrees) * spread / math.sqrt(len(values))
        mean = float(values.mean())
        found.append(Interval(mean, *inside(mean, half, bounds)))
    return found


def degrees_of_freedom(cases: Sequence[Floats]) -> list[int]:
    """Of the t in each of the `intervals`."""
    sizes = [len(values) for values in cases]
    return [(sizes.count(size) if 2 <= size < FEW else 1) * (size - 1) for size in sizes]


def slopes(of: RunCurve) -> Floats:
    """Least-squares slope over x of every seed's curve, (R,)."""
    centered = of.x - of.x.mean()
    slope: Floats = of.runs @ centered / (centered @ centered)
    return slope


def peak(of: RunCurve, draws: int = DRAWS) -> Peak:
    """Return the place and the height of a curve's maximum, by draws from the smooth curves that fit it (peaks.tops).

    Near its top a curve is flat, so the highest point is largely luck: its place varies by one k between repetitions of
    five seeds. Noise is a bootstrap over seeds in blocks: a made-up seed's residuals (its curve less the mean curve)
    are blocks of 4 neighboring points, each from a random seed and place, enlarged by sqrt(R / (R - 1)). It is the same
    for all curves of one shape, so that differences of their peaks are paired. Of 500 made-up curves of each of the
    paper's shapes, from 3 or 5 seeds, 93 % or more had the true place in their interval (tests/paper/test_peaks.py).
    """
    return _peak(of.x.tobytes(), of.runs.tobytes(), of.runs.shape, draws)


@lru_cache(maxsize=1024)  # several claims ask for the same peak, which takes a tenth of a second
def _peak(x: bytes, runs: bytes, shape: tuple[int, int], draws: int) -> Peak:
    of = RunCurve(np.frombuffer(x), np.frombuffer(runs).reshape(shape))
    seeds, places = shape
    if places < 4 or seeds == 0:
        return Peak(_UNKNOWN, _UNKNOWN, np.full(draws, np.nan), at_edge=False)
    error, noise = _errors(of.runs, draws)
    chance = np.random.default_rng([_SEED, zlib.crc32(of.runs.tobytes())])  # how curves bend is not shared by two
    found = tops(of.x, of.mean, error, noise, chance)
    at_edge = found.place in (of.x[0], of.x[-1])
    if seeds == 1:
        unknown = np.full(draws, np.nan)
        return Peak(_around(found.place, unknown), _around(found.height, unknown), unknown, at_edge)
    heights = found.heights.clip(*of.bounds)
    return Peak(_around(found.place, found.places), _around(found.height, heights), found.places, at_edge)


def peak_difference(one: Peak, other: Peak) -> Interval:
    """How much further along the first peak lies."""
    return _around(one.place.value - other.place.value, one.draws - other.draws)


def bootstrap(values: npt.ArrayLike, statistic: Callable[..., Floats]) -> Interval:
    """Return statistic(values, axis=-1) with its interval over independent values."""
    sample = np.asarray(values, float)
    if sample.size < 2:
        return Interval(float(sample[0]) if sample.size else math.nan, math.nan, math.nan)
    drawn = np.random.default_rng(_SEED).choice(sample, (DRAWS, sample.size))
    return _around(float(statistic(sample, axis=-1)), statistic(drawn, axis=-1))


_UNKNOWN = Interval(math.nan, math.nan, math.nan)


def _interval(values: Floats, bounds: Bounds) -> Interval:
    known = estimate(values, bounds=bounds)
    return Interval(known.mean, *(known.ci95 or (math.nan, math.nan)))


def _around(value: float, draws: Floats) -> Interval:
    low, high = np.quantile(draws, (0.025, 0.975))
    return Interval(float(value), float(low), float(high))


def _errors(runs: Floats, draws: int) -> tuple[float, Floats]:
    """Standard error of a point, and mean errors of made-up sets of seeds, (draws, K).

    What all points of a seed share moves no peak: it is not part of the error, but of the draws.
    """
    seeds, places = runs.shape
    if seeds == 1:  # from how far points lie off the line between their neighbors
        off = runs[0, 1:-1] - (runs[0, 2:] + runs[0, :-2]) / 2
        return float(np.median(np.abs(off))) or _SMALLEST, np.zeros((1, places))
    residuals = (runs - runs.mean(axis=0)) * math.sqrt(seeds / (seeds - 1))
    shared = residuals.mean(axis=1, keepdims=True)
    own = residuals - shared
    error = math.sqrt(float((own**2).sum()) / (seeds * (places - 1) * seeds))
    smallest = _SMALLEST * max(float(np.ptp(runs.mean(axis=0))), _SMALLEST)
    rng = np.random.default_rng(_SEED)  # fixed: the report repeats bit by bit
    shape = (draws, seeds, -(-places // _BLOCK))
    who, begin = rng.integers(seeds, size=shape), rng.integers(places, size=shape)
    at = (begin[..., np.newaxis] + np.arange(_BLOCK)) % places
    drawn = own[who[..., np.newaxis], at].reshape(draws, seeds, -1)[:, :, :places].mean(axis=1)
    noise: Floats = drawn + shared[rng.integers(seeds, size=(draws, seeds))].mean(axis=1)
    return max(error, smallest), noise
