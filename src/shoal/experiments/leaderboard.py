"""A leaderboard: every strategy's score over the conditions of a suite, beside the motionless lattice."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from shoal.experiments.comparison import Comparison, Condition, Values, compare
from shoal.experiments.contenders import LATTICE, Contender
from shoal.experiments.design import Point
from shoal.experiments.suite import Suite
from shoal.metrics.summary import Bounds
from shoal.scenario.crew import crew_of

SCORE = "score"
_SHARE = Bounds(0.0, 1.0)


@dataclass(frozen=True)
class Leaderboard:
    """What a suite found.

    Attributes
    ----------
    suite : what was run
    hash : over every scenario, seed and run, and the results version: the same hash, the same numbers
    score : ranking by the mean of all conditions in each run, one family of comparisons with the lattice
    shares : the ranking under each condition, one more family
    """

    suite: Suite
    hash: str
    score: Comparison
    shares: Comparison

    @property
    def overall(self) -> Condition:
        """The ranking by score."""
        return self.score.conditions[0]


def make_leaderboard(
    suite: Suite, contenders: Sequence[Contender], shares: Mapping[str, tuple[Point, Values]]
) -> Leaderboard:
    """Rank by score: in each run the mean share over all conditions, which share the run's chance."""
    informed = {each.name for each in contenders if each.informed}
    scores = {each.name: np.mean([values[each.name] for _, values in shares.values()], axis=0) for each in contenders}
    return Leaderboard(
        suite,
        suite_hash(suite, contenders),
        compare({SCORE: ({}, scores)}, LATTICE, informed, bounds=_SHARE),
        compare(shares, LATTICE, informed, bounds=_SHARE),
    )


def suite_hash(suite: Suite, contenders: Sequence[Contender]) -> str:
    """16 hex digits over all runs of a suite, and the parameters that strategies have where nothing says them."""
    cells = suite.cells(contenders)
    ids = [cell.run_id(run) for cell in cells for run in range(suite.runs)]
    parameters = [str(crew_of(cell.scenario).params) for cell in cells]
    return hashlib.sha256(" ".join(ids + parameters).encode()).hexdigest()[:16]
