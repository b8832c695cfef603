"""What a figure says in words: counts, estimates, and the lines about a record."""

from collections.abc import Sequence
from typing import Any

from shoal.core.text import plain
from shoal.record import words
from shoal.record.record import Record
from shoal.record.statistics import Estimate
from shoal.record.words import steered_text
from shoal.scenario.choices import degree_text, speed_of, strategy_text

_THIN = "\u2009"


def plural(number: int, noun: str) -> str:
    """3 000 steps, 1 run."""
    return f"{count(number)} {noun}{'' if number == 1 else 's'}"


def count(number: int) -> str:
    """100 000, its thousands set apart."""
    return f"{number:,}".replace(",", _THIN)


def field_words(field: str) -> str:
    """What an axis calls a varied field of a scenario: target speed [m/s]."""
    return _FIELDS.get(field) or field.replace("_", " ")


def field_value(field: str, value: Any) -> str:
    """A varied field and one of its values, for a legend: target speed 3 m/s, k = 20, 15 fast agents, knn-pso."""
    if field == "fast":
        return f"{value} fast agents"
    if field == "strategy":
        return str(value)
    name, _, unit = field_words(field).partition(" [")
    return f"k = {value}" if field == "neighbors" else f"{name} {value}{f' {unit[:-1]}' if unit else ''}"


_FIELDS = {"target_speed": "target speed [m/s]", "neighbors": "neighbors, k", "fast": "fast agents"}


def shorten(text: str, letters: int) -> str:
    """A text on one line, cut to a number of letters; the cut is marked."""
    text = plain(" ".join(text.split()))
    return text if len(text) <= letters else text[: letters - 1].rstrip() + "…"


def legend_text(text: str) -> str:
    """A text as a label that a legend shows: matplotlib hides those that begin with _."""
    return f"{_THIN}{text}" if text.startswith("_") else text


def estimate_text(value: Estimate) -> str:
    """Mean [low, high], as everywhere, with thousands set apart as figures do."""
    return words.estimate_text(value, _THIN)


def length_text(meters: float) -> str:
    """A length in m, or in km from 1 km on."""
    return f"{meters / 1000:g} km" if meters >= 1000 else f"{meters:g} m"


def time_text(seconds: float) -> str:
    """A time in s, min or h."""
    for size, unit in ((3600.0, "h"), (60.0, "min")):
        if seconds >= 2 * size:
            return f"{seconds / size:.1f} {unit}"
    return f"{seconds:.1f} s"


def setup_phrases(record: Record) -> list[str]:
    """What was run: agents, k, strategy, targets, steps and runs."""
    scenario, facts = record.scenario, record.facts
    names = [plain(name) for name in facts.fleets]
    fleets = ", ".join(f"{n} {name}" for n, name in zip(facts.counts, names, strict=True))
    agents = plural(facts.agents, "agent")
    return [
        f"{agents} ({fleets})" if len(facts.counts) > 1 else f"{agents} ({names[0]})",
        f"k = {degree_text(scenario, record.roster.by_fleet('neighbors'))}",
        strategy_text(scenario),
        targets_text(scenario.targets),
        plural(scenario.steps, "step") + f" of {facts.time_step:g} s",
        plural(len(record.tallies), "run"),
        *([steered_text(record.steered)] if record.steered else ()),
    ]


def targets_text(targets: Sequence[Any]) -> str:
    """How many targets and how fast: target 3 m/s; 2 targets (still, 3 m/s)."""
    how = [_speed_text(target) for target in targets]
    if len(how) == 1:
        return how[0].replace("recorded", "recorded target") if how[0].startswith("recorded") else f"target {how[0]}"
    return f"{len(how)} targets ({', '.join(how)})"


def metric_phrases(record: Record) -> list[str]:
    """Key metrics, mean [95 % interval]."""
    engaged = record.estimate("engaged")
    return [
        f"{record.metrics['time_on_target'].words} {estimate_text(record.estimate('time_on_target'))}",
        f"{record.metrics['xi'].words} {estimate_text(record.estimate('xi'))}",
        f"{record.metrics['engaged'].words} {estimate_text(engaged)}",
    ]


def interval_text(record: Record) -> str:
    """What the intervals are over."""
    runs, batches = len(record.tallies), record.tallies[0].steps.size
    if max(runs, batches) < 2:
        return "too short for intervals"
    return f"[ ]: 95 % interval over {plural(runs, 'run') if runs > 1 else f'{batches} batches of the run'}"


def provenance_phrases(record: Record) -> list[str]:
    """What identifies the result."""
    known = record.provenance
    return [
        f"scenario {known.get('scenario_hash', 'unknown')}",
        f"seed {known.get('seed', 'unknown')}",
        f"shoal {known.get('versions', {}).get('shoal', 'unknown')}",
    ]


def _speed_text(target: Any) -> str:
    """How a target moves; the paper's, by waypoints, goes without saying."""
    if target.kind == "track":
        return f"recorded ({plain(target.id)})" if target.id else "recorded"
    speed = speed_of(target)
    if speed is None:
        return str(target.kind)
    kind = "" if target.kind == "waypoint" else f"{target.kind} "
    return f"{kind}{speed:.3g} m/s"
