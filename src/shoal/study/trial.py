"""Short trial runs of a scenario: whether its agents end at the walls, and whether its time-step is short enough."""

from typing import Any

import numpy as np

from shoal.experiments.paired import paired_difference
from shoal.run.simulate import simulate
from shoal.scenario.schema import Scenario

RUNS = 4
STEPS = 20_000  # of a trial run at most
SHORTEST = 1e-20  # [s] of a time-step that can be halved
FEWEST = 200  # at least: in fewer, nothing settles
_PAIRS = 2.5e8  # pairs of agents x steps of a run: a second, about
ROOM = 1.2  # times the agents on the outer rows of an even cover: that many are at a wall, and it is no fault
MOVED = 0.02  # of the time on target: more is not "the same scenario in finer steps"


def tried(scenario: Scenario) -> list[str]:
    """Return what short trial runs show, in sentences; they take some seconds.

    Raises
    ------
    TrackError, StrategyError : what cannot run
    """
    steps = min(scenario.steps, STEPS, int(_PAIRS / scenario.agents**2))
    if steps < FEWEST <= scenario.steps:
        return [f"no trial runs were made: {scenario.agents:,} agents are too many for a quick look"]
    if steps < FEWEST or scenario.time_step < SHORTEST:
        return []
    coarse = scenario.with_(steps=steps)
    record = simulate(coarse, runs=RUNS, every=max(1, steps // 200))
    odd = [*_walls(coarse, record), *_finer(coarse, record)]
    fine = "show nothing odd: agents are not at the walls, and the time-step is short enough"
    return odd or [f"{RUNS} trial runs of {steps:,} steps, and {RUNS} with half the time-step, {fine}"]


def _walls(scenario: Scenario, record: Any) -> list[str]:
    """Whether most agents are at a wall in the second half of the runs, more than an even cover has there."""
    area, shares = scenario.area, []
    half_x, half_y = area.width / 2 - area.agent_margin, area.height / 2 - area.agent_margin
    for frames in record.trajectories.values():
        late = slice(len(frames.x) // 2, None)
        x, y, alive = np.abs(frames.x[late]), np.abs(frames.y[late]), frames.alive[late]
        at_wall = (x >= (1 - 1e-9) * half_x) | (y >= (1 - 1e-9) * half_y)
        shares.append(float((at_wall & alive).sum() / max(alive.sum(), 1)))
    share, edge = float(np.mean(shares)), 4 * (scenario.agents**0.5 - 1) / scenario.agents
    if share <= max(0.5, ROOM * edge):
        return []
    return [
        f"in {RUNS} trial runs of {scenario.steps:,} steps, {share:.0%} of the agents were at a wall: do the "
        "lengths of the strategy suit the area?"
    ]


def _finer(scenario: Scenario, record: Any) -> list[str]:
    """Whether half the time-step gives another time on target: an estimate by paired runs."""
    finer = scenario.with_(
        time_step=scenario.time_step / 2,
        steps=2 * scenario.steps,
        losses=[_later(each) for each in scenario.losses],
        joins=[_later(each) for each in scenario.joins],
    )
    halved = simulate(finer, runs=RUNS).estimate("time_on_target").runs
    before = record.estimate("time_on_target").runs
    moved = paired_difference(halved, before)
    error = (moved.ci95[1] - moved.ci95[0]) / 2 if moved.ci95 else 0.0
    if not abs(moved.mean) > max(MOVED, error):
        return []
    return [
        f"half the time_step moves the time on target by {moved.mean:+.2f} +- {error:.2f} (an estimate, by {RUNS} "
        f"trial runs of {scenario.steps:,} steps): what acts once per step, such as inertia, social and the max_turn "
        "of a target, acts more often then; compare only what has one time_step"
    ]


def _later(change: Any) -> dict[str, Any]:
    """A loss or a join at the same time in half the time-steps."""
    return {**vars(change), "step": min(2 * change.step, 10**12)}
