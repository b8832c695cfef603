"""What the sea costs: an agent-step without it, with currents, with land, with both, west of Norway.

    python benchmarks/bench_sea.py [--data ../shared/data] [--against SRC]

All take turns in one process, round after round, and each keeps its fastest stretch of processor time, so that ratios
count: both <= 1.25 times the same run without sea. SRC is a folder of another version of this package: the run without
sea takes turns in a process of each, <= 1.02 times. Nothing here passes or fails.
"""

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import shoal

REPOSITORY = Path(__file__).resolve().parents[1]
ORIGIN, WIDTH, HEIGHT = (4.85, 60.6), 60e3, 100e3
FAR_OFF = [[[1e6, 0.0], [1.1e6, 0.0], [1e6, 1e5]]]  # land that nobody meets
START = "2015-11-16T02:00:00Z"
CURRENTS = "norway_west/norway_west_currents_norkyst800_2015-11-16.nc"
COAST = "norway_west/norway_west_coastline_osm.geojson"
RANGES = (None, "15 km")
TIME_STEPS = (10.0, 60.0)  # [s]
HOURS = 60.0
STRETCH = 1000  # steps that are timed together
ROUNDS = 12
PAIRS = 4  # of processes


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--data", type=Path, default=REPOSITORY.parent / "shared" / "data")
    parser.add_argument("--against", type=Path, metavar="SRC", help="folder with another version of the package")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.worker:
        work()
        return
    for reach in RANGES:
        for time_step in TIME_STEPS:
            print_table(reach, time_step, chosen.data)
    if chosen.against:
        compare(chosen.against)


def print_table(reach: str | None, time_step: float, data: Path) -> None:
    """Nanoseconds per agent-step of each kind of sea, and times the run without."""
    currents, coast = {"currents": str(data / CURRENTS)}, {"coast": str(data / COAST)}
    open_water = {**currents, "coast": FAR_OFF}  # else nodes without values are land
    seas = {"no sea": None, "currents": open_water, "land": coast, "both": {**currents, **coast}}
    turns = {name: turn(reach, time_step, sea) for name, sea in seas.items()}
    best = dict.fromkeys(turns, float("inf"))
    for _ in range(ROUNDS):
        for name, take in turns.items():
            best[name] = min(best[name], take())
    print(f"\nrange {reach or 'without end'}, time-step {time_step:g} s; load {os.getloadavg()[0]:.1f}")
    for name, ns in best.items():
        print(f"  {name:10} {ns:6.1f} ns  {ns / best['no sea']:5.3f} x", flush=True)


def turn(reach: str | None, time_step: float, sea: dict[str, Any] | None) -> Callable[[], float]:
    """A function that runs a stretch, from where the last ended, and returns ns per agent-step."""
    changes: dict[str, Any] = {"sea": {"start": START, **sea}} if sea else {}
    if reach:
        changes["network.range"] = reach
    scenario = shoal.load(
        "oceans2020",
        steps=int(HOURS * 3600 / time_step),
        time_step=time_step,
        area={"width": WIDTH, "height": HEIGHT, "origin": ORIGIN},
        neighbors=20,
        **changes,
    )
    run = [shoal.Simulation(scenario)]
    run[0].advance(200)

    def take() -> float:
        if run[0].number + STRETCH > scenario.steps:
            run[0] = shoal.Simulation(scenario)
        begun = time.process_time()
        run[0].advance(STRETCH)
        return (time.process_time() - begun) / (STRETCH * scenario.agents) * 1e9

    return take


def compare(source: Path) -> None:
    """The run without sea, of this version and of another, in processes that take turns."""
    sources = {"this": REPOSITORY / "src", "other": source}
    best = {(name, reach): float("inf") for name in sources for reach in RANGES}
    for _ in range(PAIRS):
        workers = {name: start(folder) for name, folder in sources.items()}
        for _ in range(ROUNDS):
            for name, worker in workers.items():
                for reach, ns in zip(RANGES, ask(worker), strict=True):
                    best[name, reach] = min(best[name, reach], ns)
        for worker in workers.values():
            worker.stdin.close()
            worker.wait()
    print(f"\nwithout sea, against {source}; load {os.getloadavg()[0]:.1f}")
    for reach in RANGES:
        this, other = (best[name, reach] for name in sources)
        print(f"  range {reach or 'without end'}: {this:6.1f} ns / {other:6.1f} ns = {this / other:5.3f}")


def start(source: Path) -> Any:
    """A process that works with the package of a folder."""
    environment = {**os.environ, "PYTHONPATH": str(source)}
    command = [sys.executable, __file__, "--worker"]
    return subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def ask(worker: Any) -> list[float]:
    """Let it take a turn of each range; ns per agent-step."""
    print("go", file=worker.stdin, flush=True)
    return [float(each) for each in worker.stdout.readline().split()]


def work() -> None:
    """Take a turn whenever asked."""
    turns = [turn(reach, TIME_STEPS[0], None) for reach in RANGES]
    for _ in sys.stdin:
        print(*(take() for take in turns), flush=True)


if __name__ == "__main__":
    main()
