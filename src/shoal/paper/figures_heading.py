"""What heading and bearing are: the paper's Fig. 1C, drawn from its Eq. 8."""

import math
from typing import TYPE_CHECKING

from shoal.drawing.style import FLEET_COLORS, GRAY, INK, TARGET, WIDTHS, lettered, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BEARING = 25.0  # [deg] of the target in all sketches
_SKETCHES = (
    ("closes in: exploitation", 5.0),
    ("at an angle", 55.0),
    ("crosses, or stands still", 90.0),
    ("opens out: exploration", 175.0),
)  # angle between heading and bearing [deg]


def heading_figure() -> Figure:
    """Draw a buoy, its heading, the bearing of the target, and phi, the cosine of the angle between them."""
    data: list[Row] = []
    with style():
        figure = new_figure(WIDTHS["double"], 1.75)
        figure.set_layout_engine("constrained", w_pad=0.02)
        for number, (axes, (name, angle)) in enumerate(zip(figure.subplots(1, len(_SKETCHES)), _SKETCHES, strict=True)):
            _sketch(axes, angle)
            phi = math.cos(math.radians(angle))
            axes.set_title(lettered(number, f"φ = cos {angle:.0f}° = {phi:.2f}").replace("-", "−"), fontsize=8.0)
            axes.set_xlabel(name)
            data.append({"what": name, "angle [deg]": angle, "phi": phi})
    caption = (
        "The heading–bearing correlation φ (Eq. 8) of one buoy: the cosine of the angle θ between its heading v, the "
        "direction in which it moves, and the bearing t, the direction in which the target lies from it. φ near 1: it "
        "moves toward the target; near −1: away from it. A buoy that stands still has no heading and counts as φ = 0."
    )
    return Figure("heading_bearing", "Heading and bearing", caption, figure, data)


def _sketch(axes: "Axes", angle: float) -> None:
    """Buoy at the origin, target up and to the right, heading so far to its left."""
    from matplotlib.patches import Arc, Circle

    heading = _BEARING + angle
    ends = {}
    for name, direction, color, length in (("t", _BEARING, TARGET, 1.0), ("v", heading, FLEET_COLORS[0], 0.8)):
        end = (length * math.cos(math.radians(direction)), length * math.sin(math.radians(direction)))
        ends[name] = end
        axes.annotate(
            "",
            end,
            (0, 0),
            arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0},
        )
        side = math.radians(direction + (-15.0 if name == "t" else 15.0))
        at = 0.72 * length
        axes.text(
            at * math.cos(side), at * math.sin(side), name, color=color, fontweight="bold", ha="center", va="center"
        )
    far = (1.35 * math.cos(math.radians(_BEARING)), 1.35 * math.sin(math.radians(_BEARING)))
    axes.plot([0, far[0]], [0, far[1]], color=GRAY, linewidth=0.7, linestyle=(0, (4, 3)), zorder=0)
    axes.add_patch(Circle(far, 0.16, facecolor=TARGET, edgecolor="none", alpha=0.35))
    axes.plot([0], [0], "o", color=INK, markersize=5)
    if angle > 15:
        axes.add_patch(Arc((0, 0), 0.7, 0.7, theta1=_BEARING, theta2=heading, color=INK, linewidth=0.9))
        middle = math.radians(_BEARING + angle / 2)
        axes.text(0.5 * math.cos(middle), 0.5 * math.sin(middle), "θ", ha="center", va="center")
    axes.set_xlim(-0.95, 1.5)
    axes.set_ylim(-0.5, 1.05)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_visible(False)
