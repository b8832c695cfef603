"""How well a reading meets the paper: every statement at each target speed, and a score over all of them.

The rule, written before any number was seen. C1 to C13 are judged by their own rules (claims.py), on the runs of one
target speed and on those of both ("both"). The paper does not say at which speed its "about" values (ABOUT_VALUES) were
read, so such a statement counts as its better speed; every other counts by both speeds together. A statement that holds
is worth 1, one that holds partly 1/2, any other nothing; the sum over all statements is the score.

C13 speaks of runs of 100,000 steps; from shorter ones it is extrapolated: the deviation of a mean over a run falls with
the square root of its length.
"""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from shoal.experiments.rows import Row
from shoal.paper import claims as judges
from shoal.paper.clusters import Episode
from shoal.paper.curves import values_of
from shoal.paper.plan import FULL_STEPS
from shoal.paper.results import Claim

ABOUT_VALUES = ("C3", "C5")
BOTH = "both"
POINTS = {"holds": 1.0, "holds partly": 0.5, "does not hold": 0.0, "undecided": 0.0}
_PER_SPEED: dict[str, Callable[[Sequence[Row]], Claim]] = {
    f"C{number}": getattr(judges, f"c{number}") for number in (1, 2, 3, 4, 5, 6, 7, 8, 10)
}

Verdicts = dict[tuple[str, str], Claim]  # by statement, and target speed or "both"


def judge_statements(
    main: Sequence[Row], placement: Sequence[Row], episodes: Mapping[float, Sequence[Episode]], steps: int
) -> Verdicts:
    """Return the claim on every statement at every target speed that it can be judged at, and at both.

    Parameters
    ----------
    main, placement : rows of the curves, and of other starts of the fast fleet
    episodes : clusters of the fast buoys at each target speed
    steps : length of the runs
    """
    found: Verdicts = {}
    speeds = values_of(main, "target_speed")
    for name in (f"{speed:g}" for speed in speeds):
        found |= {(id_, at): claim for (id_, at), claim in _judge(main, placement, episodes, steps, name).items()}
    if len(speeds) > 1:
        found |= _judge(main, placement, episodes, steps, BOTH)
        found["C9", BOTH] = judges.c9(main)
    return found


def verdict_on(id_: str, found: Verdicts) -> Claim:
    """Return the claim by which a statement counts: at both speeds, or at the better one for an "about" value."""
    mine = {at: claim for (statement, at), claim in found.items() if statement == id_}
    alone = [claim for at, claim in mine.items() if at != BOTH]
    if id_ in ABOUT_VALUES and alone:
        return max(alone, key=lambda claim: POINTS[claim.verdict])
    return mine.get(BOTH) or alone[0]


def statements_of(found: Verdicts) -> list[str]:
    """The statements that were judged, in order."""
    return sorted({id_ for id_, _ in found}, key=lambda id_: int(id_[1:]))


def score(found: Verdicts) -> float:
    """The sum over statements."""
    return sum(POINTS[verdict_on(id_, found).verdict] for id_ in statements_of(found))


def holding(found: Verdicts) -> int:
    """How many statements hold."""
    return sum(verdict_on(id_, found).verdict == "holds" for id_ in statements_of(found))


def at_full_length(rows: Sequence[Row], steps: int, metrics: Sequence[str] = ("time_on_target", "xi")) -> list[Row]:
    """Rows whose spread over seeds is what runs of 100,000 steps would show; their means stay."""
    cells: dict[tuple[object, ...], list[Row]] = {}
    for row in rows:
        if row.get("status", "done") == "done":
            cells.setdefault((row["fast"], row["neighbors"], row["target_speed"]), []).append(row)
    factor = math.sqrt(steps / FULL_STEPS)
    scaled = []
    for cell in cells.values():
        means = {metric: float(np.mean([row[metric] for row in cell])) for metric in metrics}
        scaled += [
            {**row, **{name: mean + factor * (row[name] - mean) for name, mean in means.items()}} for row in cell
        ]
    return scaled


def _judge(
    main: Sequence[Row],
    placement: Sequence[Row],
    episodes: Mapping[float, Sequence[Episode]],
    steps: int,
    at: str,
) -> Verdicts:
    """Everything that one speed can tell, or both together."""
    mine, moved = ([row for row in rows if at in (BOTH, f"{row['target_speed']:g}")] for rows in (main, placement))
    clusters = [each for speed, of_speed in episodes.items() if at in (BOTH, f"{speed:g}") for each in of_speed]
    found: Verdicts = {(id_, at): judge(mine) for id_, judge in _PER_SPEED.items()}
    found["C11", at] = judges.c11(mine, moved)
    found["C12", at] = judges.c12(clusters)
    found["C13", at] = judges.c13(mine if steps == FULL_STEPS else at_full_length(mine, steps), FULL_STEPS)
    return found
