"""The cases of a claim and the verdict that they add up to.

A case (a k, a target speed, a swarm) is true where its 95 % interval lies inside what the claim says, false where it
lies outside, open where it does both: the runs cannot tell. Where many cases are judged at once, some would be false by
chance, so a case counts as false only if it is after Holm's correction over the claim's cases (else it is open).
A number is compared as finely as the paper tells it: half of the last digit of its words is given either way.

Open cases count neither for nor against a claim, but at least half of the cases must not be open, else the claim is
undecided. None false: the claim holds. At least as many true as false: it holds partly. Else it does not hold.
"""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import NamedTuple

from shoal.experiments.paired import SIGNIFICANT, holm
from shoal.paper.curves import Floats, Interval, degrees_of_freedom, intervals
from shoal.paper.results import Verdict
from shoal.record.statistics import t_quantile, two_sided
from shoal.record.words import told

Truth = bool | None  # None: open
Test = Callable[[Interval], Truth]

ABOUT = 2.5  # what "about" means for a k: it tells 25 from 30
WHOLE = 0.5  # half of the last digit of a k


class Case(NamedTuple):
    """One case of a claim: where, the number, and whether the claim is true of it by its own interval (None: open).

    p : of a false case, the chance that a true one looks as false; 0 if no chance is in it
    """

    name: str
    number: Interval
    true: Truth
    p: float = 0.0


class Counts(NamedTuple):
    """How many cases are true, open and false, after Holm's correction."""

    true: int
    open: int
    false: int

    def __str__(self) -> str:
        return f"{self.true} true, {self.open} open, {self.false} false"


def judge(numbers: Mapping[str, Floats], test: Test) -> list[Case]:
    """Cases by a test of the interval of each number, which is given in every seed (R,)."""
    known = {name: values for name, values in numbers.items() if values.size}
    values = list(known.values())
    found = zip(known, intervals(values), degrees_of_freedom(values), strict=True)
    return [judged(name, number, test, degrees) for name, number, degrees in found]


def judged(name: str, number: Interval, test: Test, degrees: float = math.inf) -> Case:
    """A case by a test of its interval; `degrees` of freedom of the t that the interval is made with."""
    return Case(name, number, test(number), _chance(number, test, degrees))


def rising(differences: Mapping[str, Floats]) -> list[Case]:
    """Cases that are true where a difference is above zero."""
    return judge(differences, positive)


def percent(cases: Sequence[Case]) -> list[Case]:
    """The same cases with their numbers in percent."""
    return [case._replace(number=case.number.times(100)) for case in cases]


def positive(number: Interval) -> Truth:
    """Whether a number is above zero."""
    return True if number.low > 0 else False if number.high < 0 else None


def within(number: Interval, low: float, high: float, slack: float = 0.0) -> Truth:
    """Whether a number is in a range; `slack`: half of the last digit that the paper tells."""
    low, high = low - slack, high + slack
    if low <= number.low and number.high <= high:
        return True
    return False if number.low > high or number.high < low else None


def about(number: Interval, k: float) -> Truth:
    """Whether a k is about another one."""
    return within(number, k - ABOUT, k + ABOUT, WHOLE)


def count(cases: Iterable[Case]) -> Counts:
    """How many are true, open and false."""
    listed = list(cases)
    false = sum(
        p is not None and p < SIGNIFICANT for p in holm([case.p if case.true is False else 1.0 for case in listed])
    )
    true = sum(case.true is True for case in listed)
    return Counts(true, len(listed) - true - false, false)


def verdict_of(cases: Iterable[Case]) -> Verdict:
    """What the cases add up to."""
    true, open_, false = count(cases)
    if true + false < max(open_, 1):
        return "undecided"
    if not false:
        return "holds"
    return "holds partly" if true >= false else "does not hold"


def worst(cases: Sequence[Case], aim: float | None = None) -> Case:
    """The case that speaks most against a claim: the lowest number, or the one furthest from `aim`."""
    known = [case for case in cases if math.isfinite(case.number.value)]
    if not known:
        return Case("nothing was run", Interval(math.nan, math.nan, math.nan), None)
    return min(known, key=lambda case: case.number.value if aim is None else -abs(case.number.value - aim))


def case_text(case: Case, unit: str = "") -> str:
    """ "20.3 [19.8, 20.9] (mixed, 3 m/s)"."""
    return f"{told_number(case.number)}{unit} ({case.name})"


def told_number(number: Interval) -> str:
    """ "20.3 [19.8, 20.9]"."""
    return told(*number)


def _chance(number: Interval, test: Test, degrees: float) -> float:
    """p of a false case: the level at which its interval is just wide enough to leave it open; else 1."""
    if test(number) is not False:
        return 1.0
    narrow, wide = 1.0, 1e6  # times its width
    while wide / narrow > 1.001:
        middle = math.sqrt(narrow * wide)
        narrow, wide = (middle, wide) if test(_widened(number, middle)) is False else (narrow, middle)
    return two_sided(narrow * (1.959964 if math.isinf(degrees) else t_quantile(int(degrees))), degrees)


def _widened(number: Interval, factor: float) -> Interval:
    value, low, high = number
    return Interval(value, value + factor * (low - value), value + factor * (high - value))
