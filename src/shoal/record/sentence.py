"""What a record says in one sentence that can be quoted; every number in it is one of the record's."""

import math

from shoal.record.record import Record
from shoal.record.statistics import Estimate
from shoal.record.words import ends_text, mean_text, told


def quotable(record: Record) -> str:
    """Return how much of the time targets were watched, how often they were lost and for how long.

    The target was watched 83.2 % [82.7, 83.6] of the time; it was lost 1,394 times an hour [1,365, 1,424], ...
    """
    watched, targets = record.estimate("time_on_target"), len(record.scenario.targets)
    runs = len(record.tallies)
    during = f"the {runs} runs" if runs > 1 else "the run"
    if not math.isfinite(watched.mean):
        some = any(tally.present.any() for tally in record.tallies)
        return f"{'In some runs no' if some else 'No'} target was ever there, so there is no time on target."
    if not any(watched.runs):
        nobody = "The target" if targets == 1 else f"None of the {targets} targets"
        return f"{nobody} was {'never' if targets == 1 else 'ever'} detected in {during}."
    who, one = ("The target", "it") if targets == 1 else (f"At least one of the {targets} targets", "a target")
    always = record.estimate("target_present").mean == 1
    text = f"{who} was watched {_percent(watched)} of the time{'' if always else ' that it was there'}"
    return text + _lost(record, one) + (_found(record, during) if targets == 1 else "") + "."


def _percent(share: Estimate) -> str:
    """83.2 % [82.7, 83.6]."""
    low, high = share.ci95 or (math.nan, math.nan)
    percent = 100 * share.mean, 100 * low, 100 * high
    mean, _, ends = told(*percent).partition(" ")
    return f"{mean} % {ends}".rstrip()


def _lost(record: Record, one: str) -> str:
    """How often, and for how long; nothing where it was not measured."""
    losses, again = record.estimate("losses"), record.estimate("reacquisition")
    if not _measured(record, "losses") or not math.isfinite(losses.mean):
        return ""
    if losses.mean == 0:
        return f"; once found, {one} was never lost"
    text = f"; {one} was lost {_with_unit(losses, 'times an hour')}"
    if not _measured(record, "reacquisition"):
        return text
    if math.isfinite(again.mean):
        return f"{text}, for {_with_unit(again, 's')} each time"
    return f"{text} and never found again" if all(map(math.isnan, again.runs)) else text


def _with_unit(value: Estimate, unit: str) -> str:
    """0.435 s [0.415, 0.456]."""
    low, high = value.ci95 or (None, None)
    return f"{mean_text(value)} {unit} {ends_text(value.mean, low, high)}".rstrip()


def _found(record: Record, during: str) -> str:
    """In how many runs it was found at all, where that was not in every one."""
    found = record.estimate("found").runs
    known = sum(map(bool, found))
    return f"; it was found in {known} of {during}" if _measured(record, "found") and known < len(found) else ""


def _measured(record: Record, name: str) -> bool:
    """Whether a metric is one of those that the scenario asks for."""
    return not record.scenario.metrics or name in record.scenario.metrics
