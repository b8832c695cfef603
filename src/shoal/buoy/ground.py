"""Between the Earth, as autopilots know it, and the arena's frame, whose axes are not quite east and north."""

import math
from typing import Any

from shoal.buoy.mavlink import Fix
from shoal.core.errors import ScenarioError
from shoal.core.geodesy import ECCENTRICITY_SQUARED, FLATTENING, RADIUS, Frame
from shoal.scenario.schema import Scenario

_ROUNDS = 50  # of an iteration that needs five, but for the other side of the Earth


class GroundFrame(Frame):
    """The same frame as Frame's, one place at a time, without pyproj: 13 MB less on a small computer.

    Within 100 km of the origin the two are within a micrometer.

    Parameters
    ----------
    origin : (lon, lat) [deg] of local (0, 0)
    """

    def __init__(self, origin: tuple[float, float]) -> None:
        self.origin = (float(origin[0]), float(origin[1]))
        self._reduced = _reduced(math.radians(self.origin[1]))

    def local(self, lon: Any, lat: Any) -> tuple[float, float]:
        """Return x and y [m] of longitude and latitude [deg]: Vincenty, Survey Review 23 (176), 1975, inverse."""
        u1, u2 = self._reduced, _reduced(math.radians(float(lat)))
        apart = along = math.remainder(math.radians(float(lon) - self.origin[0]), 2 * math.pi)
        sin1, cos1, sin2, cos2 = math.sin(u1), math.cos(u1), math.sin(u2), math.cos(u2)
        for _ in range(_ROUNDS):
            east, north = cos2 * math.sin(along), cos1 * sin2 - sin1 * cos2 * math.cos(along)
            sin, cos = math.hypot(east, north), sin1 * sin2 + cos1 * cos2 * math.cos(along)
            if sin == 0.0:
                return 0.0, 0.0
            arc = math.atan2(sin, cos)
            alpha = cos1 * cos2 * math.sin(along) / sin
            flat = 1.0 - alpha * alpha
            middle = cos - 2.0 * sin1 * sin2 / flat if flat > 0.0 else 0.0
            before, along = along, apart + _lag(alpha, flat, arc, sin, cos, middle)
            if abs(along - before) < 1e-15:
                break
        size, stretch = _series(flat)
        way = RADIUS * (1.0 - FLATTENING) * size * (arc - _bend(stretch, sin, cos, middle))
        return way * east / sin, way * north / sin

    def geographic(self, x: Any, y: Any) -> tuple[float, float]:
        """Return longitude in [-180, 180) and latitude [deg] of x and y [m]: Vincenty's direct formula."""
        x, y = float(x), float(y)
        way, u1 = math.hypot(x, y), self._reduced
        sin1, cos1 = math.sin(u1), math.cos(u1)
        east, north = (x / way, y / way) if way else (0.0, 1.0)
        first, alpha = math.atan2(math.tan(u1), north), cos1 * east
        flat = 1.0 - alpha * alpha
        size, stretch = _series(flat)
        arc = least = way / (RADIUS * (1.0 - FLATTENING) * size)
        for _ in range(_ROUNDS):
            sin, cos, middle = math.sin(arc), math.cos(arc), math.cos(2.0 * first + arc)
            before, arc = arc, least + _bend(stretch, sin, cos, middle)
            if abs(arc - before) < 1e-15:
                break
        sin, cos, middle = math.sin(arc), math.cos(arc), math.cos(2.0 * first + arc)
        away = sin1 * sin - cos1 * cos * north
        lat = math.atan2(sin1 * cos + cos1 * sin * north, (1.0 - FLATTENING) * math.hypot(alpha, away))
        along = math.atan2(sin * east, cos1 * cos - sin1 * sin * north) - _lag(alpha, flat, arc, sin, cos, middle)
        lon = math.remainder(self.origin[0] + math.degrees(along), 360.0)
        return (lon - 360.0 if lon >= 180.0 else lon), math.degrees(lat)


def _reduced(lat: float) -> float:
    """Reduced latitude, of the sphere around the Earth [rad]."""
    return math.atan((1.0 - FLATTENING) * math.tan(lat))


def _lag(alpha: float, flat: float, arc: float, sin: float, cos: float, middle: float) -> float:
    """By how much longitudes on the sphere differ more than on the Earth [rad]: Vincenty, Eqs. 10 and 11."""
    c = FLATTENING / 16.0 * flat * (4.0 + FLATTENING * (4.0 - 3.0 * flat))
    swing = arc + c * sin * (middle + c * cos * (2.0 * middle * middle - 1.0))
    return (1.0 - c) * FLATTENING * alpha * swing


def _series(flat: float) -> tuple[float, float]:
    """A and B of Vincenty, Eqs. 3 and 4."""
    u = flat * ECCENTRICITY_SQUARED / (1.0 - ECCENTRICITY_SQUARED)
    a = 1.0 + u / 16384.0 * (4096.0 + u * (u * (320.0 - 175.0 * u) - 768.0))
    return a, u / 1024.0 * (256.0 + u * (u * (74.0 - 47.0 * u) - 128.0))


def _bend(b: float, sin: float, cos: float, middle: float) -> float:
    """By how much an arc on the sphere is longer [rad]: Vincenty, Eq. 6."""
    square = 2.0 * middle * middle - 1.0
    last = b / 6.0 * middle * (4.0 * sin * sin - 3.0) * (4.0 * middle * middle - 3.0)
    return b * sin * (middle + b / 4.0 * (cos * square - last))


def frame_of(scenario: Scenario) -> GroundFrame:
    """Return the frame of a scenario.

    Raises
    ------
    ScenarioError : it does not say where it is
    """
    if scenario.area.origin is None:
        raise ScenarioError("area.origin", "is not given", "say at what longitude and latitude (0, 0) lies")
    return GroundFrame(scenario.area.origin)


def in_frame(frame: Frame, fix: Fix) -> tuple[float, float, float, float]:
    """Return x, y [m] and vx, vy [m/s] of a fix in the frame."""
    x, y = frame.local(fix.lon, fix.lat)
    vx, vy = frame.turned(fix.lon, fix.lat, fix.east, fix.north)
    return float(x), float(y), float(vx), float(vy)


def over_ground(frame: Frame, fix: Fix, vx: float, vy: float) -> tuple[float, float]:
    """Return what a velocity of the frame is on the Earth: east and north, true [m/s]; the inverse of Frame.turned.

    Away from the origin the meridians turn, by about 1 degree in 65 km at 60 degrees north, and the frame stretches.
    """
    a, b, c, d = (float(each) for each in frame.turn(fix.lon, fix.lat))
    size = a * d - b * c
    return (d * vx - b * vy) / size, (a * vy - c * vx) / size
