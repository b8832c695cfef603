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
        table.add_row(
            _LABELS.get(name, name.replace("_", " ")),
            *_cells(record.estimate(name)),
            "" if metric.unit == "1" else metric.unit,
        )
    if len(facts.fleets) > 1:
        for fleet, value in record.fleet_estimate("xi_raw").items():
            table.add_row(f"  Xi, not normalised, {fleet}", *_cells(value), "m/s")
        for fleet, value in record.fleet_estimate("stationary").items():
            table.add_row(f"  stationary, {fleet}", *_cells(value), "")
    console.print(table)
    console.print("phi histogram, agents per step from -1 (away) to +1 (toward):")
    console.print("  " + " ".join(f"{agents:.2f}" for agents in record.phi_histogram().sum(axis=0)))
    method = "over runs" if runs > 1 else "by batch means"
    console.print(f"[dim]intervals {method}; {record.provenance['seconds']:g} s[/dim]")


def _cells(value: Estimate) -> tuple[str, str]:
    mean = f"{value.mean:.4f}" if math.isfinite(value.mean) else "none"
    return mean, f"{value.ci95[0]:.4f} .. {value.ci95[1]:.4f}" if value.ci95 else "-"


def _target(target: dict[str, object]) -> str:
    if target["kind"] == "waypoint":
        return f"at {target['speed']:g} m/s"
    if "speed" in target:
        return f"{target['kind']} at {target['speed']:g} m/s"
    return f"{target['kind']} {target.get('id') or ''}".strip()
