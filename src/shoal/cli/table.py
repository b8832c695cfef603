"""A record as a table that fits a terminal."""

import math
import sys

from rich.console import Console
from rich.table import Table

from shoal.metrics.summary import METRICS
from shoal.record.record import Record
from shoal.record.statistics import Estimate

_LABELS = {
    "time_on_target": "time on target",
    "xi": "velocity fluctuation Xi",
    "xi_raw": "Xi, not normalised",
    "response": "response",
    "engaged": "engaged agents",
    "stationary": "stationary agents",
    "target_present": "target there",
}
_OF_SEVERAL_TARGETS = ("targets_observed", "fairness")


def print_record(record: Record) -> None:
    """Print what was run, every metric with its interval, and where it comes from."""
    console = Console(file=sys.stdout, highlight=False)
    scenario, facts = record.scenario, record.facts
    fleets = " + ".join(
        f"{count} {name} ({speed:g} m/s)"
        for name, count, speed in zip(facts.fleets, facts.counts, facts.max_speeds, strict=True)
    )
    targets = ", ".join(_target(target) for target in scenario["targets"])
    runs = len(record.tallies)
    console.print(f"[bold]{scenario['name']}[/bold]: {fleets}, k = {scenario['network']['neighbors']}")
    console.print(f"strategy {scenario['strategy']['name']}; target {targets}")
    console.print(
        f"{runs} run{'s' * (runs > 1)} of {scenario['steps']:,} steps of {scenario['time_step']:g} s, "
        f"seed {record.provenance['seed']}, scenario {record.provenance['scenario_hash']}"
    )
    table = Table(box=None, padding=(0, 2, 0, 0))
    for title, justify in (("", "left"), ("mean", "right"), ("95 % interval", "right"), ("unit", "left")):
        table.add_column(title, justify=justify)  # type: ignore[arg-type]
    for name, metric in METRICS.items():
        if len(scenario["targets"]) > 1 or name not in _OF_SEVERAL_TARGETS:
            table.add_row(_label(name), *_cells(record.estimate(name)), _unit(metric.unit))
    _add_parts(table, record)
    console.print(table)
    console.print("phi histogram, agents per step from -1 (away) to +1 (toward):")
    console.print("  " + " ".join(f"{agents:.2f}" for agents in record.phi_histogram().sum(axis=0)))
    method = "over runs" if runs > 1 else "by batch means"
    console.print(f"[dim]intervals {method}; {record.provenance['seconds']:g} s[/dim]")


def _add_parts(table: Table, record: Record) -> None:
    """Rows of every fleet, every target and every change of the swarm, where there are several."""
    if len(record.facts.fleets) > 1:
        for name, unit in (("xi_raw", "m/s"), ("stationary", ""), ("speed", "m/s"), ("power", "m^3/s^3")):
            for fleet, value in record.fleet_estimate(name).items():
                table.add_row(f"  {_label(name)}, {fleet}", *_cells(value), unit)
    targets = record.target_estimates()
    for number, target in enumerate(targets if len(targets) > 1 else []):
        for name in ("time_on_target", "first_detection", "reacquisition"):
            table.add_row(f"  {_label(name)}, target {number + 1}", *_cells(target[name]), _unit(METRICS[name].unit))
    for step, change in zip(record.changes(), record.robustness(), strict=True):
        for name in ("before", "during", "after"):
            table.add_row(f"  time on target {name} step {step:,}", *_cells(change[name]), "")
        table.add_row(f"  recovery after step {step:,}", *_cells(change["recovery"]), "s")


def _label(name: str) -> str:
    return _LABELS.get(name, name.replace("_", " "))


def _unit(unit: str) -> str:
    return "" if unit == "1" else unit


def _cells(value: Estimate) -> tuple[str, str]:
    mean = f"{value.mean:.4f}" if math.isfinite(value.mean) else "none"
    return mean, f"{value.ci95[0]:.4f} .. {value.ci95[1]:.4f}" if value.ci95 else "-"


def _target(target: dict[str, object]) -> str:
    if target["kind"] == "waypoint":
        return f"at {target['speed']:g} m/s"
    if "speed" in target:
        return f"{target['kind']} at {target['speed']:g} m/s"
    return f"{target['kind']} {target.get('id') or ''}".strip()
