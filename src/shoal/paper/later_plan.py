"""What the reproductions of two later papers run: mixed fleets after a target that flees, and swarms of any density."""

import math

from shoal.experiments.design import Point, grid

EVASIVE, DENSITY = "alife2023", "density2023"  # papers, and their presets
AGENTS = 50
SPEED = "targets.0.speed"
FLEES_AT = (3.0, 5.0)  # [m/s]
SHARES = (0, 15, 30)  # fast buoys of 50
LOW_K = (5, 10, 15)  # of the fast buoys where they hear fewer than the others
UNEQUAL_AT = (20, 30)  # k of all others then
FEWER = (30, 40)  # agents instead of 50
FAST_OF_FEWER = (0, 10, 20, 30)
_EVASIVE_NEIGHBORS = (4, 7, 10, 13, 16, 20, 25, 30, 35, 40, 44, 48)  # with those of UNEQUAL_AT
_EVASIVE_NEIGHBORS_QUICK = (5, 10, 20, 30, 40, 48)

SIDES = (8.0, 11.0, 16.0, 22.0, 32.0, 45.0, 64.0)  # [m] of the area of 50 agents: each density is half of the last
_SIDES_QUICK = (8.0, 16.0, 32.0, 64.0)
DENSITY_NEIGHBORS = (6, 12, 20, 30, 45)
_DENSITY_NEIGHBORS_QUICK = (6, 20, 45)
NUMBERS = (25, 50, 100, 200)  # agents at the same density
AT_SIDES = (11.0, 22.0, 45.0)  # of 50 agents: the densities at which their number varies
NUMBER_NEIGHBORS = 12


def evasive_groups(quick: bool) -> dict[str, tuple[Point, ...]]:
    """Points of each group: curves over k of three fleets; fast buoys that hear fewer than the others; fewer agents."""
    neighbors = _EVASIVE_NEIGHBORS_QUICK if quick else _EVASIVE_NEIGHBORS
    unequal = {"fast": SHARES[1:], "neighbors": UNEQUAL_AT, "fleets.BoB-1.neighbors": LOW_K}
    fewer = {"agents": FEWER, "fast": FAST_OF_FEWER, "neighbors": [UNEQUAL_AT[0]]}
    return {
        "main": tuple(grid({SPEED: FLEES_AT, "fast": SHARES, "neighbors": neighbors})),
        "unequal": tuple(grid({SPEED: FLEES_AT, **unequal})),
        "fewer": tuple(grid({SPEED: FLEES_AT, **fewer})),
    }


def density_groups(quick: bool) -> dict[str, tuple[Point, ...]]:
    """Points of each group: the side of the area of 50 agents; the number of agents at each of three densities."""
    sides, neighbors = (_SIDES_QUICK, _DENSITY_NEIGHBORS_QUICK) if quick else (SIDES, DENSITY_NEIGHBORS)
    groups = {"side": tuple({**_square(side), "neighbors": k} for side in sides for k in neighbors)}
    for side in AT_SIDES:
        groups[f"number/{side:g}"] = tuple(
            {"agents": agents, **_square(side * math.sqrt(agents / AGENTS)), "neighbors": NUMBER_NEIGHBORS}
            for agents in NUMBERS
        )
    return groups


def _square(side: float) -> Point:
    return {"area.width": side, "area.height": side}
