"""One replicate of one cell: a scenario and a run number in, one row of numbers out."""

import threading
import time
from typing import Any

from shoal.core.errors import ShoalError
from shoal.experiments.rows import Row, failed_row, now
from shoal.metrics.heading_bearing import fleet_stationary, phi_histogram
from shoal.metrics.summary import METRICS
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.run.facts import facts_of
from shoal.run.simulate import chunk_steps
from shoal.run.simulation import Simulation
from shoal.scenario.load import scenario_from
from shoal.scenario.schema import Scenario


class Stopped(Exception):  # noqa: N818  (an event, not an error)
    """The sweep was asked to end before this run did."""


def replicate(scenario: Scenario, run: int, stop: threading.Event | None = None) -> Row:
    """Run one replicate and return its row: status, error, metrics, histograms, time.

    A run that fails is a row with its error; only `stop` raises (Stopped).
    """
    begun, started = time.perf_counter(), now()
    try:
        numbers = _numbers(scenario, run, stop)
    except Stopped:
        raise
    except Exception as failure:  # whatever a user's strategy does, the night's work goes on
        return failed_row(reason_of(failure), started)
    return {"status": "done", "error": "", **numbers, "started": started, "seconds": time.perf_counter() - begun}


def reason_of(failure: Exception) -> str:
    """What a row says of a run that failed."""
    return str(failure) if isinstance(failure, ShoalError) else repr(failure)


def replicate_table(table: dict[str, Any], run: int) -> Row:
    """`replicate` for a worker on another machine, which gets the scenario as plain data."""
    return replicate(scenario_from(table), run)


def _numbers(scenario: Scenario, run: int, stop: threading.Event | None) -> Row:
    simulation = Simulation(scenario, run)
    chunk = chunk_steps(scenario.agents)
    while simulation.number < scenario.steps:
        if stop is not None and stop.is_set():
            raise Stopped
        simulation.advance(min(chunk, scenario.steps - simulation.number))
    return numbers_of(simulation)


def numbers_of(simulation: Simulation) -> Row:
    """Metrics and histograms of a run that is done."""
    scenario = simulation.scenario
    tally, facts = simulation.tally, facts_of(scenario)
    histogram = phi_histogram(tally)
    return {
        **{name: metric.formula(tally, facts) for name, metric in METRICS.items()},
        "phi_histogram": histogram.sum(axis=0).tolist(),
        "fleet_phi_histogram": histogram.tolist(),
        "fleet_xi_raw": fleet_fluctuation(tally, facts).tolist(),
        "fleet_stationary": fleet_stationary(tally, facts).tolist(),
    }
