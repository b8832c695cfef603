"""The cases of a claim and the verdict that they add up to.

A case (a k, a target speed, a swarm) is true where its 95 % interval lies inside what the claim says, false where it
lies outside, open where it does both. All true: the claim holds. At least half true: it holds partly. Else, at least
half false: it does not hold. Else it is undecided.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from shoal.paper.curves import Floats, Interval, intervals
from shoal.paper.results import Verdict


class Case(NamedTuple):
    """One case of a claim: where, the number, and whether the claim is true of it (None: open)."""

    name: str
    number: Interval
    true: bool | None


def judge(numbers: Mapping[str, Floats], test: Callable[[Interval], bool | None]) -> list[Case]:
    """Cases by a test of the interval of each number, which is given in every seed (R,)."""
    known = {name: values for name, values in numbers.items() if values.size}
    found = intervals(list(known.values()))
    return [Case(name, number, test(number)) for name, number in zip(known, found, strict=True)]


def rising(differences: Mapping[str, Floats]) -> list[Case]:
    """Cases that are true where a difference is above zero."""
    return judge(differences, positive)


def percent(cases: Sequence[Case]) -> list[Case]:
    """The same cases with their numbers in percent."""
    return [case._replace(number=case.number.times(100)) for case in cases]


def positive(number: Interval) -> bool | None:
    """Whether a number is above zero."""
    return True if number.low > 0 else False if number.high < 0 else None


def within(number: Interval, low: float, high: float) -> bool | None:
    """Whether a number is in a range."""
    if low <= number.low and number.high <= high:
        return True
    return False if number.low > high or number.high < low else None


def verdict_of(cases: Iterable[Case]) -> Verdict:
    """What the cases add up to."""
    truths = [case.true for case in cases]
    true, false = truths.count(True), truths.count(False)
    if truths and true == len(truths):
        return "holds"
    if truths and 2 * true >= len(truths):
        return "holds partly"
    return "does not hold" if truths and 2 * false >= len(truths) else "undecided"


def worst(cases: Sequence[Case], aim: float | None = None) -> Case:
    """The case that speaks most against a claim: the lowest number, or the one furthest from `aim`."""
    known = [case for case in cases if math.isfinite(case.number.value)]
    if not known:
        return Case("nothing was run", Interval(math.nan, math.nan, math.nan), None)
    return min(known, key=lambda case: case.number.value if aim is None else -abs(case.number.value - aim))


def counted(cases: Sequence[Case]) -> str:
    """ "true in 3 of 4 cases, false in 1"."""
    truths = [case.true for case in cases]
    false = f", false in {truths.count(False)}" if False in truths else ""
    return f"true in {truths.count(True)} of {len(cases)} cases{false}"


def told(case: Case, unit: str = "", digits: int = 1) -> str:
    """ "20.3 [19.8, 20.9] (mixed, 3 m/s)"."""
    return f"{told_number(case.number, digits)}{unit} ({case.name})"


def told_number(number: Interval, digits: int = 1) -> str:
    """ "20.3 [19.8, 20.9]"."""
    bounds = f" [{number.low:.{digits}f}, {number.high:.{digits}f}]" if math.isfinite(number.low) else ""
    return f"{number.value:.{digits}f}{bounds}"
