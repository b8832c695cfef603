"""How often the 95 % intervals of `shoal run` hold what they promise, on the paper's run.

    python benchmarks/bench_coverage.py [--scenario oceans2020] [--steps 2000 20000] [--runs 300 100] [--long 1000000]

For every metric: of one run's intervals (by batch means), the share that hold the mean of runs of this length, and the
share that hold the long-run mean, which a short run misses by its start; how wide they are, beside 1.96 standard
deviations of the runs; and of intervals over 3, 5 and 20 runs, drawn at random from all, the share that hold the mean
of runs of this length. 93-97 % is the aim. tests/record/test_coverage.py holds a shorter run to it.
"""

import argparse
import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from shoal.metrics.summary import METRICS
from shoal.metrics.tally import Tally
from shoal.record.record import Record
from shoal.record.statistics import estimate
from shoal.run.simulate import simulate
from shoal.scenario.edit import apply
from shoal.scenario.load import read_table, scenario_from

REPLICATES = (3, 5, 20)
DRAWS = 2000
BURN_IN = 20_000  # steps of a long run that are left out


class Coverage(NamedTuple):
    """Of one metric: shares of intervals that hold the truth (NaN: none was told), and widths.

    told : share of runs that tell an interval; own, long_run : by batch means of one run
    width : its median half, over 1.96 standard deviations of the runs; replicates : of 3, 5 and 20 runs
    """

    told: float
    own: float
    long_run: float
    width: float
    replicates: tuple[float, ...]


def runs_of(scenario: str, steps: int, runs: int, seed: int = 777) -> Record:
    """So many runs."""
    return simulate(scenario_from(apply(read_table(scenario), {"steps": steps, "seed": seed})), runs=runs)


def long_run(scenario: str, steps: int) -> dict[str, float]:
    """Mean of each metric over so many steps, in runs whose first batches are left out."""
    length = 10 * BURN_IN  # of 20 batches: two are left out
    record = runs_of(scenario, length, max(1, steps // length), seed=99)
    late = [
        Tally._make(part[2:] if part.shape[0] == tally.steps.size else part for part in tally)
        for tally in record.tallies
    ]
    return {
        name: float(np.mean([metric.formula(tally, record.facts) for tally in late]))
        for name, metric in METRICS.items()
    }


def coverage(name: str, record: Record, truth: float = math.nan) -> Coverage:
    """Measure one metric on runs of one length."""
    values, bounds = (
        np.array([METRICS[name].formula(tally, record.facts) for tally in record.tallies]),
        record.bounds(name),
    )
    known = np.flatnonzero(np.isfinite(values))
    own = float(values[known].mean())
    single = [replace(record, tallies=(record.tallies[run],)).estimate(name) for run in known]
    told = np.array([each.ci95 for each in single if each.ci95]).reshape(-1, 2)
    deviation = float(values[known].std(ddof=1))
    rng = np.random.default_rng(1)
    several = [
        [estimate(rng.choice(values[known], size, replace=False), bounds=bounds).ci95 for _ in range(DRAWS)]
        for size in REPLICATES
    ]
    return Coverage(
        len(told) / known.size,
        _held(told, own),
        _held(told, truth) if math.isfinite(truth) else math.nan,
        float(np.median(told[:, 1] - told[:, 0]) / 2 / (1.96 * deviation)) if len(told) and deviation > 0 else math.nan,
        tuple(_held(np.array([each for each in found if each]).reshape(-1, 2), own) for found in several),
    )


def _held(intervals: np.ndarray, truth: float) -> float:
    return float(np.mean((intervals[:, 0] <= truth) & (truth <= intervals[:, 1]))) if len(intervals) else math.nan


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenario", default="oceans2020")
    parser.add_argument("--steps", type=int, nargs="+", default=[2000, 20_000])
    parser.add_argument("--runs", type=int, nargs="+", default=[300, 100])
    parser.add_argument("--long", type=int, default=1_000_000)
    asked = parser.parse_args()
    truth = long_run(asked.scenario, asked.long)
    for steps, runs in zip(asked.steps, asked.runs, strict=True):
        print_table(f"{asked.scenario}, {runs} runs of {steps:,} steps", runs_of(asked.scenario, steps, runs), truth)


def print_table(title: str, record: Record, truth: dict[str, float]) -> None:
    """One row per metric."""
    print(
        f"{title}\n{'':18}{'told':>6}{'mean':>7}{'long':>7}{'width':>7}"
        + "".join(f"{size:5d} runs" for size in REPLICATES)
    )
    for name in METRICS:
        found = coverage(name, record, truth[name])
        cells = [f"{value:7.3f}" if math.isfinite(value) else f"{'-':>7}" for value in found[1:4]]
        several = [f"{value:10.3f}" if math.isfinite(value) else f"{'-':>10}" for value in found.replicates]
        print(f"{name:18}{found.told:6.2f}{''.join(cells)}{''.join(several)}", flush=True)


if __name__ == "__main__":
    main()
