"""Runs on a real graphics card: the same bits as on the processor? and how fast? One table.

    python benchmarks/device_check.py              all of it; under four minutes with 16 cores and one H100
    python benchmarks/device_check.py --short      no whole paper, and the paper's run alone

Needs numba-cuda and a card; docs/how-to/gpu.md keeps the last output.
"""

import argparse
import fcntl
import os
import platform
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import product
from typing import Any

import numba
import numba.cuda
import numpy as np

from shoal.core.agents import NEVER
from shoal.engine.gpu.batch import Batch, Work
from shoal.engine.gpu.card import card_name
from shoal.run.on_card import run_on_card
from shoal.run.simulation import Simulation
from shoal.run.state import arrays_of
from shoal.scenario.load import load
from shoal.strategies import CATALOGUE

_cuda: Any = numba.cuda  # it has no types that mypy sees
STOPS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)  # steps at which states are compared
CASES: dict[str, dict[str, Any]] = {
    "the paper's": {},
    "k = 49": {"neighbors": 49},
    "41 agents, k = 6": {"agents": 41, "neighbors": 6},
    "range, loss, delay": {"network.range": "6 m", "network.loss": 0.2, "network.delay": 3},
    "reports every 0.5 s": {"network.interval": "0.5 s"},
    "sensors that err": {"fleets.BoB-1.detection_probability": 0.7, "fleets.BoB-0.false_alarm_probability": 0.01},
    "losses": {"losses": [{"step": 50, "count": 10}]},
    "line": {"targets": [{"kind": "line", "speed": 3.0, "radius": 0.5, "margin": 0.5}]},
}


def compare(stops: tuple[int, ...] = STOPS, runs: int = 4, **changes: Any) -> str:
    """Run on both, and say until when all numbers are the same bits, and by how much they differ then."""
    scenario = load("oceans2020", **changes)
    here = [Simulation(scenario, run) for run in range(runs)]
    there = [Simulation(scenario, run) for run in range(runs)]
    batch = Batch([Work(*each.work()) for each in there])
    before = 0
    for stop in stops:
        batch.advance(before, stop, NEVER, NEVER)
        batch.fetch()
        for each in here:
            each.advance(stop - before)
        for each in there:
            each.worked(stop - before)
        batch.send()
        wrong = [name for pair in zip(here, there, strict=True) for name in differing(*pair)]
        if wrong:
            far = max(distance(*pair) for pair in zip(here, there, strict=True))
            return (
                f"same bits to step {before}; at {stop} up to {far:.1e} m apart ({', '.join(sorted(set(wrong))[:3])})"
            )
        before = stop
    return f"same bits, all of {before} steps"


def differing(one: Simulation, other: Simulation) -> list[str]:
    """Names of the arrays of two states that differ, padding aside."""
    agents = one.scenario.agents
    states = [dict(arrays_of(each.moment)) for each in (one, other)]
    ends = {"swarm": np.s_[:agents], "air": np.s_[:, :agents]}
    cut = [{n: a[ends.get(n.split(".")[0], ...)] for n, a in each.items()} for each in states]
    return [name for name, array in cut[0].items() if not np.array_equal(array, cut[1][name], equal_nan=True)]


def distance(one: Simulation, other: Simulation) -> float:
    """The most that an agent is elsewhere [m]."""
    agents = one.scenario.agents
    return float(np.hypot(*((getattr(one.swarm, c) - getattr(other.swarm, c))[:agents] for c in "xy")).max())


def paper(steps: int, replicates: int) -> list[Simulation]:
    """The runs of the paper's figures: 12 k x 4 target speeds x 2 swarms, each so many times."""
    cells = product(range(10, 46, 3), (3.0, 4.0, 5.0, 6.0), (0, 15))
    scenarios = [load("oceans2020", neighbors=k, target_speed=v, fast=f, steps=steps) for k, v, f in cells]
    return [Simulation(each, run) for each in scenarios for run in range(replicates)]


def speed(steps: int, replicates: int) -> str:
    """Time that many runs of the paper: to set up, and on the card with the way there and back."""
    begun = time.perf_counter()
    simulations = paper(steps, replicates)
    ready = time.perf_counter()
    run_on_card(simulations)
    done = time.perf_counter()
    work = len(simulations) * 50 * steps
    shares = [float(each.tally.on_target.sum() / each.tally.steps.sum()) for each in simulations]
    return (
        f"{work:.2g} agent-steps, {len(simulations)} runs x {steps:,}: {done - ready:.2f} s on the card "
        f"({work / (done - ready) / 1e9:.2f}e9/s), {ready - begun:.2f} s to set up; on target {np.mean(shares):.3f}"
    )


def launches(steps: int = 2_000) -> str:
    """Time the launches alone of the paper's runs, without metrics."""
    from shoal.engine.gpu import step

    for name in ("note_mean_velocity", "look_before_move", "add_before_move", "look_at_graph", "add_linked", "add_own"):
        setattr(step, name, _count_nothing)
    step.add_after_move = _count_nothing
    batch = Batch([Work(*each.work()) for each in paper(steps, 10)])
    batch.advance(0, 50, NEVER, NEVER)  # compiles
    with alone():
        begun = time.perf_counter()
        batch.advance(50, steps, NEVER, NEVER)
        per_step = (time.perf_counter() - begun) / (steps - 50)
    return f"{per_step * 1e6:.1f} us per step of 960 runs; the whole paper would take {per_step * 100_000:.1f} s"


@_cuda.jit(device=True)  # type: ignore[untyped-decorator]
def _count_nothing(*arguments):  # type: ignore[no-untyped-def]
    """In place of metrics."""


@contextmanager
def alone() -> Iterator[None]:
    """One process at a time on the card, so that times are times."""
    with open(os.path.join(tempfile.gettempdir(), "shoal-device-check"), "w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def row(what: str, result: str) -> None:
    """Print a row of the table."""
    print(f"| {what} | {result} |", flush=True)


def apart(what: str, option: str, name: str) -> tuple[str, str]:
    """A row that is made in a process of its own: each compiles a kernel."""
    code = [sys.executable, __file__, option, name]
    found = subprocess.run(code, capture_output=True, text=True, timeout=300, check=False)
    lines = found.stdout.strip().splitlines()
    done = lines and found.returncode == 0
    return what, lines[-1] if done else f"failed: {found.stderr.strip().splitlines()[-1:]}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--case")
    parser.add_argument("--short", action="store_true")
    chosen = parser.parse_args()
    if chosen.case == "no metrics":
        print(launches())
        return
    if chosen.case:
        print(compare(runs=2, **CASES.get(chosen.case, {"strategy": chosen.case})))
        return
    import numba_cuda

    versions = f"numba {numba.__version__}, numba-cuda {numba_cuda.__version__}, numpy {np.__version__}"
    print("| what | result |\n| --- | --- |")
    row("card", card_name())
    row("with", f"{versions}, Python {platform.python_version()}, {os.cpu_count()} cores")
    begun = time.perf_counter()
    Simulation(load("oceans2020")).advance(1)
    row("compiled for the processor", f"{time.perf_counter() - begun:.1f} s")
    begun = time.perf_counter()
    row("same as on the processor: the paper's run", compare())
    row("compiled for the card, and that", f"{time.perf_counter() - begun:.1f} s")
    row("speed, 960 runs", speed(2_000, 10))
    if chosen.short:
        return
    row("speed, the whole paper", speed(100_000, 10))
    same = "same as on the processor"
    others = [("without metrics, launches alone", "no metrics")]
    others += [(f"{same}: {name}", name) for name in list(CASES)[1:]]
    others += [(f"{same}: {name}", name) for name in sorted(CATALOGUE) if name != "knn-pso"]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for found in pool.map(lambda each: apart(each[0], "--case", each[1]), others):
            row(*found)


if __name__ == "__main__":
    main()
