"""One local frame: meters around an origin on the Earth."""

from importlib import import_module
from typing import Any

import numpy as np

from shoal.core.errors import MissingExtraError


class Frame:
    """The azimuthal equidistant projection of WGS84 around `origin` (lon, lat) [deg]: x [m] east, y [m] north there.

    Raises
    ------
    MissingExtraError : pyproj is not installed
    """

    def __init__(self, origin: tuple[float, float]) -> None:
        try:
            library = import_module("pyproj")
        except ImportError as error:
            raise MissingExtraError.of("pyproj", "maritime", "a place on Earth") from error
        self.origin = origin
        self._project = library.Proj(proj="aeqd", ellps="WGS84", lon_0=origin[0], lat_0=origin[1])

    def local(self, lon: Any, lat: Any) -> tuple[Any, Any]:
        """Return x and y [m] of places [deg]."""
        x, y = self._project(lon, lat)
        return x, y

    def geographic(self, x: Any, y: Any) -> tuple[Any, Any]:
        """Return longitude, from -180 to below 180, and latitude [deg] of local places [m]."""
        lon, lat = self._project(x, y, inverse=True)
        return (np.asarray(lon) + 180.0) % 360.0 - 180.0, lat
