"""A-CMOMMT: a field of forces, toward agents that see a target, away from those nearby.

Parker, "Distributed algorithms for multi-robot observation of multiple moving targets", Autonomous Robots 12, 2002.
There robots measure where targets are; a binary sensor does not, so here the nearest neighbor on target stands for its
target. The forces are Parker's piecewise linear ones: that of a target pushes within do1, is full from do2 to do3 and
fades out at the predictive tracking range; that of a team mate is full within dr1 and fades out at dr2. Her weight of
targets that others watch already is one number: every known target is watched. Agents on target keep apart
only; where no force acts, a random walk.
"""

import math
from typing import Annotated, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.draws import normal, uniform
from shoal.core.units import Doc, Follows, Meters, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import turned_from_walls


class ACmommt(NamedTuple):
    """Parameters."""

    target_near: Annotated[Meters, Follows("reach"), Range(), Doc("do1: nearer to a target the force pushes away")] = (
        0.5
    )
    target_full: Annotated[Meters, Follows("reach"), Range(), Doc("do2: from here on the attraction is full")] = 1.0
    target_fade: Annotated[Meters, Follows("spacing"), Range(), Doc("do3: from here on it fades")] = 4.0
    target_end: Annotated[
        Meters, Follows("spacing"), Range(), Doc("predictive tracking range: farther targets do not attract")
    ] = 8.0
    target_weight: Annotated[float, Range(), Doc("w: force of a target that somebody watches already")] = 1.0
    mate_full: Annotated[Meters, Follows("spacing"), Range(), Doc("dr1: nearer mates push with full force")] = 1.0
    mate_end: Annotated[Meters, Follows("spacing"), Range(), Doc("dr2: farther mates do not push")] = 3.0
    mate_weight: Annotated[float, Range(), Doc("force of a mate beside that of a target")] = 0.5
    persistence: Annotated[Seconds, Follows("spacing"), Range(open=True), Doc("of the walk where no force acts")] = 5.0


def begin(me, memory, params, draw):
    """Any heading, for want of forces."""
    memory.heading = 2.0 * math.pi * uniform(draw, 0)


def influence(me, other, params):
    """Push of one mate, of size 1 at most."""
    dx = me.x - other.x
    dy = me.y - other.y
    r = math.sqrt(dx * dx + (dy * dy + _SOFTENING))
    push = min(max((params.mate_end - r) / (params.mate_end - params.mate_full), 0.0), 1.0) / r
    return push * dx, push * dy


def decide(me, heard, memory, params, draw):
    """A-CMOMMT: forces toward targets and away from mates.

    v = v_max F / max(|F|, 1) with F = w f(r) e_target + w_mate sum_j g(r_ij) e_ij, f of `pull_of_target`
    """
    force_x = params.mate_weight * heard.sum_x
    force_y = params.mate_weight * heard.sum_y
    if heard.found and not me.on_target:
        dx = heard.x - me.x
        dy = heard.y - me.y
        r = math.sqrt(dx * dx + (dy * dy + _SOFTENING))
        pull = params.target_weight * pull_of_target(r, params) / r
        force_x += pull * dx
        force_y += pull * dy
    size = math.sqrt(force_x * force_x + force_y * force_y)
    if size > _NOTHING:
        memory.heading = math.atan2(force_y, force_x)
        speed = me.max_speed / max(size, 1.0)
        return speed * force_x, speed * force_y
    if me.on_target:
        return 0.0, 0.0
    memory.heading += math.sqrt(2.0 * me.time_step / params.persistence) * normal(draw, 0)
    memory.heading = turned_from_walls(me, memory.heading)
    return me.max_speed * math.cos(memory.heading), me.max_speed * math.sin(memory.heading)


@kernel
def pull_of_target(r, params):
    """Force of a target at distance r: -1 at most within do1, 0 there, 1 from do2 to do3, 0 from the range on."""
    rise = min(max((r - params.target_near) / (params.target_full - params.target_near), -1.0), 1.0)
    fade = min(max((params.target_end - r) / (params.target_end - params.target_fade), 0.0), 1.0)
    return rise * fade


_SOFTENING = 1e-60  # [m^2]
_NOTHING = 1e-9

strategy(
    "a-cmommt",
    params=ACmommt,
    memory={"heading": "rad"},
    begin=begin,
    influence=influence,
    reference="Parker, Autonomous Robots 12, 2002",
)(decide)
