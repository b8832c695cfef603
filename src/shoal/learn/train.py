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
from typing import Any, NamedTuple

import numpy as np

from shoal.core.files import check_file, write_atomic
from shoal.learn.errors import LearnError
from shoal.learn.search import Generation, Runs, Weights, search
from shoal.learn.weights import Weight, rewritten, source_text, weights_of
from shoal.metrics.summary import bounds_of
from shoal.record.statistics import Estimate, estimate
from shoal.run.compiling import mark_compiled
from shoal.run.simulation import Simulation
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario
from shoal.strategies import CATALOGUE, TEMPLATES

JUDGED = 10  # fresh runs, four times as long, that say what was learned
COMPARED = 8  # runs by which the last centers, and the start, are compared
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


class Kept(NamedTuple):
    """The best of the start and the last centers, by the search's own runs: they flatter what they choose.

    weights : (W,); score, start : time on target of it and of the start; is_better : than the start
    """

    weights: Weights
    score: float
    start: float
    is_better: bool


class Stopped(KeyboardInterrupt):
    """An interrupt of a search whose file holds something.

    Attributes
    ----------
    interrupt : it; generations : that were done
    kept : what the file holds, None if it holds the last center, which nothing was compared with
    """

    def __init__(self, interrupt: KeyboardInterrupt, generations: int, kept: Kept | None) -> None:
        super().__init__(*interrupt.args)
        self.interrupt, self.generations, self.kept = interrupt, generations, kept


def train(
    strategy: str,
    scenario: Source,
    out: str | Path,
    *,
    terms: Terms | None = None,
    report: Callable[[Generation, float], None] = lambda generation, share: None,
    compiling: Callable[[Scenario], None] = lambda scenario: None,
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
    compiling : is told of the scenario before the engine is compiled for its strategy

    Raises
    ------
    Stopped : an interrupt, after a generation at least; the file holds the best, or another interrupt the last
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
        compiling(chosen)
        Simulation(chosen)  # compiles
        mark_compiled(chosen)
        centers: list[Weights] = []
        best: Kept | None = None
        stopped: KeyboardInterrupt | None = None
        begun = time.process_time()

        def used() -> float:
            return (time.process_time() - begun) / terms.budget

        def write(values: Weights) -> None:
            write_atomic(out, rewritten(text, owner, name, weights, values).encode())

        def keep(generation: Generation) -> None:
            write(generation.center)
            centers.append(generation.center)
            report(generation, used())

        runs = Runs(chosen, weights, terms.jobs or os.cpu_count() or 1)
        try:
            seed, steps = chosen.seed, terms.steps
            try:
                search(runs, seed=seed, steps=steps, each=terms.each, is_over=lambda: used() > 0.9, report=keep)
            except KeyboardInterrupt as interrupt:
                if not centers:
                    raise
                stopped = interrupt
            unused = (len(centers) + 1) * terms.each if stopped else len(centers) * terms.each
            best = _best_of(runs, [first, *centers[-_LATEST:]], seed, unused, steps)
            write(best.weights)
            if stopped:
                raise stopped
            fresh = runs.scores([first, best.weights], seed + 1, range(JUDGED), _LONGER * steps)
        except KeyboardInterrupt as interrupt:
            if not centers:
                raise
            raise Stopped(interrupt, len(centers), best) from interrupt
        finally:
            runs.close()
    bounds = bounds_of("time_on_target")
    before, after = (estimate(each, bounds=bounds) for each in fresh)
    return Learned(out, name, before, after, _named(weights, best.weights), len(centers), best.is_better)


def _best_of(runs: Runs, candidates: Sequence[Weights], seed: int, unused: int, steps: int) -> Kept:
    """The best of some weights, of which the first are the start's, in runs from `unused` on."""
    scores = runs.scores(candidates, seed, range(unused, unused + COMPARED), steps).mean(axis=1)
    best = int(scores.argmax())
    return Kept(candidates[best], float(scores[best]), float(scores[0]), best > 0)


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
