"""What a sea adds to the picture of an arena: land, arrows of the current, north, longitude and latitude."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import ShoalError
from shoal.core.geodesy import Frame
from shoal.core.graticule import graticule
from shoal.drawing.style import GRAY, INK
from shoal.record.trajectory import Trajectory
from shoal.run.arrows import arrow_places
from shoal.run.sea import build_sea, flow_at
from shoal.scenario.at_sea import OpenSea, open_sea
from shoal.scenario.schema import Area, Scenario

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LAND, SHORE, WATER = "#d9d2c3", "#8c8069", "#7ba7bd"
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
        self._places, apart = arrow_places(area, opened.land)
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
            textcoords="offset points", fontsize=7, color=INK, zorder=1.3,
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


def draw_graticule(axes: "Axes", area: Area) -> None:
    """Draw meridians and parallels at round degrees and minutes, with their numbers at the south and east edges."""
    assert area.origin is not None
    half_x, half_y = area.width / 2, area.height / 2
    style: dict[str, Any] = {"color": GRAY, "linewidth": 0.4, "linestyle": (0, (1, 3)), "zorder": 0.55}
    box = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
    # below agents and paths
    labels: dict[str, Any] = {"fontsize": 6.5, "color": INK, "textcoords": "offset points", "bbox": box, "zorder": 1.3}
    for line in graticule(Frame(area.origin), half_x, half_y):
        axes.plot(line.x, line.y, **style)
        if line.meridian and -0.55 * half_x < line.edge < 0.8 * half_x:  # beside the scale bar
            axes.annotate(line.words, (line.edge, -half_y), (2, 2), ha="left", va="bottom", **labels)
        elif not line.meridian and abs(line.edge) < 0.97 * half_y:
            axes.annotate(line.words, (half_x, line.edge), (-2, 1), ha="right", va="bottom", **labels)
    axes.annotate(
        "N", (0.97, 0.985), (0.97, 0.9), xycoords="axes fraction", textcoords="axes fraction", fontsize=8, color=INK,
        ha="center", va="center", arrowprops={"arrowstyle": "-|>", "color": INK}, zorder=1.3, gid="north",
    )  # fmt: skip
