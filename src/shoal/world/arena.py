"""The facts of the world that no agent controls, as scalars for the kernels."""

from typing import NamedTuple


class World(NamedTuple):
    """Arena and rules of one run. Lengths [m], times [s].

    clamp_x, clamp_y : agents are kept within +- these
    half_x, half_y : half the sides of the arena, where agents start
    sequential : agents move one after the other, later ones seeing the moved ones
    divide : the paper's printed speed rule, v / vmax, instead of the cap
    inertial : agents have limits of acceleration or turn rate
    imperfect : sensors miss targets or report false ones
    mortal : agents are lost or join during the run
    disturbed : there are disturbances; it is imperfect and mortal then, too
    inexact : agents do not know quite where they are; powered : they have batteries
    flowing : there are currents or wind; windy : wind, and agents that it moves
    coastal : there is land, or a limit to where agents may go; ordered : agents are under orders
    listed : the most neighbors that an agent has where there are many, see world/lists.py; 0 elsewhere
    single : distances and what neighbors exert are in single precision
    skipped : which measurements nobody asks for, a bit of each, see metrics/chosen.py
    target_radius : of the smallest target
    """

    agents: int
    fleets: int
    time_step: float
    half_x: float
    half_y: float
    clamp_x: float
    clamp_y: float
    sequential: bool
    divide: bool
    inertial: bool
    imperfect: bool
    mortal: bool
    disturbed: bool
    inexact: bool
    powered: bool
    flowing: bool
    windy: bool
    coastal: bool
    ordered: bool
    listed: int
    single: bool
    skipped: int
    target_radius: float
