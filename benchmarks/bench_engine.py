"""How fast the engine is, beside what the processor can do and beside plain NumPy.

    python benchmarks/bench_engine.py [--json FILE]

Machines differ and are shared, so ratios count: all contenders take turns within the same seconds, round after round,
and each keeps its fastest short stretch. The anchor is a C++ program written for speed alone, limit.cpp in
../shared/bench beside this repository; without it, or without g++, its rows are missing. Nothing here passes or fails.
"""

import argparse
import importlib.util
import json
import os
import platform
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numba
import numpy as np

import shoal
from shoal.scenario.load import read_table, scenario_from

REPOSITORY = Path(__file__).resolve().parents[1]
ANCHOR = REPOSITORY.parent / "shared" / "bench" / "limit.cpp"
ANCHOR_FLAGS = ("-O3", "-march=native", "-ffp-contract=off", "-fno-math-errno", "-std=c++17")
USER_STRATEGY = REPOSITORY / "examples" / "my_strategy.py"
NEIGHBORS = (20, 49)  # k
AGENTS = 50
ROUNDS = 8
TURN = 0.5  # [s] of the engine in a round
SHORT_TURN = 0.25  # [s] of those that are not compared with the anchor
ANCHOR_TURN = 1.0  # [s], half of it in f64
STRETCH = 1000  # steps that are timed together, some 5 ms, as long as those of the anchor
ORACLE_STRETCH = 50
THREAD_ROUNDS = 4
THREAD_STEPS = 200_000
PROCESS_ROUNDS = 5
ENDLESS = 10**9  # steps of a scenario that is not run to its end


class Row(NamedTuple):
    """A line of the table: one value, or one for each of NEIGHBORS."""

    what: str
    unit: str
    values: tuple[float | None, ...]


def main() -> None:
    """Measure, print, perhaps store."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the numbers to this file too")
    file = parser.parse_args().json
    begun, load_before = time.perf_counter(), load()
    with tempfile.TemporaryDirectory() as folder:
        anchor, remark = compile_anchor(Path(folder))
        rows = [*step_rows(anchor), *thread_rows(), *process_rows(Path(folder))]
    seconds = time.perf_counter() - begun
    print_table(rows, remark)
    print(f"\n{machine()}; {seconds:.0f} s; load before {load_before}, after {load()}")
    if file:
        file.write_text(json.dumps(report(rows, remark, load_before), indent=1) + "\n", encoding="utf-8")


# --- the cost of a step ---


def step_rows(anchor: Path | None) -> list[Row]:
    """Nanoseconds per agent-step of every contender, and their ratios."""
    best = take_turns(contenders(anchor))

    def row(name: str) -> tuple[float | None, ...]:
        return tuple(best.get((name, k)) for k in NEIGHBORS)

    engine, user = row("engine"), row("user")
    return [
        Row("engine, oceans2020", "ns", engine),
        Row("anchor, limit.cpp", "ns", row("anchor")),
        Row("  engine / anchor", "x", ratio(engine, row("anchor"))),
        Row("NumPy, reference.py", "ns", row("oracle")),
        Row("  NumPy / engine", "x", ratio(row("oracle"), engine)),
        Row("engine, aamas2020 (sequential)", "ns", row("sequential")),
        Row("engine, a user's strategy (wander)", "ns", user),
        Row("  user's / the paper's", "x", ratio(user, engine)),
    ]


def contenders(anchor: Path | None) -> dict[tuple[str, int], Callable[[], float]]:
    """Each by name and k: a function that takes one turn and returns its best ns per agent-step."""
    turns: dict[tuple[str, int], Callable[[], float]] = {}
    for k in NEIGHBORS:
        turns["engine", k] = engine_turn(scenario("oceans2020", k), TURN)
        if anchor:
            turns["anchor", k] = lambda k=k: anchor_turn(anchor, k)  # type: ignore[misc]
        turns["sequential", k] = engine_turn(scenario("aamas2020", k), SHORT_TURN)
        turns["user", k] = engine_turn(scenario("oceans2020", k, {"file": str(USER_STRATEGY)}), SHORT_TURN)
        turns["oracle", k] = oracle_turn(k)
    return turns


def take_turns(turns: dict[tuple[str, int], Callable[[], float]]) -> dict[tuple[str, int], float]:
    """The minimum of each over rounds in which all take part: a noisy minute hits all alike."""
    best = dict.fromkeys(turns, float("inf"))
    for _ in range(ROUNDS):
        for name, turn in turns.items():
            best[name] = min(best[name], turn())
    return best


def engine_turn(chosen: shoal.Scenario, seconds: float) -> Callable[[], float]:
    """Metrics on, no frames kept."""
    simulation = shoal.Simulation(chosen)
    simulation.advance(2000)  # compiles, and leaves the start behind
    return lambda: fastest(lambda: simulation.advance(STRETCH), STRETCH, seconds)


def oracle_turn(k: int) -> Callable[[], float]:
    """`step` of the oracle alone; its draws are made beforehand, as any engine has to make some."""
    oracle = load_module(REPOSITORY / "tests" / "oracle.py")
    chance = np.random.default_rng(1)
    model = oracle.oceans2020(k=k)
    state = oracle.run(model, oracle.random_start(model, chance), 200, chance).state
    draws = chance.random((ORACLE_STRETCH, model.n))
    waypoints = [oracle.random_waypoint(model, chance) for _ in range(ORACLE_STRETCH)]

    def stretch() -> None:
        now = state
        for draw, waypoint in zip(draws, waypoints, strict=True):
            now, _ = oracle.step(model, now, draw, waypoint)

    return lambda: fastest(stretch, ORACLE_STRETCH, SHORT_TURN)


def fastest(stretch: Callable[[], Any], steps: int, seconds: float) -> float:
    """Nanoseconds per agent-step of the fastest stretch of a turn."""
    best, end = float("inf"), time.perf_counter() + seconds
    while time.perf_counter() < end:
        begun = time.perf_counter()
        stretch()
        best = min(best, time.perf_counter() - begun)
    return best / steps / AGENTS * 1e9


def anchor_turn(program: Path, k: int) -> float:
    """The anchor prints its own minimum."""
    printed = subprocess.run([program, str(k), str(ANCHOR_TURN)], capture_output=True, text=True, check=True).stdout
    return float(re.search(r"f64 ([\d.]+) ns", printed)[1])  # type: ignore[index]


def compile_anchor(folder: Path, source: Path = ANCHOR) -> tuple[Path | None, str]:
    """The anchor's program, or None and the reason."""
    compiler = shutil.which("g++")
    if not source.is_file():
        return None, f"no anchor: there is no {source.name} where it should be"
    if compiler is None:
        return None, "no anchor: g++ is not installed"
    program = folder / "limit"
    done = subprocess.run([compiler, *ANCHOR_FLAGS, source, "-o", program], capture_output=True, text=True)
    return (program, "") if done.returncode == 0 else (None, "no anchor: limit.cpp does not compile here")


def scenario(
    preset: str, neighbors: int, strategy: dict[str, str] | None = None, steps: int = ENDLESS
) -> shoal.Scenario:
    """A preset with another k, and perhaps another strategy."""
    table = read_table(preset)
    table["network"]["neighbors"] = neighbors
    table["steps"] = steps
    if strategy:
        table["strategy"] = strategy
    return scenario_from(table)


def load_module(path: Path) -> Any:
    """A Python file that is in no package."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[path.stem] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


# --- threads ---


def thread_rows() -> list[Row]:
    """Throughput of two runs on two threads over that of one run on one."""
    long = scenario("oceans2020", NEIGHBORS[0], steps=THREAD_STEPS)
    one, two = float("inf"), float("inf")
    for _ in range(THREAD_ROUNDS):
        one = min(one, seconds_of(lambda: shoal.simulate(long, runs=1, jobs=1)))
        two = min(two, seconds_of(lambda: shoal.simulate(long, runs=2, jobs=2)))
    return [Row(f"throughput of 2 threads / 1, on {os.cpu_count()} cores", "x", (2 * one / two,))]


def seconds_of(work: Callable[[], Any]) -> float:
    """Wall time of a call."""
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


# --- processes: compiling, starting, memory ---

_FIRST_STEP = """
import time
import shoal
scenario = shoal.load("oceans2020")
simulation = shoal.Simulation
begun = time.perf_counter()
simulation(scenario).advance(1)
print(time.perf_counter() - begun)
"""

# A process of its own: what a child reports as its peak includes the size of the parent that it was forked from.
_WATCH = """
import json, resource, subprocess, sys, time
begun = time.perf_counter()
subprocess.run(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
seconds = time.perf_counter() - begun
print(json.dumps([seconds, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss]))
"""


def process_rows(folder: Path) -> list[Row]:
    """What one waits for: the first step ever, and every start of the command line."""
    cold = {**os.environ, "SHOAL_CACHE_DIR": str(folder / "cache")}
    compiling, loading = (float(python(_FIRST_STEP, env=cold)) for _ in range(2))
    help_, _ = watched("shoal", "--help")
    one_step, _ = watched("shoal", "run", "oceans2020", "--steps", "1")
    run, memory = watched("shoal", "run", "oceans2020")
    return [
        Row("first step, compiled (empty cache)", "s", (compiling,)),
        Row("first step, from the cache", "s", (loading,)),
        Row("shoal --help", "s", (help_,)),
        Row("shoal run oceans2020 --steps 1, warm", "s", (one_step,)),
        Row("shoal run oceans2020 (100,000 steps), warm", "s", (run,)),
        Row("  its peak resident memory", "MiB", (memory,)),
    ]


def watched(*command: str) -> tuple[float, float]:
    """Median wall time [s] and largest peak resident memory [MiB] of a command, started several times."""
    program = shutil.which(command[0], path=str(Path(sys.executable).parent)) or command[0]
    seen = [json.loads(python(_WATCH, program, *command[1:])) for _ in range(PROCESS_ROUNDS)]
    unit = 1 if sys.platform == "darwin" else 1024  # [B] of ru_maxrss
    return statistics.median(seconds for seconds, _ in seen), max(peak for _, peak in seen) * unit / 2**20


def python(code: str, *arguments: str, env: dict[str, str] | None = None) -> str:
    """What a fresh interpreter prints."""
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True, env=env).stdout


# --- the table ---


def ratio(over: tuple[float | None, ...], under: tuple[float | None, ...]) -> tuple[float | None, ...]:
    """Value by value; None where one is missing."""
    return tuple(a / b if a and b else None for a, b in zip(over, under, strict=True))


def print_table(rows: list[Row], remark: str) -> None:
    """Aligned plain text; one value stands in the first column."""
    width = max(len(row.what) for row in rows)
    print(f"ns per agent-step of one core: N = {AGENTS}, f64, metrics on, the fastest of {ROUNDS} rounds in turn\n")
    print(f"{'':{width}}  {'':4}" + "".join(f"{f'k = {k}':>10}" for k in NEIGHBORS))
    for row in rows:
        if any(value is not None for value in row.values):
            print(f"{row.what:{width}}  {row.unit:4}" + "".join(f"{shown(value):>10}" for value in row.values))
    if remark:
        print(f"\n{remark}")


def shown(value: float | None) -> str:
    """Three digits or all before the point."""
    if value is None:
        return "-"
    return f"{value:,.0f}" if value >= 100 else f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def report(rows: list[Row], remark: str, load_before: str) -> dict[str, Any]:
    """Everything in plain numbers."""
    return {
        "rows": [
            {"what": row.what.strip(), "unit": row.unit, "values": list(row.values)}
            | ({"neighbors": list(NEIGHBORS)} if len(row.values) > 1 else {})
            for row in rows
        ],
        "remark": remark,
        "machine": machine(),
        "load": {"before": load_before, "after": load()},
    }


def machine() -> str:
    """Versions and kind of processor; no name of the machine."""
    return (
        f"Shoal {shoal.__version__}, Python {platform.python_version()}, numba {numba.__version__}, "
        f"numpy {np.__version__}, {platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    )


def load() -> str:
    """Load averages over 1, 5 and 15 minutes; much above 0 before the bench, others are at work too."""
    return " ".join(f"{value:.1f}" for value in os.getloadavg()) if hasattr(os, "getloadavg") else "unknown"


if __name__ == "__main__":
    main()
