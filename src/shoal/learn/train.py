"""Train a strategy: weights in, a plain strategy file out, and what it is worth on chance that it has never seen."""

import keyword
import os
import re
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from shoal.core.files import check_file, write_atomic
from shoal.learn.errors import LearnError
from shoal.learn.search import Generation, Runs, search
from shoal.learn.weights import Weight, rewritten, source_text, weights_of
from shoal.metrics.summary import bounds_of
from shoal.record.statistics import Estimate, estimate
from shoal.run.simulation import Simulation
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario
from shoal.strategies import CATALOGUE

TEMPLATES = ("linear",)
JUDGED = 10  # fresh runs, four times as long, that say what was learned
_CHOSEN = 8  # runs by which the last centers, and the start, are compared
_LATEST = 3  # centers that are
_LONGER = 4


@dataclass(frozen=True)
class Learned:
    """What was learned.

    Attributes
    ----------
    file : the strategy; name : what it is called
    start, learned : time on target of the start and of what was learned, in the same fresh runs
    weights : {name: value} of the strategy learned
    generations : of the search; is_better : False: the start was the best, and is what the file holds
    """

    file: Path
    name: str
    start: Estimate
    learned: Estimate
    weights: dict[str, float]
    generations: int
    is_better: bool


@dataclass(frozen=True)
class Terms:
    """How to search.

    Parameters
    ----------
    budget : processor time [s], of all threads, besides compiling and the last judgement
    steps : of a run; each : runs of a candidate
    jobs : threads; default: one per core
    vary : names of the weights; default: all that there are
    """

    budget: float = 180.0
    steps: int = 5000
    each: int = 1
    jobs: int | None = None
    vary: tuple[str, ...] = ()


def train(
    strategy: str,
    scenario: Source,
    out: str | Path,
    *,
    terms: Terms | None = None,
    report: Callable[[Generation, float], None] = lambda generation, share: None,
) -> Learned:
    """Learn the weights of a strategy; write it to `out` after every generation, and in the end the best.

    The search has runs of the scenario's seed. What it found is judged by runs of the next seed, beside the start.

    Parameters
    ----------
    strategy : name or file of a strategy with weights in its parameters, or a template: linear
    scenario : in which it learns
    out : Python file to write; its name is that of the strategy
    terms : how to search
    report : is told of every generation, and which share of the budget is used

    Raises
    ------
    LearnError : there is nothing to learn, or no name for it; RecordError : the file cannot be written
    ScenarioError, StrategyError : it cannot run; MissingExtraError : cmaes is not installed
    """
    terms, out = terms or Terms(), Path(out)
    name = _checked_name(out)
    check_file(out)
    with _started(strategy, scenario, name) as chosen:
        owner, weights, text = chosen.strategy.owner, weights_of(chosen, terms.vary), source_text(chosen.strategy)
        first = np.array([weight.start for weight in weights])
        rewritten(text, owner, name, weights, first)  # before the work whose result it will hold
        Simulation(chosen)  # compiles
        begun = time.process_time()

        def used() -> float:
            return (time.process_time() - begun) / terms.budget

        def keep(generation: Generation) -> None:
            write_atomic(out, rewritten(text, owner, name, weights, generation.center).encode())
            report(generation, used())

        runs = Runs(chosen, weights, terms.jobs or os.cpu_count() or 1)
        try:
            seed, steps = chosen.seed, terms.steps
            centers = search(runs, seed=seed, steps=steps, each=terms.each, is_over=lambda: used() > 0.9, report=keep)
            candidates = [first, *centers[-_LATEST:]]
            unused = len(centers) * terms.each
            scores = runs.scores(candidates, seed, range(unused, unused + _CHOSEN), steps).mean(axis=1)
            best = candidates[int(scores.argmax())]
            write_atomic(out, rewritten(text, owner, name, weights, best).encode())
            fresh = runs.scores([first, best], seed + 1, range(JUDGED), _LONGER * steps)
        finally:
            runs.close()
    bounds = bounds_of("time_on_target")
    before, after = (estimate(each, bounds=bounds) for each in fresh)
    return Learned(out, name, before, after, _named(weights, best), len(centers), best is not first)


@contextmanager
def _started(strategy: str, scenario: Source, name: str) -> Iterator[Scenario]:
    """The scenario with the strategy that is learned; a template is a file as long as it is at work."""
    if strategy not in TEMPLATES:
        yield load(scenario, strategy=strategy)
        return
    text = (resources.files("shoal.learn") / "templates" / f"{strategy}.txt").read_text(encoding="utf-8")
    words = {"NAME": name, "CLASS": name.title().replace("-", "")}
    with tempfile.TemporaryDirectory(prefix="shoal-learn-") as folder:
        file = Path(folder) / f"{name.replace('-', '_')}.py"
        file.write_text(re.sub(r"\b(NAME|CLASS)\b", lambda match: words[match.group()], text), encoding="utf-8")
        yield load(scenario, strategy=str(file))


def _checked_name(out: Path) -> str:
    """The name of the strategy in a file."""
    name = out.stem.replace("_", "-")
    fix = "name a file by lower-case words, such as learned.py or my_policy.py"
    if out.suffix != ".py" or not re.fullmatch(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", name) or keyword.iskeyword(out.stem):
        raise LearnError(str(out), "does not give a strategy its name", fix)
    if name in CATALOGUE:
        raise LearnError(str(out), f"would be called as {name!r}, which comes with Shoal", fix)
    return name


def _named(weights: Sequence[Weight], values: Any) -> dict[str, float]:
    return {weight.name: float(value) for weight, value in zip(weights, values, strict=True)}
