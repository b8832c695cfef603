"""CMA-ES over weights: generation by generation, every one on chance of its own."""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import MissingExtraError, StrategyError
from shoal.learn.weights import Weight, bounds_of, trial
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario

_CHUNK = 2000  # steps of one compiled call: an interrupt is heard between two
Weights = npt.NDArray[np.float64]


class Generation(NamedTuple):
    """What a generation found.

    number : from 1; score : mean of its candidates; best : of them; center : (W,) the weights that the search is at
    """

    number: int
    score: float
    best: float
    center: Weights


class Runs:
    """Runs of a scenario with different weights, in threads.

    Parameters
    ----------
    scenario : with the strategy whose weights they are; weights : see weights.py; jobs : threads
    """

    def __init__(self, scenario: Scenario, weights: Sequence[Weight], jobs: int) -> None:
        self.scenario, self.weights = scenario, weights
        self._pool = ThreadPoolExecutor(jobs)
        self._ended = False

    def scores(self, candidates: Sequence[Weights], seed: int, runs: Sequence[int], steps: int) -> Weights:
        """Time on target of each candidate in each run, (C, R): the same chance for all. 0 of those that break."""
        scenarios = [self._scenario(each, seed, steps) for each in candidates]
        tasks = [self._pool.submit(self._score, each, run) for each in scenarios for run in runs]
        try:
            return np.array([task.result() for task in tasks]).reshape(len(scenarios), len(runs))
        except BaseException:  # an interrupt, after which others may be asked for
            for task in tasks:
                task.cancel()
            raise

    def close(self) -> None:
        """End; runs that go on end soon."""
        self._ended = True
        self._pool.shutdown(cancel_futures=True)

    def _scenario(self, values: Weights, seed: int, steps: int) -> Scenario:
        return trial(self.scenario, self.weights, values).model_copy(update={"seed": seed, "steps": steps})

    def _score(self, scenario: Scenario, run: int) -> float:
        try:
            simulation = Simulation(scenario, run)
            while simulation.number < scenario.steps and not self._ended:
                simulation.advance(min(_CHUNK, scenario.steps - simulation.number))
        except StrategyError:  # a number is not finite
            return 0.0
        present = simulation.tally.present.sum()
        return float(simulation.tally.on_target.sum() / present) if present else 0.0


def search(
    runs: Runs, *, seed: int, steps: int, each: int, is_over: Callable[[], bool], report: Callable[[Generation], None]
) -> list[Weights]:
    """Search until it is over; return the centers of all generations.

    Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv 1604.00772, as in the package cmaes.

    Parameters
    ----------
    runs : by which candidates are judged; seed : of all chance
    steps : of a run; each : runs of a candidate
    report : is told of every generation

    Raises
    ------
    MissingExtraError : cmaes is not installed
    """
    weights = runs.weights
    start, scale = (np.array([getattr(weight, name) for weight in weights]) for name in ("start", "scale"))
    strategy = _cma(bounds_of(weights), seed)
    centers: list[Weights] = []
    while not is_over():
        asked = [strategy.ask() for _ in range(strategy.population_size)]
        numbers = range(len(centers) * each, (len(centers) + 1) * each)
        scores = runs.scores([start + scale * one for one in asked], seed, numbers, steps).mean(axis=1)
        strategy.tell([(one, -score) for one, score in zip(asked, scores.tolist(), strict=True)])
        bounds = bounds_of(weights)
        centers.append(start + scale * np.clip(strategy.mean, bounds[:, 0], bounds[:, 1]))
        report(Generation(len(centers), float(scores.mean()), float(scores.max()), centers[-1]))
    return centers


def _cma(bounds: Weights, seed: int) -> Any:
    count = len(bounds)
    try:
        from cmaes import CMA
    except ImportError as error:
        raise MissingExtraError.of("cmaes", "learn", "learning weights") from error
    population = max(12, 4 + int(3 * np.log(count)))
    limits = bounds if np.isfinite(bounds).any() else None
    return CMA(mean=np.zeros(count), sigma=1.0, bounds=limits, seed=seed % 2**32, population_size=population)
