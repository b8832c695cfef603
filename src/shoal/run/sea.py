"""What the engine works on of a scenario's sea: fields with polynomials to their grids, land, stations."""

from typing import Any

import numpy as np

from shoal.compiler.kernel import plain
from shoal.core.errors import ScenarioError
from shoal.core.geodesy import Frame, near
from shoal.scenario.at_sea import OpenSea
from shoal.scenario.schema import Scenario
from shoal.world.sea.field import DEGREE, GRID, Field, flow_field, moment, still_field, velocity
from shoal.world.sea.land import Land, land_of, no_land
from shoal.world.sea.sea import Sea, calm_sea

_moment: Any = plain(moment)  # one number takes longer to hand to compiled code than to work out
_velocity: Any = plain(velocity)
EXACT = 5.0  # [m]: how well polynomials must know where a place is on a grid; for 100 km it is some mm
_SAMPLES = 25  # a side, of places that they are fitted to


def build_sea(scenario: Scenario, opened: OpenSea | None) -> Sea:
    """The sea of a run; calm and open where the scenario has none.

    Raises
    ------
    ScenarioError : the arena is too large for local meters
    """
    if scenario.sea is None or opened is None:
        return calm_sea()
    half = max(scenario.area.width, scenario.area.height) / 2
    currents = _field(scenario.sea.currents, opened.currents, opened.frame, half)
    wind = _field(scenario.sea.wind, opened.wind, opened.frame, half)
    return Sea(currents, wind, _land(opened.land), _land(opened.shore))


def _land(raster: Any) -> Land:
    if raster is None or raster.distance.min() >= 0.0:
        return no_land()
    return land_of(raster.distance, raster.x0, raster.y0, raster.cell)


def _field(chosen: Any, read: Any, frame: Frame | None, half: float) -> Field:
    if read is None:
        return still_field() if chosen is None else flow_field(chosen.kind, chosen.numbers())
    size = 1.1 * half  # what leaves the arena a little, such as a target, is still known
    return still_field()._replace(
        kind=GRID,
        values=np.stack((read.u, read.v), axis=-1, dtype=np.float32).ravel(),
        times=np.ascontiguousarray(read.time, np.float64),
        first=np.ascontiguousarray(read.first, np.float64),
        second=np.ascontiguousarray(read.second, np.float64),
        first_step=_even(read.first),
        second_step=_even(read.second),
        coefficients=_to_axes(read, frame, size),
        size=size,
    )


def _even(axis: Any) -> float:
    """The distance between nodes, where it is always the same but for rounding; else 0."""
    steps = np.diff(axis)
    if not steps.size:
        return 0.0
    step = float(steps.mean())
    drift = np.abs(axis - (axis[0] + step * np.arange(axis.size))).max()
    return step if drift < 1e-4 * step else 0.0


def _to_axes(read: Any, frame: Frame | None, size: float) -> Any:
    """Coefficients (2, 15) of the polynomials that give the place along the axes of local x and y.

    Raises
    ------
    ScenarioError : the arena is so large that they would be wrong
    """
    if read.metric or frame is None:
        coefficients = np.zeros((2, 15))
        coefficients[0, 5] = coefficients[1, 1] = size  # x and y themselves
        return coefficients
    coefficients, worst = places_on_earth(frame, size)
    if worst > EXACT:
        raise ScenarioError(
            "area",
            f"of {2 * size / 1.1e3:,.0f} km is too large for gridded data at this latitude: "
            f"places on the grid would be wrong by {worst:.3g} m",
            "make it smaller",
        )
    return coefficients


def places_on_earth(frame: Frame, size: float) -> tuple[Any, float]:
    """Return coefficients (2, 15) of polynomials of local x and y, and how far off they are at most [m].

    They give longitude (continuous around that of the origin) and latitude [deg] of x and y in units of `size`:
    the sum of c x^i y^j, by i and then j, i + j <= 4.

    Parameters
    ----------
    size : [m] they are good from -size to size, along x and along y
    """
    places, between = _places(_SAMPLES), _places(_SAMPLES + 6)
    wanted, true = (_geographic(frame, each, size) for each in (places, between))
    coefficients = np.ascontiguousarray(np.linalg.lstsq(_powers(places), wanted, rcond=None)[0].T)
    meters = np.array([111320.0 * np.cos(np.radians(frame.origin[1])), 111320.0])  # of a degree, about
    return coefficients, float(np.abs((_powers(between) @ coefficients.T - true) * meters).max())


def _places(count: int) -> Any:
    side = np.linspace(-1.0, 1.0, count)
    return np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)


def _geographic(frame: Frame, places: Any, size: float) -> Any:
    lon, lat = frame.geographic(size * places[:, 0], size * places[:, 1])
    return np.stack((near(lon, frame.origin[0]), lat), axis=-1)


def _powers(places: Any) -> Any:
    """x^i y^j, by i and then j, i + j <= DEGREE: the order in which kernels read them."""
    x, y = places[:, 0], places[:, 1]
    return np.stack([x**i * y**j for i in range(DEGREE + 1) for j in range(DEGREE - i + 1)], axis=-1)


def flow_at(field: Field, places: Any, time: float) -> Any:
    """Velocities of a field at places (P, 2) [m] and a time [s], (P, 2) [m/s]."""
    now = _moment(field, time)
    return np.array([_velocity(field, *place, now) for place in places]).reshape(-1, 2)
