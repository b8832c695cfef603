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


def kept_inside(fence: Fence, x: float, y: float, vx: float, vy: float, horizon: float) -> tuple[float, float]:
    """Return the velocity that a vehicle is told instead of the wanted one: in `horizon` seconds it is still inside.

    What would take it over an edge of the rectangle is cut, the rest stays: v_n <= d / horizon, d the way to the edge.
    At the shore it slides along, or stops. From outside it comes straight back, at top speed.

    Parameters
    ----------
    fence : where it may be
    x, y : where it is [m]
    vx, vy : the velocity wanted [m/s]; one that is not finite stops it
    horizon : for how long it may go on with what it was told last [s]
    """
    if not (math.isfinite(vx) and math.isfinite(vy)):
        return 0.0, 0.0
    home_x, home_y = _homeward(fence, x, y)
    if home_x or home_y:
        return fence.top_speed * home_x, fence.top_speed * home_y
    speed = math.hypot(vx, vy)
    scale = min(1.0, fence.top_speed / speed) if speed > 0.0 else 0.0
    vx, vy = _within(fence, x, y, scale * vx, scale * vy, horizon)
    share = _share_afloat(fence, x, y, vx * horizon, vy * horizon)
    if share == 1.0:
        return vx, vy
    along_x, along_y = _within(fence, x, y, *_along_shore(fence, x, y, vx, vy, share, horizon), horizon)
    if _share_afloat(fence, x, y, along_x * horizon, along_y * horizon) == 1.0:
        return along_x, along_y
    return share * vx, share * vy


def _homeward(fence: Fence, x: float, y: float) -> tuple[float, float]:
    """The direction, of length 1, of the nearest place inside; (0, 0) inside, and where there is no telling."""
    dx = max(-fence.half_x - x, 0.0) or min(fence.half_x - x, 0.0)
    dy = max(-fence.half_y - y, 0.0) or min(fence.half_y - y, 0.0)
    if fence.depth is not None and not (dx or dy) and fence.depth(x, y) < 0.0:
        dx, dy = _seaward(fence.depth, fence.cell, x, y)
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size > 0.0 else (0.0, 0.0)


def _within(fence: Fence, x: float, y: float, vx: float, vy: float, horizon: float) -> tuple[float, float]:
    """A velocity that ends inside the rectangle, from inside."""
    vx = min(max(vx, (-fence.half_x - x) / horizon), (fence.half_x - x) / horizon)
    vy = min(max(vy, (-fence.half_y - y) / horizon), (fence.half_y - y) / horizon)
    return vx, vy


def _share_afloat(fence: Fence, x: float, y: float, dx: float, dy: float) -> float:
    """How much of a way is on the water, 0 to 1: in strides that cannot reach the shore, and short ones close to it."""
    length = math.hypot(dx, dy)
    if fence.depth is None or length == 0.0:
        return 1.0
    gone, safe = 0.0, 0.0
    while True:
        depth = fence.depth(x + dx * gone, y + dy * gone)
        if depth < 0.0:
            return safe
        safe = gone
        if gone == 1.0:
            return 1.0
        gone = min(1.0, gone + max(0.5 * depth, _FINEST * fence.cell) / length)


def _along_shore(
    fence: Fence, x: float, y: float, vx: float, vy: float, share: float, horizon: float
) -> tuple[float, float]:
    """The velocity without what goes ashore where the way of `horizon` seconds leaves the water."""
    assert fence.depth is not None  # or all of the way would be afloat
    far = share * horizon
    out_x, out_y = _seaward(fence.depth, fence.cell, x + vx * far, y + vy * far)
    ashore = min((1.0 - share) * (vx * out_x + vy * out_y), 0.0)
    return vx - ashore * out_x, vy - ashore * out_y


def _seaward(depth: Callable[[float, float], float], cell: float, x: float, y: float) -> tuple[float, float]:
    """The direction, of length 1, in which the shore recedes fastest; (0, 0) where it does nowhere."""
    half = 0.5 * cell
    dx = depth(x + half, y) - depth(x - half, y)
    dy = depth(x, y + half) - depth(x, y - half)
    size = math.hypot(dx, dy)
    return (dx / size, dy / size) if size > 0.0 else (0.0, 0.0)
