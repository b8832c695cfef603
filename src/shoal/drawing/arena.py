"""The empty arena of a snapshot: edge, clamp, axes in m or km, scale bar."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.drawing.style import GRAY, INK
from shoal.drawing.words import length_text
from shoal.scenario.schema import Area

if TYPE_CHECKING:
    from matplotlib.axes import Axes

KILOMETERS_FROM = 2000.0  # [m] longer side from which axes count in km
PAD = 0.025  # of the longer side, around the arena


def draw_arena(axes: "Axes", area: Area, pad: float = PAD) -> None:
    """Draw the edge and, dashed, the line that agents are kept inside of; equal scales [m], ticks in m or km.

    Parameters
    ----------
    area : of a scenario
    pad : room around the arena, as a share of the longer side
    """
    width, height, margin = area.width, area.height, area.agent_margin
    _rectangle(axes, width, height, color=GRAY, linewidth=1.0, fill=True)
    if margin > 0:
        _rectangle(axes, width - 2 * margin, height - 2 * margin, color=GRAY, linewidth=0.7, linestyle=(0, (4, 3)))
    room = pad * max(width, height)
    axes.set_xlim(-width / 2 - room, width / 2 + room)
    axes.set_ylim(-height / 2 - room, height / 2 + room)
    axes.set_aspect("equal", adjustable="box")
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    _label_axes(axes, width, height)


def draw_scale_bar(axes: "Axes", area: Area, points: npt.NDArray[np.float64]) -> None:
    """Draw a bar of a round length in the corner of the arena that hides the fewest of these points (P, 2)."""
    left, right, bottom, top = -area.width / 2, area.width / 2, -area.height / 2, area.height / 2
    length = round_length(0.25 * (right - left))
    pad = 0.06 * min(right - left, top - bottom)
    corners = [(x, y) for y in (bottom + pad, top - 1.5 * pad) for x in (left + pad, right - pad - length)]

    def hidden(corner: tuple[float, float]) -> int:
        offset = points - corner
        inside = (offset > (-pad / 2, -pad / 2)) & (offset < (length + pad / 2, 1.5 * pad))
        return int(inside.all(axis=1).sum())

    x, y = min(corners, key=hidden)  # the first of equals: lower left
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.75}
    axes.plot([x, x + length], [y, y], color=INK, linewidth=2.0, solid_capstyle="butt", zorder=1.3, gid="scale-bar")
    axes.annotate(
        length_text(length), (x + length / 2, y), (0, 3), textcoords="offset points", ha="center", va="bottom",
        fontsize=8, color=INK, bbox=box, zorder=1.2,
    )  # fmt: skip


def arena_aspect(area: Area, pad: float = PAD) -> float:
    """Width / height of what axes show of an arena."""
    room = 2 * pad * max(area.width, area.height)
    return float((area.width + room) / (area.height + room))


def round_length(limit: float) -> float:
    """The largest 1, 2 or 5 times a power of ten that is not over `limit` [m]."""
    power = 10.0 ** math.floor(math.log10(limit))
    return max(digit for digit in (1.0, 2.0, 5.0) if digit * power <= limit * (1 + 1e-9)) * power


def in_kilometers(area: Area) -> bool:
    """Whether an arena is shown in km."""
    return bool(max(area.width, area.height) > KILOMETERS_FROM)


def _rectangle(axes: "Axes", width: float, height: float, *, color: str, fill: bool = False, **line: Any) -> None:
    from matplotlib.patches import Rectangle

    face = "#f7f9fb" if fill else "none"
    axes.add_patch(
        Rectangle((-width / 2, -height / 2), width, height, facecolor=face, edgecolor=color, zorder=0.5, **line)
    )


def _label_axes(axes: "Axes", width: float, height: float) -> None:
    from matplotlib.ticker import FuncFormatter, MaxNLocator

    scale, unit = (1000.0, "km") if max(width, height) > KILOMETERS_FROM else (1.0, "m")
    axes.set_xlabel(f"east [{unit}]")
    axes.set_ylabel(f"north [{unit}]")
    longer = max(width, height)
    for axis, side in ((axes.xaxis, width), (axes.yaxis, height)):
        axis.set_major_locator(MaxNLocator(nbins=max(2, round(8 * side / longer)), steps=[1, 2, 5, 10]))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value / scale:g}".replace("-", "\u2212")))
