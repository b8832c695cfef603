"""Which statements of a paper exclude each other: pairs that no reading meets together, and how near one comes."""

from collections.abc import Mapping
from itertools import permutations

from shoal.experiments.rows import Row
from shoal.paper.results import Claim
from shoal.paper.statements import Verdicts, statements_of, verdict_on


def frontier_table(found: Mapping[str, Verdicts]) -> list[Row]:
    """Return one row per pair of statements that hold under some reading each and under none both.

    Of the readings under which the first holds, `nearest` is the one under which the second comes nearest, and
    `second_there` is what is measured of it there. `readings_first` and `readings_second` count those that meet each.
    A last kind of row has no second: a statement that holds under no reading.
    """
    if not found:
        return []
    verdicts = {name: {id_: verdict_on(id_, of) for id_ in statements_of(of)} for name, of in found.items()}
    ids = sorted({id_ for of in verdicts.values() for id_ in of}, key=lambda id_: int(id_[1:]))
    met = {id_: [name for name, of in verdicts.items() if id_ in of and of[id_].verdict == "holds"] for id_ in ids}
    table: list[Row] = []
    for first, second in permutations(ids, 2):
        if met[first] and met[second] and not set(met[first]) & set(met[second]):
            nearest = min(met[first], key=lambda name: _distance(verdicts[name].get(second)))
            table.append(_row(first, second, met, nearest, verdicts[nearest][second]))
    for id_ in ids:
        if not met[id_]:
            nearest = min(
                (name for name in verdicts if id_ in verdicts[name]), key=lambda n: _distance(verdicts[n][id_])
            )
            table.append(_row(id_, "", met, nearest, verdicts[nearest][id_]))
    return table


def _row(first: str, second: str, met: Mapping[str, list[str]], nearest: str, claim: Claim) -> Row:
    return {
        "first": first,
        "second": second,
        "readings_first": len(met[first]),
        "readings_second": len(met[second]) if second else 0,
        "nearest": nearest,
        "verdict_there": claim.verdict,
        "second_there": claim.measured,
    }


_RANK = {"holds": 0, "holds partly": 1, "undecided": 2, "does not hold": 3}


def _distance(claim: Claim | None) -> tuple[int, float]:
    """How far a claim is from being met: its verdict, then the number that speaks most against it."""
    if claim is None:
        return (4, 0.0)
    aim = {"C3": 18.0, "C5": 30.0, "C11": 0.0, "C13": 0.0}.get(claim.id)
    return (_RANK[claim.verdict], -claim.value if aim is None else abs(claim.value - aim))
