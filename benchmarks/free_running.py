"""Does a fleet by the clock do what simulations of its delay and loss say? `shoal fleet`, then as many runs of it.

    python benchmarks/free_running.py [--seconds 600] [--buoys 50] [--processes 2] [--runs 200] [--plain] [--speed 1]

Runs the buoys of oceans2020 at 10 Hz, as processes by the clock; then simulates as many steps 200 times under the loss
that the fleet measured: a report that came a step late, or not at all, misses its step; one that came within the half
of it in which it is waited for is not late. Prints where the fleet's time on target lies among the runs, the
processor time per buoy and second, and the buoys lost; exits with 1 if it is outside the central 95 %, if a buoy-second
takes more than 10 ms, or if a buoy was lost.
"""

import argparse
import re
import sys
import time

import numpy as np

from shoal.run.fleet.run_fleet import Terms, run_fleet
from shoal.run.simulate import simulate
from shoal.scenario.load import load

MOST = 10.0  # [ms] of processor per buoy and second


def main() -> int:
    """The command line."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--seconds", type=float, default=600.0, help="on the clock")
    options.add_argument("--buoys", type=int, default=50)
    options.add_argument("--processes", type=int, default=2)
    options.add_argument("--runs", type=int, default=200)
    options.add_argument("--speed", type=float, default=1.0)
    options.add_argument("--plain", action="store_true")
    asked = options.parse_args()
    scenario = load("oceans2020", agents=asked.buoys)
    scenario = load(scenario, steps=max(10, round(asked.seconds * asked.speed / scenario.time_step)))
    begun = time.monotonic()
    fleet = run_fleet(scenario, Terms(asked.processes, speed=asked.speed, plain=asked.plain))
    print(f"{scenario.agents} buoys, {scenario.steps:,} steps in {time.monotonic() - begun:.0f} s, start included")
    notes = fleet.provenance["notes"]
    print("\n".join(f"  {note}" for note in notes), flush=True)
    age = number_in(notes, r"on reports ([0-9.]+) steps old")
    loss = number_in(notes, r"; ([0-9.]+)% of the reports") / 100.0
    spent = number_in(notes, r"^([0-9.]+) ms of processor")
    lost = sum(len(each.agents or ()) for each in fleet.scenario.losses)

    share = loss + age * (1.0 - loss)  # a report that is a step late misses its step
    rule = {"max_age": 1} if "max_age" in type(scenario.network).model_fields else {}
    measured = load(scenario, **{"network.loss": share, **{f"network.{name}": value for name, value in rule.items()}})
    runs = simulate(measured, runs=asked.runs)
    values = np.array(runs.estimate("time_on_target").runs)
    low, high = np.quantile(values, [0.025, 0.975])
    found = fleet.estimate("time_on_target").runs[0]
    rank = float((values < found).mean())
    print(f"simulated {asked.runs} times with {share:.3%} of reports missing their step:")
    print(f"time on target {low:.4f} to {high:.4f} (central 95 %)")
    print(f"the fleet's time on target is {found:.4f}: above {rank:.1%} of the runs")
    good = [
        (low <= found <= high, "time on target inside the central 95 %"),
        (spent <= MOST, f"{spent:.2f} ms of processor per buoy-second, {MOST:g} at most"),
        (lost == 0, f"{lost} buoys lost"),
    ]
    for so, words in good:
        print(f"{'ok  ' if so else 'NOT '} {words}")
    return int(not all(so for so, _ in good))


def number_in(notes: list[str], pattern: str) -> float:
    """The number that a pattern finds in the notes of a fleet."""
    return float(next(found[1] for found in (re.search(pattern, note) for note in notes) if found))


if __name__ == "__main__":
    sys.exit(main())
