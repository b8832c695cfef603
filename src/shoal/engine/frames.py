"""A frame: the state at the start of a step, copied."""

from shoal.compiler.kernel import kernel


@kernel
def keep_frame(frames, frame, number, world, swarm, targets):
    """Copy the state at the start of a step."""
    frames.step[frame] = number
    for i in range(world.agents):
        frames.x[frame, i] = swarm.x[i]
        frames.y[frame, i] = swarm.y[i]
        frames.vx[frame, i] = swarm.vx[i]
        frames.vy[frame, i] = swarm.vy[i]
        frames.on_target[frame, i] = swarm.on_target[i]
        frames.alive[frame, i] = swarm.alive[i] > 0.0
        for field in range(swarm.memory.shape[1]):
            frames.memory[frame, i, field] = swarm.memory[i, field]
    for j in range(targets.size):
        frames.target_x[frame, j] = targets[j].x
        frames.target_y[frame, j] = targets[j].y
        frames.target_present[frame, j] = targets[j].present != 0
