"""Places on Earth, and one frame of local meters for tracks, sea and exports."""

from typing import Any

import numpy as np

from shoal.core.errors import MissingExtraError

RADIUS, FLATTENING = 6378137.0, 1 / 298.257223563  # WGS84 [m], [-]
ECCENTRICITY_SQUARED = FLATTENING * (2.0 - FLATTENING)

_HALF_STEP = 1e-4  # [deg] of the Jacobian: 11 m, exact to 1e-9


def radii(lat: Any) -> tuple[Any, Any]:
    """Return the radii of curvature M along the meridian and N across it [m] at `lat` [deg]."""
    w = np.sqrt(1.0 - ECCENTRICITY_SQUARED * np.sin(np.radians(lat)) ** 2)
    return RADIUS * (1.0 - ECCENTRICITY_SQUARED) / w**3, RADIUS / w


def meters_per_degree(lat: Any) -> tuple[Any, Any]:
    """Return the lengths of a degree of longitude and of latitude [m] at `lat` [deg]."""
    meridian, normal = radii(lat)
    return np.radians(normal * np.cos(np.radians(lat))), np.radians(meridian)


def near(lon: Any, middle: float) -> Any:
    """Return the same longitudes in [middle - 180, middle + 180) [deg]: continuous around `middle`."""
    turns = np.floor((np.asarray(lon, np.float64) - middle + 180.0) / 360.0)
    return lon - 360.0 * turns


class Frame:
    """Local meters around an origin: azimuthal equidistant on WGS84, distance and bearing from the origin are true.

    Parameters
    ----------
    origin : (lon, lat) [deg] of local (0, 0)

    Raises
    ------
    MissingExtraError : pyproj is not installed
    """

    def __init__(self, origin: tuple[float, float]) -> None:
        self.origin = (float(origin[0]), float(origin[1]))
        self._proj = pyproj().Proj(proj="aeqd", ellps="WGS84", lon_0=self.origin[0], lat_0=self.origin[1])

    def local(self, lon: Any, lat: Any) -> tuple[Any, Any]:
        """Return x and y [m] of longitude and latitude [deg], arrays or numbers."""
        return self._proj(lon, lat)  # type: ignore[no-any-return]

    def geographic(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return longitude in [-180, 180) and latitude [deg] of x and y [m], arrays or numbers; NaN where none is."""
        lon, lat = self._proj(x, y, inverse=True)
        lon = np.where(np.isfinite(lon), np.where(np.asarray(lon) >= 180.0, np.asarray(lon) - 360.0, lon), np.nan)
        lat = np.where(np.isfinite(lat), lat, np.nan)
        return lon[()], lat[()]

    def turned(self, lon: Any, lat: Any, east: Any, north: Any) -> tuple[Any, Any]:
        """Return what a velocity on the Earth is in the frame: the rates of change of x and y [m/s].

        Parameters
        ----------
        lon, lat : [deg] where, not at a pole
        east, north : [m/s] true, of a shape that lon and lat broadcast to
        """
        a, b, c, d = self.turn(lon, lat)
        return a * east + b * north, c * east + d * north

    def turn(self, lon: Any, lat: Any) -> tuple[Any, Any, Any, Any]:
        """Return a, b, c, d with which a velocity is (a east + b north, c east + d north) in the frame.

        (u, v) = J (east / (N cos lat), north / M), J the Jacobian of `local` by central differences, M and N the radii
        of curvature: the turn of the meridians and the stretch of the projection are both in it.

        Parameters
        ----------
        lon, lat : [deg] where, not at a pole
        """
        lon, lat = np.asarray(lon, np.float64), np.asarray(lat, np.float64)
        to_east, to_north = meters_per_degree(lat)
        (x0, y0), (x1, y1) = self.local(lon - _HALF_STEP, lat), self.local(lon + _HALF_STEP, lat)
        (x2, y2), (x3, y3) = self.local(lon, lat - _HALF_STEP), self.local(lon, lat + _HALF_STEP)
        across, along = 2.0 * _HALF_STEP * to_east, 2.0 * _HALF_STEP * to_north
        return (x1 - x0) / across, (x3 - x2) / along, (y1 - y0) / across, (y3 - y2) / along


def pyproj() -> Any:
    """Return the library.

    Raises
    ------
    MissingExtraError : it is not installed
    """
    try:
        import pyproj as library
    except ImportError as error:
        raise MissingExtraError.of("pyproj", "maritime", "going from longitude and latitude to meters") from error
    return library
