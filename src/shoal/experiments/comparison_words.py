"""What a standing says in words, the same in a terminal and on a page."""

import math

from shoal.experiments.comparison import Standing
from shoal.experiments.paired import SIGNIFICANT
from shoal.record import words
from shoal.record.words import estimate_text

REFERENCES = (
    "References that know the target have no rank: no buoy could follow them. They are not an upper bound; no "
    "proven one is known."
)


def rank_text(each: Standing) -> str:
    """Rank, or that there is none."""
    return "–" if each.rank is None else str(each.rank)


def name_text(each: Standing) -> str:
    """Name, marked if it knows the target."""
    return f"{each.strategy} (knows the target)" if each.informed else each.strategy


def value_text(each: Standing) -> str:
    """Mean, its interval, and of how many runs if some are missing."""
    runs = len(each.value.runs)
    if runs == 0:
        return f"none of {each.missing} runs"
    some = f" ({runs} of {runs + each.missing} runs)" if each.missing else ""
    return estimate_text(each.value) + some


def difference_text(each: Standing) -> str:
    """Signed difference and its interval."""
    known = each.difference
    if known is None or known.pairs == 0:
        return ""
    return words.difference_text(known.mean, *(known.ci95 or (None, None)))


def p_text(p: float | None) -> str:
    """Three decimals; below, that it is."""
    if p is None:
        return ""
    return "< 0.001" if p < 0.001 else f"{p:.3f}"


def share_text(each: Standing, decimals: int = 3) -> str:
    """Mean, and the sign of a difference that was shown."""
    sign = {"better": " +", "worse": " −"}.get(each.verdict, "")
    return words.UNKNOWN if math.isnan(each.value.mean) else f"{each.value.mean:.{decimals}f}{sign}"


def family_text(family: str) -> str:
    """What intervals, adjusted p and verdicts mean, for a family such as "all 6 comparisons of the table"."""
    return (
        "Differences are over paired runs (same seeds); each 95 % interval is for that difference alone (Student's t). "
        f"Adjusted p is Holm's, for {family} together: verdicts need it below {SIGNIFICANT:g}, so that the chance of "
        f"any false one among them is at most {100 * SIGNIFICANT:g} %."
    )
