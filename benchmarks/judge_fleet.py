"""Is a fleet in lockstep the simulator? Each strategy that no buoy needs the truth for, over TCP, in several processes.

python benchmarks/judge_fleet.py [STRATEGY ...] [--steps 1000] [--processes 5] [--plain] [--set network.max_age=5 ...]

Prints a row per strategy: both SHA-256 of the trajectory, and how long a step took; exits with 1 if any two differ.
"""

import argparse
import sys
import time
import tomllib

from shoal.record.frames import trajectory_sha256
from shoal.run.fleet.run_fleet import Terms, run_fleet
from shoal.run.simulate import simulate
from shoal.scenario.load import load
from shoal.strategies import CATALOGUE


def main() -> int:
    """Run the table."""
    sighted = sorted(name for name, known in CATALOGUE.items() if known.builtin and not known.informed)
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("strategies", nargs="*", default=sighted)
    options.add_argument("--steps", type=int, default=1000)
    options.add_argument("--processes", type=int, default=5)
    options.add_argument("--plain", action="store_true")
    options.add_argument("--set", action="append", default=[], help="a field by its path; may be repeated")
    asked = options.parse_args()
    changes = {
        path: tomllib.loads(f"is = {value}")["is"] for path, _, value in (each.partition("=") for each in asked.set)
    }
    differ = 0
    for name in asked.strategies or sighted:
        scenario = load("oceans2020", strategy=name, steps=asked.steps, **changes)
        begun: list[float] = []
        record = run_fleet(
            scenario,
            Terms(processes=asked.processes, lockstep=True, plain=asked.plain),
            progress=lambda done, total, begun=begun: begun.append(time.perf_counter()),
        )
        took = 1000 * (begun[-1] - begun[0]) / max(1, len(begun) - 1)
        fleet = trajectory_sha256(record.trajectories[0], asked.steps)
        simulated = trajectory_sha256(simulate(scenario, every=1).trajectories[0], asked.steps)
        differ += fleet != simulated
        words = "equal" if fleet == simulated else "DIFFER"
        print(f"{name:24} {words}  {str(fleet)[:16]} {str(simulated)[:16]}  {took:6.1f} ms/step", flush=True)
    return int(differ > 0)


if __name__ == "__main__":
    sys.exit(main())
