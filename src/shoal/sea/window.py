"""The part of the Earth that a scenario needs: its arena in longitude and latitude."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame, near

NORTHERNMOST = 89.0  # [deg] beyond it meridians run together
FARTHEST = 1e7  # [m] from the origin: a quarter of the Earth
POINTS = 129  # on each side of the arena, whose sides are curved in longitude and latitude


@dataclass(frozen=True)
class Window:
    """An arena of +-half_x, +-half_y [m] in a frame, and the box around it [deg], continuous around the origin."""

    frame: Frame
    half_x: float
    half_y: float
    west: float
    east: float
    south: float
    north: float

    @property
    def middle(self) -> float:
        """Longitude of the origin [deg]."""
        return self.frame.origin[0]

    def __str__(self) -> str:
        return box(self.west, self.east, self.south, self.north)


def window_of(frame: Frame, half_x: float, half_y: float) -> Window:
    """Return the window of an arena.

    Raises
    ------
    SeaError : it reaches a pole, or a quarter of the Earth away
    """
    lon, lat = boundary(frame, half_x, half_y)
    if not np.hypot(half_x, half_y) < FARTHEST:
        raise SeaError("area", "reaches a quarter of the Earth away", "give a smaller area")
    poles = np.array([frame.local(0.0, pole) for pole in (-90.0, 90.0)])
    inside = (np.abs(poles[:, 0]) <= half_x) & (np.abs(poles[:, 1]) <= half_y)
    if inside.any() or np.abs(lat).max() > NORTHERNMOST:
        problem = f"reaches beyond {NORTHERNMOST:g} degrees of latitude, where no grid of longitudes is read"
        raise SeaError("area", problem, "choose an area.origin farther from the pole, or a smaller area")
    lon = near(lon, frame.origin[0])
    return Window(
        frame, float(half_x), float(half_y), float(lon.min()), float(lon.max()), float(lat.min()), float(lat.max())
    )


def boundary(frame: Frame, half_x: float, half_y: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return longitudes and latitudes [deg] of points along the sides of an arena, corners included."""
    along = np.linspace(-1.0, 1.0, POINTS)
    one = np.ones(POINTS)
    x = half_x * np.concatenate((along, one, along, -one))
    y = half_y * np.concatenate((-one, along, one, along))
    lon, lat = frame.geographic(x, y)
    return np.asarray(lon), np.asarray(lat)


def box(west: float, east: float, south: float, north: float) -> str:
    """Return a box of longitudes and latitudes [deg] in words."""
    return f"longitude {west:.6g} to {east:.6g}, latitude {south:.6g} to {north:.6g}"
