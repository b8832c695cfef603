"""Searches without an engine: runs whose values are a formula of the scenario, noise included."""

import hashlib

from shoal.experiments.rows import LIST_COLUMNS, now
from shoal.metrics.summary import METRICS


def chance(*key):
    """A number from -1 to 1 that the key decides."""
    return int.from_bytes(hashlib.sha256(repr(key).encode()).digest()[:6], "big") / 2**47 - 1


def runs_of(value, asked=None):
    """Return an executor whose runs have a time on target of value(scenario, run), and a cost as scenarios have it."""

    def execute(tasks):
        for cell, run in tasks:
            scenario = cell.scenario
            if asked is not None:
                asked.append(cell.run_id(run))
            numbers = dict.fromkeys(METRICS, 0.0) | {
                "time_on_target": value(scenario, run),
                "cost": sum(fleet.count * (fleet.cost or 0) for fleet in scenario.fleets),
            }
            told = {"status": "done", "error": "", "started": now(), "seconds": 0.0}
            yield cell, run, {**told, **numbers, **{name: [] for name in LIST_COLUMNS}}

    return execute


def failing(tasks):
    """An executor whose runs all fail."""
    from shoal.experiments.rows import failed_row

    for cell, run in tasks:
        yield cell, run, failed_row("it broke")
