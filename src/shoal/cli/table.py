"""A record as a table that fits a terminal."""

import math
import textwrap
from collections.abc import Iterator, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from shoal.cli.console import print_table, results_console, styled
from shoal.core.text import plain
from shoal.metrics.summary import METRICS
from shoal.record.names import unit_text
from shoal.record.record import Record
from shoal.record.sentence import quotable
from shoal.record.shortlist import shortlist
from shoal.record.statistics import Estimate
from shoal.record.words import interval_text, mean_text, steered_text
from shoal.scenario.choices import degree_text, speed_of, strategy_text
from shoal.scenario.schema import Scenario

_OF_FLEETS = ("xi_raw", "stationary", "speed", "power", "energy", "charge")
_MOST_TOLD = 10  # changes of a steered run
_WIDE = 78  # columns of sentences
_OF_TARGETS = ("time_on_target", "first_detection", "reacquisition")


def print_record(record: Record, *, everything: bool = False) -> None:
    """Print a sentence to quote, what was run, the metrics that matter most, and where they come from.

    Parameters
    ----------
    everything : all metrics, those of each fleet, target and change of the swarm, and where agents head
    """
    console = results_console()
    console.print(styled(textwrap.fill(quotable(record), _WIDE), "bold"))
    console.print(_setup(record))
    _tell_of_steering(record)
    listed = record.listed() if everything else shortlist(record)
    table = Table(box=None, padding=(0, 2, 0, 0))
    for title, justify in (("", "left"), ("mean", "right"), ("95 % interval", "left"), ("unit", "left")):
        width = None if title else 28  # of labels: long names of fleets are cut, not numbers
        table.add_column(title, justify=justify, no_wrap=True, max_width=width)  # type: ignore[arg-type]
    for name in listed:
        table.add_row(METRICS[name].words, *_cells(record.estimate(name), name))
    if everything:
        _add_parts(table, record)
    print_table(console, table)
    if everything and (not record.scenario.metrics or "stationary" in listed):
        _print_headings(console, record)
    for note in _notes(record, listed, everything):
        console.print(styled(textwrap.fill(note, _WIDE), "dim"))


def _setup(record: Record) -> Text:
    """What was run, in three lines."""
    scenario, facts = record.scenario, record.facts
    fleets = " + ".join(
        f"{count} {plain(name)} ({speed:g} m/s{_joining(scenario, name)})"
        for name, count, speed in zip(facts.fleets, facts.counts, facts.max_speeds, strict=True)
    )
    targets = ", ".join(_target(target) for target in scenario.targets)
    degrees = degree_text(scenario, record.roster.by_fleet("neighbors"))
    runs = len(record.tallies)
    disturbed = ", ".join(map(_disturbance, scenario.disturbances))
    return styled(
        f"{plain(scenario.name)}: {fleets}, k = {degrees}\n"
        f"strategy {strategy_text(scenario)}; target {targets}{f'; disturbed by {disturbed}' if disturbed else ''}\n"
        f"{runs} run{'s' * (runs > 1)} of {scenario.steps:,} steps of {scenario.time_step:g} s, "
        f"seed {record.provenance['seed']}, scenario {record.provenance['scenario_hash']}\n",
        "",
    )


def _print_headings(console: Console, record: Record) -> None:
    """The histogram of phi, as numbers of agents in each bin."""
    histogram = record.phi_histogram().sum(axis=0)
    console.print("phi histogram, agents per step from -1 (away) to +1 (toward):")
    console.print("  " + " ".join(f"{agents:.2f}" for agents in histogram))


def _notes(record: Record, listed: Sequence[str], everything: bool) -> Iterator[str]:
    """What is not shown, what the numbers mean, what the intervals are over."""
    yield ""
    short = ", ".join(METRICS[name].words for name in record.too_short() if name in listed)
    if short:
        yield f"too short for an interval of {short}: more steps or more runs determine it"
    method = "over runs" if len(record.tallies) > 1 else "by batch means"
    yield f"intervals are {method}"
    if not everything:
        yield f"--all shows {', '.join(_left_out(record, listed))}"
    yield "shoal metrics says what each means (docs/reference/metrics.md)"
    yield f"the run{'s' * (len(record.tallies) > 1)} took {record.provenance['seconds']:.3g} s"


def _left_out(record: Record, listed: Sequence[str]) -> Iterator[str]:
    more = len(record.listed()) - len(listed)
    if more:
        yield f"{more} more metrics"
    parts = {
        "fleet": len(record.facts.fleets) > 1,
        "target": len(record.scenario.targets) > 1,
        "change of the swarm": bool(record.changes()),
    }
    yield from (f"each {name}" for name, several in parts.items() if several)
    yield "where agents head"


def _add_parts(table: Table, record: Record) -> None:
    """Rows of every fleet, target and change of the swarm, where there are several; under a heading each."""
    fleets = record.facts.fleets if len(record.facts.fleets) > 1 else ()
    listed = record.listed()
    by_fleet = {name: record.fleet_estimate(name) for name in _OF_FLEETS if name in listed} if fleets else {}
    for fleet in fleets if by_fleet else ():
        table.add_row(f"fleet {plain(fleet)}")
        for name, values in by_fleet.items():
            if METRICS[name].asked and math.isnan(values[fleet].mean):
                continue
            table.add_row(f"  {METRICS[name].words}", *_cells(values[fleet], name))
    targets = record.target_estimates()
    for number, target in enumerate(targets if len(targets) > 1 else [], 1):
        table.add_row(f"target {number}")
        for name in _OF_TARGETS:
            table.add_row(f"  {METRICS[name].words}", *_cells(target[name], name))
    for step, change in zip(record.changes(), record.robustness(), strict=True):
        table.add_row(f"step {step:,}: {_change(record, step)}")
        for name in ("before", "during", "after"):
            table.add_row(f"  time on target {name}", *_cells(change[name], "time_on_target"))
        table.add_row("  recovery", *_cells(change["recovery"], "reacquisition"))


def _tell_of_steering(record: Record) -> None:
    """What was changed while the run was watched: the lines above are of its begin, the numbers below of all of it."""
    steered = record.steered
    if not steered:
        return
    console = results_console()
    console.print(steered_text(steered) + "; above is what it began with, the numbers are over all steps")
    for step, words in steered[:_MOST_TOLD]:
        console.print(f"  step {step:,}: {plain(words)}")
    if len(steered) > _MOST_TOLD:
        console.print(f"  and {len(steered) - _MOST_TOLD:,} more, in changes.jsonl of the record")


def _joining(scenario: Scenario, fleet: str) -> str:
    count = sum(each.count for each in scenario.joins if each.fleet == fleet)
    return f"; {count} of them join later" if count else ""


def _change(record: Record, step: int) -> str:
    """How many agents are lost and join at a step."""
    counts = {
        words: sum(each.size for each in changes if each.step == step)
        for changes, words in ((record.scenario.losses, "lost"), (record.scenario.joins, "join"))
    }
    return ", ".join(f"{count} {words}" for words, count in counts.items() if count)


def _cells(value: Estimate, name: str) -> tuple[str, str, str]:
    return mean_text(value), interval_text(value), unit_text(METRICS[name])


def _disturbance(disturbance: Any) -> str:
    return plain(f"{disturbance.kind} ({disturbance.fleet})" if disturbance.fleet else str(disturbance.kind))


def _target(target: Any) -> str:
    speed = speed_of(target)
    if speed is None:
        return plain(f"{target.kind} {getattr(target, 'id', None) or ''}".strip())
    return f"at {speed:g} m/s" if target.kind == "waypoint" else f"{target.kind} at {speed:g} m/s"
