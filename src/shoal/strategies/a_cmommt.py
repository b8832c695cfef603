"""A-CMOMMT: a field of forces, toward those who see a target, away from those who are near.

Parker, "Distributed algorithms for multi-robot observation of multiple moving targets", Autonomous Robots 12, 2002.
There robots measure where targets are; a binary sensor does not, so here a neighbor on target stands for its target.
The forces are Parker's piecewise linear ones: that of a target pushes within d1, is full from d2 to d3 and fades out at
d4 (Fig. 2 there); that of a team mate is full within d1 and fades out at d2 (Fig. 3). Between them and a random walk
where no force acts.
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.draws import normal, uniform
from shoal.core.units import Meters, Says, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import turned_from_walls


class ACmommt(NamedTuple):
    """Parameters."""

    target_near: Annotated[Meters, Says("do1: nearer to a target the force pushes away")] = 0.5
    target_full: Annotated[Meters, Says("do2: from here on the attraction is full")] = 1.0
    target_fade: Annotated[Meters, Says("do3: from here on it fades")] = 4.0
    target_end: Annotated[Meters, Says("predictive tracking range: farther targets do not attract")] = 8.0
    mate_full: Annotated[Meters, Says("dr1: nearer mates push with full force")] = 1.0
    mate_end: Annotated[Meters, Says("dr2: farther mates do not push")] = 3.0
    mate_weight: Annotated[float, Says("force of a mate beside that of a target")] = 0.5
    persistence: Annotated[Seconds, Says("of the walk where no force acts")] = 5.0


def begin(me, memory, params, draw):
    """Any heading, for want of forces."""
    memory.heading = 2.0 * math.pi * uniform(draw, 0)


def influence(me, other, params):
    """Force of one neighbor: as a target if it is on one, and as a mate."""
    dx = other.x - me.x
    dy = other.y - me.y
    r = math.sqrt(dx * dx + (dy * dy + _SOFTENING))
    rise = min(max((r - params.target_near) / (params.target_full - params.target_near), -1.0), 1.0)
    fade = min(max((params.target_end - r) / (params.target_end - params.target_fade), 0.0), 1.0)
    near = min(max((params.mate_end - r) / (params.mate_end - params.mate_full), 0.0), 1.0)
    force = (rise * fade if other.on_target else 0.0) - params.mate_weight * near
    return force * dx / r, force * dy / r


def decide(me, heard, memory, params, draw):
    """A-CMOMMT: local force vectors toward targets and away from team mates (Parker 2002)."""
    size = math.sqrt(heard.sum_x * heard.sum_x + heard.sum_y * heard.sum_y)
    if me.on_target and not heard.found:
        return 0.0, 0.0
    if size > _NOTHING:
        memory.heading = math.atan2(heard.sum_y, heard.sum_x)
        speed = me.max_speed * min(size, 1.0)
        return speed * heard.sum_x / size, speed * heard.sum_y / size
    memory.heading += math.sqrt(2.0 * me.time_step / params.persistence) * normal(draw, 0)
    memory.heading = turned_from_walls(me, memory.heading)
    return me.max_speed * math.cos(memory.heading), me.max_speed * math.sin(memory.heading)


_SOFTENING = 1e-24  # [m^2]
_NOTHING = 1e-9

strategy(
    "a-cmommt",
    params=ACmommt,
    memory={"heading": "rad"},
    begin=begin,
    influence=influence,
    reference="Parker, Autonomous Robots 12, 2002",
)(decide)
