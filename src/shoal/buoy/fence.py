"""The geofence: where a vehicle may be, and what becomes of a velocity that would take it out. Pure functions."""

import math
from collections.abc import Callable
from typing import NamedTuple

from shoal.compiler.kernel import plain
from shoal.scenario.at_sea import open_sea
from shoal.scenario.briefing import briefing, fleet_of
from shoal.scenario.load import Source, load
from shoal.world.sea.land import clearance, land_of

_clearance = plain(clearance)  # a number takes longer to hand to compiled code than to work out
_FINEST = 0.25  # [1] of a cell: the shortest stride along a path near the shore


class Fence(NamedTuple):
    """Where a vehicle may be: within a rectangle around (0, 0), and on the water.

    half_x, half_y : it may go to +- these [m]
    top_speed : it is never told to go faster [m/s]
    depth : how far from a place the shore is, or the edge of the search area, below 0 beyond it [m]; None: open water
    cell : the shore is known to this [m]
    """

    half_x: float
    half_y: float
    top_speed: float
    depth: Callable[[float, float], float] | None = None
    cell: float = 1.0

    def outside(self, x: float, y: float) -> float:
        """How far outside the fence a place is [m], 0 inside."""
        over = math.hypot(max(abs(x) - self.half_x, 0.0), max(abs(y) - self.half_y, 0.0))
        return over if self.depth is None else max(over, -self.depth(x, y), 0.0)


def fence_of(scenario: Source, id: int) -> Fence:
    """Return the fence of an agent: the arena less its margin, the search area, the coast; its fleet's top speed.

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    id : number of the agent, 0 to N - 1

    Raises
    ------
    ScenarioError : there is no such agent
    SeaError : a file of its sea cannot be used
    """
    scenario = load(scenario)
    told = briefing(scenario, id)
    top_speed = scenario.fleets[fleet_of(scenario, id)].max_speed
    opened = open_sea(scenario)
    if opened is None or opened.shore is None:
        return Fence(told.half_x, told.half_y, top_speed)
    shore = opened.shore
    land = land_of(shore.distance, shore.x0, shore.y0, shore.cell)
    return Fence(told.half_x, told.half_y, top_speed, lambda x, y: float(_clearance(land, x, y)), shore.cell)


def kept_inside(
    fence: Fence, x: float, y: float, vx: float, vy: float, horizon: float, slack: float = 0.0
) -> tuple[float, float]:
    """Return the velocity that a vehicle is told instead of the wanted one: in `horizon` seconds it is still inside.

    What would take it over an edge of the rectangle is cut, the rest stays: v_n <= (d - slack) / horizon, d the way to
    the edge. At the shore it slides along, or stops. From outside it comes straight back, at top speed.

    Parameters
    ----------
    fence : where it may be
    x, y : where it was seen last [m]
    vx, vy : the velocity wanted [m/s]; one that is not finite stops it
    horizon : for how long it may go on with what it was told last [s]
    slack : how far it may be from where it was seen [m]
    """
    if not (math.isfinite(vx) and math.isfinite(vy)):
        return 0.0, 0.0
    home_x, home_y = _homeward(fence, x, y)
    if home_x or home_y:
        return fence.top_speed * home_x, fence.top_speed * home_y
    speed = math.hypot(vx, vy)
    scale = min(1.0, fence.top_speed / speed) if speed > 0.0 else 0.0
    most = _Most(*(max(0.0, way - slack) / horizon for way in _ways(fence, x, y)))
    vx, vy = most.cut(scale * vx, scale * vy)
    if fence.depth is None:
        return vx, vy
    closest = min(slack, fence.depth(x, y))  # no closer to the shore than this, or than it is
    share = _share_afloat(fence, closest, x, y, vx * horizon, vy * horizon)
    if share == 1.0:
        return vx, vy
    far = share * horizon
    out_x, out_y = _seaward(fence.depth, fence.cell, x + vx * far, y + vy * far)
    ashore = min((1.0 - share) * (vx * out_x + vy * out_y), 0.0)
    along_x, along_y = most.cut(vx - ashore * out_x, vy - ashore * out_y)
    if _share_afloat(fence, closest, x, y, along_x * horizon, along_y * horizon) == 1.0:
        return along_x, along_y
    return share * vx, share * vy


class _Most(NamedTuple):
    """How fast it may go to each side of the rectangle [m/s]."""

    west: float
    east: float
    south: float
    north: float

    def cut(self, vx: float, vy: float) -> tuple[float, float]:
        """A velocity no faster than that."""
        return min(max(vx, -self.west), self.east), min(max(vy, -self.south), self.north)


def _ways(fence: Fence, x: float, y: float) -> tuple[float, float, float, float]:
    """How far it is to each side of the rectangle [m]: west, east, south, north."""
    return fence.half_x + x, fence.half_x - x, fence.half_y + y, fence.half_y - y


def _homeward(fence: Fence, x: float, y: float) -> tuple[float, float]:
    """The direction, of length 1, of the nearest place inside; (0, 0) inside, and where there is no telling."""
    west, east, south, north = _ways(fence, x, y)
    dx = max(-west, 0.0) + min(east, 0.0)
    dy = max(-south, 0.0) + min(north, 0.0)
    if fence.depth is not None and not (dx or dy) and fence.depth(x, y) < 0.0:
        dx, dy = _seaward(fence.depth, fence.cell, x, y)
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size > 0.0 else (0.0, 0.0)


def _share_afloat(fence: Fence, closest: float, x: float, y: float, dx: float, dy: float) -> float:
    """How much of a way comes no closer to the shore than `closest` [m], 0 to 1.

    In strides that cannot get there, and short ones near it.
    """
    assert fence.depth is not None
    length = math.hypot(dx, dy)
    gone, safe = 0.0, 0.0
    while length > 0.0:
        depth = fence.depth(x + dx * gone, y + dy * gone)
        if depth < closest:
            return safe
        safe = gone
        if gone == 1.0:
            break
        gone = min(1.0, gone + max(0.5 * (depth - closest), _FINEST * fence.cell) / length)
    return 1.0


def _seaward(depth: Callable[[float, float], float], cell: float, x: float, y: float) -> tuple[float, float]:
    """The direction, of length 1, in which the shore recedes fastest; (0, 0) where it does nowhere."""
    half = 0.5 * cell
    dx = depth(x + half, y) - depth(x - half, y)
    dy = depth(x, y + half) - depth(x, y - half)
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size > 0.0 else (0.0, 0.0)
