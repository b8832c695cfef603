"""The metrics of a single moment: Xi and phi of one frame, by the kernels that add them up over a run."""

from typing import NamedTuple

from shoal.compiler.kernel import entry_kernel
from shoal.core.agents import Floats
from shoal.metrics.contract import Step
from shoal.metrics.heading_bearing import tally_heading_bearing
from shoal.metrics.velocity_fluctuation import tally_velocity_fluctuation


class Agents(NamedTuple):
    """What the two kernels read of a world."""

    agents: int


class Room(NamedTuple):
    """Their working arrays, (N,)."""

    a: Floats
    b: Floats
    c: Floats


@entry_kernel
def tally_moment(tally, world, swarm, targets, scratch):
    """Add one moment to a tally of a single batch; phi where a target is present.

    world, scratch : Agents, Room
    swarm : x, y, vx, vy, command_x, command_y, max_speed, alive : (N,); fleet_end : (F,)
    targets : (T,) records of x, y, present
    """
    step = Step(0, 0, 0)
    tally.steps[0] += 1.0
    tally_velocity_fluctuation(tally, step, world, swarm, targets, scratch)
    present = False
    for target in targets:
        present |= target.present != 0
    tally.present[0] += 1.0 if present else 0.0
    tally_heading_bearing(tally, step, world, swarm, targets, scratch)
