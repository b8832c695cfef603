"""Tune strategies for all conditions of a suite, with one budget for each: a rival untuned is no rival.

    python benchmarks/tune_rivals.py --out rivals encircle charged-pso knn-pso > rivals.txt
    shoal compare cordon encircle charged-pso knn-pso --suite arena-wide --json $(cat rivals.txt) > wide.json

Each number among the parameters is looked for between 0.3 and 3 times its default, as far as allowed, words among all
words; lengths and times follow the scenario, as defaults do. The seed of the search is none of a suite. Prints what
`shoal compare` takes, `--set encircle.ring=0.9`, and on stderr what was gained.
"""

import argparse
import sys
from typing import Any, get_type_hints

import shoal
from shoal.core.units import Choice, Range
from shoal.experiments.suite import read_suite
from shoal.strategies import CATALOGUE


def ranges(name: str) -> dict[str, Any]:
    """Return where each parameter of a strategy is looked for."""
    params: Any = CATALOGUE[name].params
    found: dict[str, Any] = {}
    for field, hint in get_type_hints(params, include_extras=True).items():
        marks = getattr(hint, "__metadata__", ())
        words = next((each.words for each in marks if isinstance(each, Choice)), None)
        allowed = next((each for each in marks if isinstance(each, Range)), None)
        default = params._field_defaults[field]
        if words:
            found[f"strategy.{field}"] = list(words)
        elif isinstance(default, float) and default > 0.0:
            low, high = 0.3 * default, 3.0 * default
            if allowed:
                low, high = max(low, allowed.least), min(high, allowed.most)
            found[f"strategy.{field}"] = (low, high)
    return found


def main() -> None:
    """Tune one strategy after the other."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("strategies", nargs="+")
    parser.add_argument("--suite", default="arena-wide")
    parser.add_argument("--trials", type=int, default=80)
    parser.add_argument("--runs", type=int, default=1)
    parser.add_argument("--final-runs", type=int, default=4)
    parser.add_argument("--steps", type=int, default=4000)
    parser.add_argument("--seed", type=int, default=100)
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--out", required=True)
    asked = parser.parse_args()
    suite = read_suite(asked.suite)
    for name in asked.strategies:
        tuned = shoal.tune(
            suite.scenario, ranges(name), strategy=name, seed=asked.seed, steps=asked.steps, trials=asked.trials,
            runs=asked.runs, final_runs=asked.final_runs, maximize="time_on_target", jobs=asked.jobs,
            conditions=[each.name for each in suite.conditions], out=f"{asked.out}/{name}",
        )  # fmt: skip
        result = tuned.result
        gain = f"{result.start_value.mean:.4f} -> {result.winner_value.mean:.4f}, {result.verdict}"
        print(f"{name}: {gain}; {result.steps:,} steps", file=sys.stderr, flush=True)
        for field, value in (result.winner.point if result.verdict == "better" else {}).items():
            print(f"--set {name}.{field.removeprefix('strategy.')}={value}", flush=True)


if __name__ == "__main__":
    main()
