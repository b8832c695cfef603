"""Many steps of one run in one compiled call; the two functions that Python calls."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.core.draws import START_STEP, TARGET_STREAM, split
from shoal.core.kernel import entry_kernel, kernel
from shoal.engine.step import new_scratch, own, step
from shoal.strategies import contract
from shoal.world.placement import place
from shoal.world.targets import begin_target


class Frames(NamedTuple):
    """Room for K frames of a trajectory, each the state at the start of a step. T targets, L lanes.

    step : (K,); x, y, vx, vy, on_target, memory : (K, L); target_x, target_y, target_present : (K, T)
    """

    step: npt.NDArray[np.int64]
    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    on_target: npt.NDArray[np.bool_]
    memory: npt.NDArray[Any]
    target_x: Floats
    target_y: Floats
    target_present: npt.NDArray[np.bool_]


@entry_kernel
def begin_run(world, swarm, targets, tracks, places, params, seed, run):
    """Place agents and targets and set up every agent's memory."""
    run_key = split(split(seed, 0), run)
    place(swarm, world, places, run_key)
    start_key = split(run_key, START_STEP)
    for i in range(world.agents):
        contract.begin(own(swarm, i, world.time_step), swarm.memory[i], params, split(start_key, i))
    for j in range(targets.size):
        begin_target(targets[j], tracks, split(start_key, TARGET_STREAM + j))


@entry_kernel
def rollout(world, swarm, targets, tracks, params, tally, seed, run, first, last, steps, frames, every, tail):
    """Run time-steps first..last of `steps`, in place.

    Frames are kept of every `every`-th step and of all from step `tail` on. Splitting a run into several calls changes
    no bit: what must survive a call is in swarm, targets and tally.
    """
    run_key = split(split(seed, 0), run)
    scratch = new_scratch(world, swarm.x.size)
    batches = tally.steps.size
    frame = 0
    for number in range(first, last):
        if frames.step.size > 0 and (number % every == 0 or number >= tail):
            _keep_frame(frames, frame, number, world, swarm, targets)
            frame += 1
        step_key = split(run_key, number)
        batch = min(number * batches // steps, batches - 1)
        step(world, swarm, targets, tracks, params, tally, batch, step_key, number, scratch)


@kernel
def _keep_frame(frames, frame, number, world, swarm, targets):
    """Copy the state at the start of a step."""
    frames.step[frame] = number
    for i in range(world.agents):
        frames.x[frame, i] = swarm.x[i]
        frames.y[frame, i] = swarm.y[i]
        frames.vx[frame, i] = swarm.vx[i]
        frames.vy[frame, i] = swarm.vy[i]
        frames.memory[frame, i] = swarm.memory[i]
        touches = False
        for target in targets:
            dx = swarm.x[i] - target.x
            dy = swarm.y[i] - target.y
            reach = swarm.sensor_radius[i] + target.radius
            touches |= target.present != 0 and dx * dx + dy * dy <= reach * reach
        frames.on_target[frame, i] = touches
    for j in range(targets.size):
        frames.target_x[frame, j] = targets[j].x
        frames.target_y[frame, j] = targets[j].y
        frames.target_present[frame, j] = targets[j].present != 0
