"""A fleet of 50 buoys under a seeded adversary, for as long as there is time: `make soak`.

    python benchmarks/soak.py [--minutes 60] [--processes 2] [--first 0] [--steps 3000]
    python benchmarks/soak.py --seed 17       # one seed again, with all that befell it

Prints the buoy-hours done at 10 Hz, and of the first invariant that is broken the seed and the command that replays it;
the exit code is 1 then.
"""

import argparse
import sys
import time
from multiprocessing import get_context

from shoal.run.fleet.soak import STEPS, Outcome, soak

HOUR = 36_000  # steps, at 10 Hz


def main():
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--first", type=int, default=int(time.time()) // 60, help="the first seed; default: the time")
    parser.add_argument("--steps", type=int, default=STEPS, help="of each seed, at 10 Hz")
    parser.add_argument("--seed", type=int, help="run this one only")
    chosen = parser.parse_args()
    if chosen.seed is not None:
        sys.exit(replay(chosen.seed, chosen.steps))
    sys.exit(run(chosen))


def replay(seed, steps):
    """One seed, with everything that befell it."""
    outcome = soak(seed, steps=steps)
    print("\n".join(outcome.events))
    print(said(outcome, steps))
    return int(outcome.broken is not None)


def timed(seed, steps):
    """What comes of a seed, and the processor time that it took [s]."""
    begun = time.process_time()
    outcome = soak(seed, steps=steps)
    return outcome, time.process_time() - begun


def run(chosen):
    """Seed after seed, until time is up or an invariant is broken."""
    begun, steps = time.monotonic(), chosen.steps
    seeds, at_sea, decisions, spent = 0, 0, 0, 0.0
    following = chosen.first + chosen.processes
    with get_context("spawn").Pool(chosen.processes) as pool:
        waiting = [pool.apply_async(timed, (seed, steps)) for seed in range(chosen.first, following)]
        while waiting:
            done = next((each for each in waiting if each.ready()), None)
            if done is None:
                time.sleep(0.05)
                continue
            waiting.remove(done)
            outcome, took = done.get()
            if outcome.broken:
                print(said(outcome, steps))
                return 1
            seeds, at_sea, decisions = seeds + 1, at_sea + outcome.at_sea, decisions + outcome.decisions
            spent += took
            hours = (time.monotonic() - begun) / 3600
            print(
                f"{seeds} seeds, {at_sea / HOUR:.1f} buoy-hours ({decisions / HOUR:.1f} of decisions): "
                f"{at_sea / HOUR / hours:,.0f} ({decisions / HOUR / hours:,.0f}) in an hour, "
                f"{1e6 * spent / decisions:.0f} us of processor per decision",
                flush=True,
            )
            if time.monotonic() < begun + 60.0 * chosen.minutes:
                waiting.append(pool.apply_async(timed, (following, steps)))
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
