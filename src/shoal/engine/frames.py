"""A frame: what the engine knows at the start of a step, and who hears whom in it, copied."""

from shoal.compiler.kernel import kernel
from shoal.world.neighbors import linked


@kernel
def keep_frame(frames, frame, number, world, swarm, targets):
    """Copy the state at the start of a step."""
    frames.step[frame] = number
    for i in range(world.agents):
        frames.x[frame, i] = swarm.x[i]
        frames.y[frame, i] = swarm.y[i]
        frames.vx[frame, i] = swarm.vx[i]
        frames.vy[frame, i] = swarm.vy[i]
        frames.command_x[frame, i] = swarm.command_x[i]
        frames.command_y[frame, i] = swarm.command_y[i]
        frames.on_target[frame, i] = swarm.on_target[i]
        frames.engaged[frame, i] = swarm.engaged[i]
        frames.neighbors[frame, i] = swarm.neighbors[i]
        frames.alive[frame, i] = swarm.alive[i] > 0.0
        for field in range(swarm.memory.shape[1]):
            frames.memory[frame, i, field] = swarm.memory[i, field]
    for j in range(targets.size):
        frames.target_x[frame, j] = targets[j].x
        frames.target_y[frame, j] = targets[j].y
        frames.target_present[frame, j] = targets[j].present != 0


@kernel
def keep_links(frames, frame, links, first, agents):
    """Copy whom the agents from `first` on hear, as bits (core/links.py)."""
    width = frames.links.shape[2]
    for lane in range(min(links.reach.size, agents - first)):
        for byte in range(width):
            bits = 0
            for j in range(8 * byte, min(8 * byte + 8, agents)):
                bits |= (1 if linked(links, j, lane) else 0) << (j - 8 * byte)
            frames.links[frame, first + lane, byte] = bits
