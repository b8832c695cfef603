"""shoal design against every fleet of a coarse grid: how much of the grid's front it finds, for how many steps.

    python benchmarks/bench_design.py [--out FOLDER] [--steps 1500] [--runs 2] [--trials 60] [--seeds 1 2 3]

The grid has 1 to 30 fast buoys at 3, 1 to 45 slow ones at 1, and five degrees k: 6,750 fleets, each run as often and as
long as a trial of the design, whose steps are all counted: sampler, random search, final table. The fronts that both
report, the grid's by its own means and the design's by its final table, are then run again on seeds that neither has
seen, and their hypervolumes are compared; reference point: the grid's highest cost, and no time on target. `strict` is
a harder yardstick: the best of all that anything here reports and of the next two layers behind the grid's front,
chosen by the judge's own runs, which flatters it. What is in FOLDER is not run again.
The bar: >= 98 % of the grid's hypervolume for <= 5 % of its steps.
"""

import argparse
import tempfile
import time
from pathlib import Path

import numpy as np

from shoal.experiments.design import Design
from shoal.experiments.executors import in_threads
from shoal.experiments.front import front, hypervolume
from shoal.experiments.sweep import sweep
from shoal.study.design import design

FAST, SLOW, DEGREES = range(1, 31), range(1, 46), (4, 13, 22, 31, 40)
PRICES = {"fleets.BoB-1.cost": 3, "fleets.BoB-0.cost": 1}
JUDGE_SEED, JUDGE_RUNS, LAYERS = 987_654, 20, 3
WORST = 3 * FAST[-1] + SLOW[-1], 0.0


def main():
    """Print what both found."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path)
    for name, default in (("steps", 1500), ("runs", 2), ("trials", 60), ("final-runs", 6), ("jobs", 1)):
        parser.add_argument(f"--{name}", type=int, default=default)
    parser.add_argument("--seeds", type=int, nargs="+", default=[1, 2, 3])
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        compare(asked, asked.out or Path(spare))


def compare(asked, folder):
    """Run grid, designs and judge; what is in the folder is not run again."""
    begun = time.perf_counter()
    rows = sweep(Design("oceans2020", grid(), asked.runs), folder / "grid", executor=in_threads(asked.jobs),
                 changes={"steps": asked.steps, "seed": asked.seeds[0], **PRICES})  # fmt: skip
    costs, values, at = by_point(rows)
    steps = len(rows) * asked.steps
    told("grid", f"{len(at):,} different fleets, {steps:,} steps, {time.perf_counter() - begun:.0f} s")
    layers, left = [], list(range(len(at)))
    for _ in range(LAYERS):
        best = [left[each] for each in front(costs[left], values[left])]
        layers.append([at[each] for each in best])
        left = [each for each in left if each not in set(best)]
    found = {seed: designed(asked, folder, seed) for seed in asked.seeds}
    own = {seed: [full(each.point) for each in result.front] for seed, result in found.items()}
    strict = [point for points in (*layers, *own.values()) for point in points]
    judged = sweep(Design("oceans2020", tuple(strict), JUDGE_RUNS), folder / "judge", executor=in_threads(asked.jobs),
                   changes={"steps": asked.steps, "seed": JUDGE_SEED, **PRICES})  # fmt: skip
    of_grid, of_all = area(judged, layers[0]), area(judged, strict)
    told(
        "grid", f"front of {len(layers[0])} fleets, hypervolume {of_grid:.4f}, {100 * of_grid / of_all:.2f} % of strict"
    )
    for seed, result in found.items():
        of_design, share = area(judged, own[seed]), result.steps / steps
        told(f"design, seed {seed}", f"front of {len(own[seed])} fleets, hypervolume {of_design:.4f}: "
             f"{100 * of_design / of_grid:.2f} % of the grid's for {100 * share:.2f} % of its steps, "
             f"{100 * of_design / of_all:.2f} % of strict: "
             f"bar {'met' if of_design >= 0.98 * of_grid and share <= 0.05 else 'not met'}")  # fmt: skip


def designed(asked, folder, seed):
    """The design of one seed."""
    begun = time.perf_counter()
    found = design("oceans2020", {"BoB-1": (0, 30, 3), "BoB-0": (0, 45, 1)}, {"neighbors": (4, 40)},
                   trials=asked.trials, runs=asked.runs, final_runs=asked.final_runs, jobs=asked.jobs,
                   out=folder / f"design-{seed}", steps=asked.steps, seed=seed).result  # fmt: skip
    areas = found.hypervolumes
    told(f"design, seed {seed}", f"{found.steps:,} steps, {time.perf_counter() - begun:.0f} s; sampler's front has "
         f"{areas['sampler'] / areas['random']:.2f} times the hypervolume of the random search's")  # fmt: skip
    return found


def grid():
    """Every fleet once; more neighbors than others are the same as all others."""
    points = {}
    for fast in FAST:
        for slow in SLOW:
            for k in DEGREES:
                point = counts(fast, slow, min(k, fast + slow - 1))
                points.setdefault(str(point), point)
    return tuple(points.values())


def counts(fast, slow, k):
    """A point of a sweep."""
    return {"fleets.BoB-1.count": fast, "fleets.BoB-0.count": slow, "neighbors": k}


def full(point):
    """A point of a design, as the judge's sweep has it."""
    return counts(point["fleets.BoB-1.count"], point["fleets.BoB-0.count"], point.get("neighbors", 20))


def by_point(rows):
    """Cost and mean time on target of every point, (P,) each, and the points."""
    known = {}
    for row in rows:
        point = counts(*(row[name] for name in counts(0, 0, 0)))
        known.setdefault(str(point), (point, row["cost"], []))[2].append(row["time_on_target"])
    points, prices, values = zip(*known.values(), strict=True)
    return np.array(prices), np.array([np.mean(each) for each in values]), list(points)


def area(rows, chosen):
    """Hypervolume of some points by the judge's runs, as a share of all that could be."""
    costs, values, at = by_point(rows)
    wanted = {str(each) for each in chosen}
    own = [number for number, each in enumerate(at) if str(each) in wanted]
    assert len(own) == len(wanted)
    return hypervolume(costs[own], values[own], WORST) / WORST[0]


def told(name, text):
    """Print a line."""
    print(f"{name:>16}  {text}", flush=True)


if __name__ == "__main__":
    main()
