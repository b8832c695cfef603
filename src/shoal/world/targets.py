"""How targets move: along random waypoints, not at all, or along a recorded track.

All targets of a run lie in one array of records, so that any mixture of kinds compiles once. A new kind is a number
in KINDS, its fields in TARGET and a branch in `advance`.
"""

import math
from typing import NamedTuple

import numpy as np

from shoal.core.agents import Floats
from shoal.core.draws import split, uniform
from shoal.core.kernel import kernel

KINDS = ("still", "waypoint", "track")
_WAYPOINT = 1
_TRACK = 2

TARGET = np.dtype(
    [
        ("kind", np.int64),
        ("present", np.int64),  # 0: nobody can detect it
        ("x", np.float64),
        ("y", np.float64),
        ("radius", np.float64),
        ("speed", np.float64),
        ("watchers", np.int64),  # agents that detect it in this step
        ("lost", np.int64),  # steps since somebody did; -1 before the first detection
        # waypoint
        ("heading_x", np.float64),
        ("heading_y", np.float64),
        ("waypoint_x", np.float64),
        ("waypoint_y", np.float64),
        ("waypoint_age", np.int64),
        ("half_x", np.float64),
        ("half_y", np.float64),
        ("turn_cos", np.float64),
        ("turn_sin", np.float64),
        ("waypoint_reach", np.float64),
        ("waypoint_patience", np.int64),
        # track
        ("first_fix", np.int64),
        ("fixes", np.int64),
        ("max_gap", np.float64),
    ]
)


class Tracks(NamedTuple):
    """The fixes of all recorded targets, one behind the other: time [s] from the start, x, y [m]."""

    time: Floats
    x: Floats
    y: Floats


@kernel
def begin_target(target, tracks, draw):
    """Put a target where it starts: uniform in its box, or where its track is at time 0."""
    if target.kind == _WAYPOINT:
        target.x = target.half_x * (2.0 * uniform(draw, 0) - 1.0)
        target.y = target.half_y * (2.0 * uniform(draw, 1) - 1.0)
        _take_waypoint(target, split(draw, 2))
        dx = target.waypoint_x - target.x
        dy = target.waypoint_y - target.y
        distance = math.sqrt(dx * dx + dy * dy)
        target.heading_x = dx / distance if distance > 0.0 else 1.0
        target.heading_y = dy / distance if distance > 0.0 else 0.0
    elif target.kind == _TRACK:
        _follow_track(target, tracks, 0.0)


@kernel
def advance_target(target, tracks, swarm, world, steps_done, draw):
    """Move a target by one time-step; `steps_done` counts the steps completed with this one."""
    time_step = world.time_step
    if target.kind == _WAYPOINT:
        _seek_waypoint(target, time_step, draw)
    elif target.kind == _TRACK:
        _follow_track(target, tracks, steps_done * time_step)


@kernel
def heading_to(target):
    """Velocity of a target, and where it is heading to: its waypoint, or where it is."""
    if target.kind == _WAYPOINT:
        vx = target.speed * target.heading_x
        vy = target.speed * target.heading_y
        return vx, vy, target.waypoint_x, target.waypoint_y
    return 0.0, 0.0, target.x, target.y


@kernel
def _seek_waypoint(target, time_step, draw):
    """Turn toward the waypoint, at most so far per step, and go on; take a new one when near or tired of it."""
    dx = target.waypoint_x - target.x
    dy = target.waypoint_y - target.y
    distance = math.sqrt(dx * dx + dy * dy)
    if distance > 0.0:
        dx /= distance
        dy /= distance
        along = target.heading_x * dx + target.heading_y * dy
        across = target.heading_x * dy - target.heading_y * dx
        if along >= target.turn_cos:
            target.heading_x = dx
            target.heading_y = dy
        else:
            turn_sin = target.turn_sin if across >= 0.0 else -target.turn_sin
            heading_x = target.turn_cos * target.heading_x - turn_sin * target.heading_y
            target.heading_y = turn_sin * target.heading_x + target.turn_cos * target.heading_y
            target.heading_x = heading_x
    target.x += target.speed * time_step * target.heading_x
    target.y += target.speed * time_step * target.heading_y
    target.waypoint_age += 1
    dx = target.waypoint_x - target.x
    dy = target.waypoint_y - target.y
    near = dx * dx + dy * dy < target.waypoint_reach * target.waypoint_reach
    if near or target.waypoint_age >= target.waypoint_patience:
        _take_waypoint(target, draw)


@kernel
def _take_waypoint(target, draw):
    """Choose a waypoint uniform in the target's box."""
    target.waypoint_x = target.half_x * (2.0 * uniform(draw, 0) - 1.0)
    target.waypoint_y = target.half_y * (2.0 * uniform(draw, 1) - 1.0)
    target.waypoint_age = 0


@kernel
def _follow_track(target, tracks, time):
    """Interpolate between the two fixes around `time`; outside the track and in long gaps the target is not there."""
    first = target.first_fix
    last = first + target.fixes - 1
    target.present = 0
    if time < tracks.time[first] or time > tracks.time[last]:
        return
    before = first
    after = last
    while after - before > 1:
        middle = (before + after) // 2
        if tracks.time[middle] <= time:
            before = middle
        else:
            after = middle
    if tracks.time[after] <= time:
        before = after
    span = tracks.time[after] - tracks.time[before]
    elapsed = time - tracks.time[before]
    if elapsed > 0.0 and span > target.max_gap:
        return
    share = elapsed / span if span > 0.0 else 0.0
    target.x = tracks.x[before] + share * (tracks.x[after] - tracks.x[before])
    target.y = tracks.y[before] + share * (tracks.y[after] - tracks.y[before])
    target.present = 1
