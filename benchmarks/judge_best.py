"""Whether the recommended strategy is best, or tied for best, under every condition of a suite.

    shoal compare cordon encircle charged-pso knn-pso --suite arena-wide --out wide --json > wide.json
    python benchmarks/judge_best.py wide.json

Under each condition, the paired difference of the recommended strategy from every other that is not told the truth; all
p of all files together are corrected by Holm. Prints a row of Markdown per condition with the best of the others, and
the mean over the conditions. Exit code 1 if any other is better (adjusted p < 0.05).
"""

import json
import sys
from pathlib import Path

import numpy as np

from shoal.experiments.comparison import Values, compare
from shoal.experiments.paired import SIGNIFICANT
from shoal.metrics.summary import Bounds
from shoal.strategies import RECOMMENDED


def read(files: list[Path]) -> dict[str, Values]:
    """The values of each run of each strategy that is not informed, by condition; a later file adds what is new."""
    found: dict[str, Values] = {}
    for file in files:
        for condition in json.loads(file.read_text())["conditions"]:
            rows = [each for each in condition["strategies"] if not each["informed"]]
            found.setdefault(condition["name"], {each["strategy"]: np.array(each["runs"], float) for each in rows})
    return found


def _told(p: float | None) -> str:
    return "" if p is None else "< 0.001" if p < 0.001 else f"{p:.3f}"


def main() -> int:
    """Print the table; 1 if another is better anywhere."""
    found = read([Path(name) for name in sys.argv[1:]])
    judged = compare({name: ({}, values) for name, values in found.items()}, RECOMMENDED, (), bounds=Bounds(0.0, 1.0))
    beaten = 0
    print(f"| condition | {RECOMMENDED} | best of the others | | minus it | adjusted p | |")
    print("| --- | ---: | --- | ---: | ---: | ---: | --- |")
    for condition in judged.conditions:
        ours = condition.of(RECOMMENDED)
        others = [each for each in condition.standings if each.strategy != RECOMMENDED]
        best = max(others, key=lambda each: each.value.mean)
        beats = [
            each for each in others if (each.adjusted_p or 0.0) < SIGNIFICANT and each.value.mean > ours.value.mean
        ]
        beaten += bool(beats)
        gap, p = best.difference, best.adjusted_p
        sign = "second" if beats else "first" if p is not None and p < SIGNIFICANT else "tied"
        difference = "" if gap is None else f"{-gap.mean:+.4f}"
        print(
            f"| {condition.name} | {ours.value.mean:.4f} | {best.strategy} | {best.value.mean:.4f} | {difference} | "
            f"{_told(p)} | {sign} |"
        )
    names = {each.strategy for each in judged.conditions[0].standings}
    shared = [name for name in names if all(name in values for values in found.values())]
    for name in sorted(shared, key=lambda each: -np.mean([np.mean(values[each]) for values in found.values()])):
        print(f"{name}: mean of {len(found)} conditions {np.mean([np.mean(v[name]) for v in found.values()]):.4f}")
    print(f"{judged.tests} comparisons; beaten under {beaten} conditions")
    return int(beaten > 0)


if __name__ == "__main__":
    sys.exit(main())
