"""Meridians and parallels at round degrees and minutes, as lines in local meters, and how a place is written."""

from typing import Any, NamedTuple

import numpy as np

from shoal.core.geodesy import Frame, near

POINTS = 41  # of a line
STEPS = (
    10.0,
    5.0,
    2.0,
    1.0,
    0.5,
    1 / 6,
    1 / 12,
    1 / 30,
    1 / 60,
    1 / 120,
    1 / 300,
    1 / 600,
    1 / 1200,
    1 / 3000,
)  # [deg] fmt: skip


class Line(NamedTuple):
    """A meridian or a parallel.

    words : 4°36′E; meridian : or a parallel; x, y : (P,) points inside the area [m]
    edge : where it crosses the south edge (x of a meridian) or the east edge (y of a parallel) [m]
    """

    words: str
    meridian: bool
    x: Any
    y: Any
    edge: float


def graticule(frame: Frame, half_x: float, half_y: float) -> list[Line]:
    """Return the lines across an area around the origin, four each way at most.

    Parameters
    ----------
    half_x, half_y : [m] half the sides of the area
    """
    corners_x, corners_y = np.array([-1.0, 0.0, 1.0] * 3) * half_x, np.repeat([-1.0, 0.0, 1.0], 3) * half_y
    lon, lat = (np.asarray(each) for each in frame.geographic(corners_x, corners_y))
    lon = near(lon, frame.origin[0])
    lines = []
    up, across = np.linspace(-half_y, half_y, POINTS), np.linspace(-half_x, half_x, POINTS)
    for degree in round_degrees(lon.min(), lon.max()):
        x, y = frame.local(np.full(POINTS, degree), np.linspace(lat.min(), lat.max(), POINTS))
        x = np.interp(up, y, x)
        inside = np.abs(x) <= half_x
        lines.append(Line(degrees_text(degree, "EW"), True, x[inside], up[inside], float(x[0])))
    for degree in round_degrees(lat.min(), lat.max()):
        x, y = frame.local(np.linspace(lon.min(), lon.max(), POINTS), np.full(POINTS, degree))
        y = np.interp(across, x, y)
        inside = np.abs(y) <= half_y
        lines.append(Line(degrees_text(degree, "NS"), False, across[inside], y[inside], float(y[-1])))
    return lines


def round_degrees(low: float, high: float) -> list[float]:
    """Round degrees or minutes between two, four at most but three where there can be."""
    step = next((each for each in STEPS if (high - low) / each >= 2.5), STEPS[-1])
    return [step * number for number in range(int(np.ceil(low / step)), int(np.floor(high / step)) + 1)]


def degrees_text(degree: float, letters: str) -> str:
    """4°36′E: degrees and minutes, with the digits that round ones need."""
    degree = (degree + 180.0) % 360.0 - 180.0 if letters == "EW" else degree
    whole, minutes = divmod(round(abs(degree) * 60.0, 3), 60.0)
    return f"{whole:.0f}°{minutes:g}′".replace("°0′", "°") + (letters[0] if degree >= 0 else letters[1])
