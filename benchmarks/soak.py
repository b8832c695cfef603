"""A fleet of 50 buoys under a seeded adversary, for as long as there is time, on all cores: `make soak`.

    python benchmarks/soak.py [--minutes 60] [--processes CORES] [--first SEED] [--steps 3000]
    python benchmarks/soak.py --seed 17       # one seed again, with all that befell it

Prints the buoy-hours done at 10 Hz, and of the first invariant that is broken the seed and the command that replays it,
after it was replayed; the exit code is 1 then.
"""

import argparse
import os
import resource
import sys
import time
from concurrent.futures import FIRST_COMPLETED, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context

from shoal.run.fleet.soak import STEPS, Outcome, soak

HOUR = 36_000  # steps, at 10 Hz


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--processes", type=int, default=cores(), help="default: as many as there are cores")
    parser.add_argument("--first", type=int, default=int(time.time()) // 60, help="the first seed; default: the time")
    parser.add_argument("--steps", type=int, default=STEPS, help="of each seed, at 10 Hz")
    parser.add_argument("--seed", type=int, help="run this one only")
    chosen = parser.parse_args()
    if chosen.processes < 1 or chosen.steps < 1:
        parser.error("--processes and --steps are 1 or more")
    if chosen.seed is not None:
        sys.exit(replay(chosen.seed, chosen.steps))
    sys.exit(run(chosen))


def cores():
    """How many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def replay(seed, steps):
    """One seed, with everything that befell it."""
    outcome = soak(seed, steps=steps)
    print("\n".join(outcome.events))
    print(said(outcome, steps))
    return int(outcome.broken is not None)


def timed(seed, steps):
    """What comes of a seed, the processor time that it took [s], and the most memory that its process ever had [MB]."""
    begun = time.process_time()
    outcome = soak(seed, steps=steps)
    return outcome, time.process_time() - begun, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024


def pool(processes):
    """Processes that are started anew, not forked; threads of a test stand in for them."""
    return ProcessPoolExecutor(processes, mp_context=get_context("spawn"))


def run(chosen):
    """Seed after seed, until time is up or an invariant is broken; a process that somebody kills ends it, too."""
    begun, steps = time.monotonic(), chosen.steps
    seeds, at_sea, decisions, spent, most = 0, 0, 0, 0.0, 0
    following = chosen.first + chosen.processes
    with pool(chosen.processes) as workers:
        waiting = {workers.submit(timed, seed, steps) for seed in range(chosen.first, following)}
        while waiting:
            ready, waiting = wait(waiting, return_when=FIRST_COMPLETED)
            for done in ready:
                try:
                    outcome, took, memory = done.result()
                except BrokenProcessPool:
                    print(f"a process was killed after {seeds} seeds: see whether there is memory for all of them")
                    return 2
                if outcome.broken:
                    print(said(outcome, steps), flush=True)
                    same = soak(outcome.seed, steps=steps) == outcome
                    print("replayed: the same to the bit" if same else "REPLAYED: SOMETHING ELSE, A FAULT, TOO")
                    return 1
                seeds, at_sea, decisions = seeds + 1, at_sea + outcome.at_sea, decisions + outcome.decisions
                spent, most = spent + took, max(most, memory)
                hours = HOUR * (time.monotonic() - begun) / 3600
                print(
                    f"{seeds} seeds, {at_sea / HOUR:.1f} buoy-hours ({decisions / HOUR:.1f} of decisions): "
                    f"{at_sea / hours:,.0f} ({decisions / hours:,.0f}) an hour on {chosen.processes} cores, "
                    f"{1e6 * spent / max(1, decisions):.0f} us of processor per decision, {most} MB at most each",
                    flush=True,
                )
                if time.monotonic() < begun + 60.0 * chosen.minutes:
                    waiting.add(workers.submit(timed, following, steps))
                    following += 1
    print(f"no invariant broken by seeds {chosen.first} to {following - 1}")
    return 0


def said(outcome: Outcome, steps):
    """The end of a seed in words."""
    text = f"seed {outcome.seed}: {outcome.steps:,} steps, {outcome.decisions:,} decisions, SHA-256 {outcome.sha256}"
    if not outcome.broken:
        return text
    again = f"python benchmarks/soak.py --seed {outcome.seed} --steps {steps}"
    return f"{text}\nBROKEN after step {outcome.steps:,}: {outcome.broken}\nreplay: {again}"


if __name__ == "__main__":
    main()
