"""The metrics of a single moment: Xi and phi of one frame, by the kernels that add them up over a run."""

from shoal.compiler.kernel import entry_kernel
from shoal.metrics.heading_bearing import tally_heading_bearing
from shoal.metrics.velocity_fluctuation import tally_velocity_fluctuation


@entry_kernel
def tally_moment(tally, swarm, targets, active, a, b, c):
    """Add one moment to a tally of a single batch; phi where a target is there.

    swarm : x, y, vx, vy, command_x, command_y, max_speed, alive : (N,); fleet_end : (F,)
    targets : (T,) records of x, y, present
    active : agents that are there; a, b, c : (N,) scratch
    """
    agents = swarm.x.size
    tally.steps[0] += 1.0
    tally_velocity_fluctuation(tally, 0, swarm, agents, active, a)
    present = False
    for target in targets:
        present |= target.present != 0
    if present:
        tally.present[0] += 1.0
        tally_heading_bearing(tally, 0, swarm, agents, targets, a, b, c)
