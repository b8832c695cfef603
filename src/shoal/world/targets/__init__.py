"""How targets move: one file per kind. A new kind is a file, a number in record.py and a line in each function here."""

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.world.targets.dive import surface_or_dive
from shoal.world.targets.drift import drift
from shoal.world.targets.evasive import flee
from shoal.world.targets.levy import begin_leg, go_leg
from shoal.world.targets.line import go_straight
from shoal.world.targets.moves import any_heading
from shoal.world.targets.record import DRIFT, EVASIVE, LEVY, LINE, TRACK, WALK, WAYPOINT
from shoal.world.targets.record import KINDS as KINDS
from shoal.world.targets.record import TARGET as TARGET
from shoal.world.targets.record import TARGET_STATE as TARGET_STATE
from shoal.world.targets.record import Tracks as Tracks
from shoal.world.targets.track import follow_track
from shoal.world.targets.walk import walk
from shoal.world.targets.waypoint import begin_waypoint, seek_waypoint


@kernel
def begin_target(target, tracks, draw):
    """Put a target where it starts: uniform in its box, or where its track is at time 0."""
    kind = target.kind
    if kind == TRACK:
        follow_track(target, tracks, 0.0)
    elif kind >= WAYPOINT:
        target.x = target.half_x * (2.0 * uniform(draw, 0) - 1.0)
        target.y = target.half_y * (2.0 * uniform(draw, 1) - 1.0)
        if kind == WAYPOINT:
            begin_waypoint(target, draw)
        elif kind == LEVY:
            begin_leg(target, draw)
        else:
            any_heading(target, draw)
        target.dive_phase = uniform(draw, 9)
        surface_or_dive(target, 0.0)


@kernel
def advance_target(target, tracks, swarm, world, steps_done, draw):
    """Move a target by one time-step; `steps_done` counts the steps completed with this one."""
    kind, time_step = target.kind, world.time_step
    if kind == WAYPOINT:
        seek_waypoint(target, time_step, draw)
    elif kind == TRACK:
        follow_track(target, tracks, steps_done * time_step)
    elif kind == LINE:
        go_straight(target, time_step)
    elif kind == WALK:
        walk(target, time_step, draw)
    elif kind == LEVY:
        go_leg(target, time_step, draw)
    elif kind == EVASIVE:
        flee(target, swarm, world.agents, time_step, draw)
    elif kind == DRIFT:
        drift(target, time_step, draw)
    surface_or_dive(target, steps_done * time_step)


@kernel
def heading_to(target):
    """Velocity of a target, and where it is heading to: its waypoint, or where it is."""
    vx = target.speed * target.heading_x
    vy = target.speed * target.heading_y
    if target.kind == WAYPOINT:
        return vx, vy, target.waypoint_x, target.waypoint_y
    if target.kind == DRIFT:
        return vx + target.current_x, vy + target.current_y, target.x, target.y
    return vx, vy, target.x, target.y
