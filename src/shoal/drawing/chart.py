"""What a sea adds to the picture of an arena: land, arrows of the current, north, longitude and latitude."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import ShoalError
from shoal.core.geodesy import Frame
from shoal.drawing.style import GRAY, INK
from shoal.record.trajectory import Trajectory
from shoal.run.sea import build_sea, flow_at
from shoal.scenario.at_sea import OpenSea, open_sea
from shoal.scenario.schema import Area, Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LAND, SHORE, WATER = "#d9d2c3", "#8c8069", "#7ba7bd"
ARROWS = 13  # along the longer side
MOST_CELLS = 700  # of the raster along a side that is drawn


def draw_chart(axes: "Axes", scenario: Scenario) -> None:
    """Draw land, and north and a graticule where the area has an origin.

    A record does not hold the files of its sea: where they are gone, or hold something else by now, what they held is
    left out.
    """
    opened = opened_of(scenario)
    if opened is not None:
        _draw_land(axes, opened)
    if scenario.area.origin is not None:
        draw_graticule(axes, scenario.area)


def opened_of(scenario: Scenario) -> OpenSea | None:
    """The sea of a scenario; None where it has none, or its files cannot be read any more."""
    try:
        return open_sea(scenario)
    except ShoalError:
        return None


def _draw_land(axes: "Axes", opened: OpenSea) -> None:
    raster = opened.shore
    if raster is None:
        return
    every = max(1, max(raster.distance.shape) // MOST_CELLS)
    distance = raster.distance[::every, ::every]
    x = raster.x0 + raster.cell * every * np.arange(distance.shape[1])
    y = raster.y0 + raster.cell * every * np.arange(distance.shape[0])
    axes.contourf(x, y, distance, levels=[-1e9, 0.0], colors=[LAND], zorder=0.6)
    axes.contour(x, y, distance, levels=[0.0], colors=[SHORE], linewidths=0.7, zorder=0.7)


class CurrentArrows:
    """The current at the middles of squares, at the time of a frame; the longest arrow fills its square."""

    def __init__(self, axes: "Axes", scenario: Scenario, opened: OpenSea) -> None:
        self._field = build_sea(scenario, opened).currents
        self._time_step = scenario.time_step
        area = scenario.area
        apart = max(area.width, area.height) / ARROWS
        x, y = (_middles(side, apart) for side in (area.width, area.height))
        places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        self._places = places if opened.land is None else places[_at_sea(opened.land, places)]
        duration = scenario.steps * scenario.time_step
        speeds = [np.hypot(*self._flow(duration * share).T).max(initial=0.0) for share in np.linspace(0.0, 1.0, 9)]
        self.fastest = float(max(speeds))
        self._arrows = axes.quiver(
            *self._places.T, *self._flow(0.0).T, angles="xy", scale_units="xy", units="inches", width=0.012,
            scale=(self.fastest or 1.0) / (0.8 * apart), headwidth=4.5, headlength=5.0, headaxislength=4.5, color=WATER,
            alpha=0.8, pivot="mid", zorder=0.8, gid="current",
        )  # fmt: skip
        axes.annotate(
            f"current, at most {self.fastest:.2g} m/s", (-area.width / 2, area.height / 2), (5, -6), va="top",
            textcoords="offset points", fontsize=7, color=INK, zorder=8,
            bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.75},
        )  # fmt: skip
        self.artists = [self._arrows]

    def show(self, frames: Trajectory, at: int) -> None:
        """Turn the arrows to what they are at a frame."""
        self._arrows.set_UVC(*self._flow(float(frames.step[at]) * self._time_step).T)

    def _flow(self, time: float) -> Any:
        return flow_at(self._field, self._places, time)


def current_arrows(axes: "Axes", scenario: Scenario) -> CurrentArrows | None:
    """The arrows of a scenario; None where the water is still, or its file cannot be read any more."""
    opened = opened_of(scenario)
    if scenario.sea is None or scenario.sea.currents is None or opened is None:
        return None
    return CurrentArrows(axes, scenario, opened)


def _middles(side: float, apart: float) -> Any:
    count = max(1, round(side / apart))
    return side * ((np.arange(count) + 0.5) / count - 0.5)


def _at_sea(raster: Any, places: Any) -> Any:
    """Which places (P, 2) are off the shore by a cell."""
    rows, columns = raster.distance.shape
    i = np.clip(np.rint((places[:, 0] - raster.x0) / raster.cell).astype(int), 0, columns - 1)
    j = np.clip(np.rint((places[:, 1] - raster.y0) / raster.cell).astype(int), 0, rows - 1)
    return raster.distance[j, i] > raster.cell


def draw_graticule(axes: "Axes", area: Area) -> None:
    """Draw meridians and parallels at round degrees and minutes, with their numbers at the south and east edges."""
    assert area.origin is not None
    frame = Frame(area.origin)
    half_x, half_y = area.width / 2, area.height / 2
    edge_x, edge_y = np.array([-1.0, 0.0, 1.0] * 3) * half_x, np.repeat([-1.0, 0.0, 1.0], 3) * half_y
    lon, lat = (np.asarray(each) for each in frame.geographic(edge_x, edge_y))
    lon = area.origin[0] + (lon - area.origin[0] + 180.0) % 360.0 - 180.0
    style: dict[str, Any] = {"color": GRAY, "linewidth": 0.4, "linestyle": (0, (1, 3)), "zorder": 0.55}
    box = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
    labels: dict[str, Any] = {"fontsize": 6.5, "color": INK, "textcoords": "offset points", "bbox": box, "zorder": 7}
    for degree in _round_degrees(lon.min(), lon.max()):
        x, y = frame.local(np.full(41, degree), np.linspace(lat.min(), lat.max(), 41))
        inside = (np.abs(x) <= half_x) & (np.abs(y) <= half_y)
        axes.plot(x[inside], y[inside], **style)
        bottom = float(np.interp(-half_y, y, x))
        if -0.55 * half_x < bottom < 0.8 * half_x:  # beside the scale bar
            axes.annotate(degrees_text(degree, "EW"), (bottom, -half_y), (2, 2), ha="left", va="bottom", **labels)
    for degree in _round_degrees(lat.min(), lat.max()):
        x, y = frame.local(np.linspace(lon.min(), lon.max(), 41), np.full(41, degree))
        inside = (np.abs(x) <= half_x) & (np.abs(y) <= half_y)
        axes.plot(x[inside], y[inside], **style)
        right = float(np.interp(half_x, x, y))
        if abs(right) < 0.97 * half_y:
            axes.annotate(degrees_text(degree, "NS"), (half_x, right), (-2, 1), ha="right", va="bottom", **labels)
    axes.annotate(
        "N", (0.985, 0.985), (0.985, 0.9), xycoords="axes fraction", textcoords="axes fraction", fontsize=8, color=INK,
        ha="center", va="center", arrowprops={"arrowstyle": "-|>", "color": INK}, zorder=8, gid="north",
    )  # fmt: skip


_STEPS = (
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
)  # [deg]


def _round_degrees(low: float, high: float) -> list[float]:
    """Round degrees or minutes between two, four at most but three where there can be."""
    step = next((each for each in _STEPS if (high - low) / each >= 2.5), _STEPS[-1])
    return [step * number for number in range(int(np.ceil(low / step)), int(np.floor(high / step)) + 1)]


def degrees_text(degree: float, letters: str) -> str:
    """4°36′E: degrees and minutes, with the digits that round ones need."""
    degree = (degree + 180.0) % 360.0 - 180.0 if letters == "EW" else degree
    whole, minutes = divmod(round(abs(degree) * 60.0, 3), 60.0)
    return f"{whole:.0f}°{minutes:g}′".replace("°0′", "°") + (letters[0] if degree >= 0 else letters[1])
