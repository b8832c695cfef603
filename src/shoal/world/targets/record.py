"""All targets of a run lie in one array of records, so that any mixture of kinds compiles once."""

from typing import NamedTuple

import numpy as np

from shoal.core.agents import Floats

KINDS = ("still", "waypoint", "track", "line", "walk", "levy", "evasive", "drift")
WAYPOINT, TRACK, LINE, WALK, LEVY, EVASIVE, DRIFT = range(1, 8)

TARGET_STATE = np.dtype(  # what a target is doing
    [
        ("present", np.int64),  # 0: nobody can detect it
        ("x", np.float64),
        ("y", np.float64),
        ("watchers", np.int64),  # agents that detect it in this step
        ("lost", np.int64),  # steps since somebody did; -1 before the first detection
        ("heading_x", np.float64),  # of kinds that move
        ("heading_y", np.float64),
        ("dive_phase", np.float64),
        # waypoint
        ("waypoint_x", np.float64),
        ("waypoint_y", np.float64),
        ("waypoint_age", np.int64),
        # levy
        ("leg", np.float64),
    ]
)

TARGET_MAKE = np.dtype(  # what is chosen of it
    [
        ("kind", np.int64),
        ("radius", np.float64),
        ("speed", np.float64),
        ("half_x", np.float64),  # of the box that it stays in
        ("half_y", np.float64),
        ("surface_time", np.float64),  # of those that dive; 0: never
        ("dive_time", np.float64),
        # waypoint
        ("turn_cos", np.float64),
        ("turn_sin", np.float64),
        ("waypoint_reach", np.float64),
        ("waypoint_patience", np.int64),
        # walk, drift: how fast the heading diffuses [1/s]; evasive wanders so
        ("diffusion", np.float64),
        # levy
        ("exponent", np.float64),
        ("shortest", np.float64),
        ("longest", np.float64),
        # evasive
        ("sight", np.float64),
        ("wall_sight", np.float64),
        # drift
        ("current_x", np.float64),
        ("current_y", np.float64),
        # track
        ("first_fix", np.int64),
        ("fixes", np.int64),
        ("max_gap", np.float64),
    ]
)

TARGET = np.dtype([*TARGET_STATE.descr, *TARGET_MAKE.descr])  # both, as kernels take them


class Tracks(NamedTuple):
    """The fixes of all recorded targets, one behind the other: time [s] from the start, x, y [m]."""

    time: Floats
    x: Floats
    y: Floats
