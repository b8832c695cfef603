"""What all peers run: the paper's swarm in lengths of arena units and times of steps, its target, and the clock.

The step is that of src/shoal/reference.py, in the same units: 15 fast and 35 slow agents, k = 20, 1 m/s is 0.1.
"""

import json
import math
import sys
import time
from collections.abc import Callable

import numpy as np

N, K = 50, 20
MAX_SPEED = np.where(np.arange(N) < 15, 0.26, 0.1)
OMEGA, C = 1.0, 0.5
A_START, A_MIN, A_MAX, A_STEP = 0.5013256549262001, 0.375, 1.5, 0.01
RHO = 1.0  # radius of the target
WALL = 8.5  # agents stay within plus or minus this
SPEED, TURN, MARGIN = 0.3, math.radians(20.0), 8.0  # of the target; its waypoints lie within plus or minus MARGIN
SEED = int(sys.argv[2])
BEFORE = 500  # steps that are not counted
REACHED, PATIENCE = 1.5, 200  # distance and steps after which it takes another waypoint


class Target:
    """R targets that go from waypoint to waypoint, one for each replicate: positions x (R, 2)."""

    def __init__(self, replicates: int, chance: np.random.Generator) -> None:
        self._chance = chance
        self.x = np.zeros((replicates, 2))
        self._waypoint = self._anywhere(replicates)
        self._heading = np.zeros(replicates)
        self._age = np.zeros(replicates, int)

    def move(self) -> None:
        """Turn toward the waypoint as far as it may, go on, and take another where that is reached, or takes long."""
        there = self._waypoint - self.x
        turn = np.arctan2(there[:, 1], there[:, 0]) - self._heading
        self._heading += np.clip((turn + np.pi) % (2 * np.pi) - np.pi, -TURN, TURN)
        self.x = self.x + SPEED * np.stack([np.cos(self._heading), np.sin(self._heading)], axis=1)
        self._age += 1
        done = (np.hypot(*(self._waypoint - self.x).T) < REACHED) | (self._age >= PATIENCE)
        self._waypoint[done] = self._anywhere(int(done.sum()))
        self._age[done] = 0

    def _anywhere(self, count: int) -> np.ndarray:
        return self._chance.uniform(-MARGIN, MARGIN, (count, 2))


def start(replicates: int, chance: np.random.Generator) -> np.ndarray:
    """Where agents begin, (R, N, 2)."""
    return chance.uniform(-WALL, WALL, (replicates, N, 2))


def measure(advance: Callable[[int], float], steps: int, replicates: int, precision: str, version: str) -> None:
    """Print, as JSON, the nanoseconds of processor time per agent-step of the fastest call, and time on target of all.

    `advance` makes so many steps of all replicates, in 50 to 100 ms, so that all have as good a chance of a quiet
    moment, and returns at how many of them anybody was on target, summed over replicates. The first calls are not
    timed; the run goes on for the seconds that the command line says, then long enough for time on target to be known
    within a hundredth or two, if that is no more than four times as long.
    """
    seconds = float(sys.argv[1])
    for _ in range(max(1, BEFORE // steps)):
        advance(steps)  # compiles, and leaves the start behind
    best, done, on_target, begun = float("inf"), 0, 0.0, time.perf_counter()
    while (spent := time.perf_counter() - begun) < seconds or (done * replicates < 40_000 and spent < 4 * seconds):
        before = time.process_time()
        on_target += advance(steps)
        best = min(best, time.process_time() - before)
        done += steps
    found = {"ns": best / steps / replicates / N * 1e9, "on_target": on_target / done / replicates}
    print(json.dumps(found | {"replicates": replicates, "precision": precision, "version": version}))
