"""Legends that cover nothing: above a snapshot, or in room made for them above the data of a chart."""

from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.style import GRAY, INK, TARGET, fleet_color, fleet_marker
from shoal.drawing.words import legend_text, shorten
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW = 0.18  # [inch] height of a row
_LETTER, _SIGN = 0.058, 0.42  # [inch] width of a letter; of a sign and the space around it
_LONGEST = 26  # letters of a name
_HALO, _SENSOR, _REPORTS = "repulsion a_R", "sensor", "reports a target"


def draw_legend(
    axes: "Axes",
    record: Record,
    *,
    halos: bool = False,
    sensors: bool = False,
    width: float | None = None,
    shift: float = 0.0,
) -> float:
    """Name the signs of a snapshot above it; return the height taken [inch].

    Parameters
    ----------
    halos, sensors : whether there are discs of these
    width, shift : room for the legend, and how far it begins left of the axes [inch]; default: that of the axes
    """
    signs = _fleet_signs(record)
    signs.append(_sign(_REPORTS, "o", markerfacecolor="white", markeredgecolor=INK, markeredgewidth=1.3, markersize=6))
    signs.append(_target_sign())
    if halos:
        face, edge = fleet_color(0) + "17", fleet_color(0) + "60"
        signs.append(_sign(_HALO, "o", markerfacecolor=face, markeredgecolor=edge, markersize=11))
    if sensors:
        signs.append(_sign(_SENSOR, "o", markerfacecolor="none", markeredgecolor=GRAY, markersize=9))
    return _above(axes, signs, width, shift)


def draw_map_legend(axes: "Axes", record: Record) -> float:
    """Name the signs of a trajectory map above it; return the height taken [inch]."""
    ring = _sign("start", "o", markerfacecolor="white", markeredgecolor=GRAY, markersize=4)
    return _above(axes, [*_fleet_signs(record), _target_sign(), ring])


def legend_height(record: Record, width: float, *, halos: bool = False, sensors: bool = False) -> float:
    """Height of the legend above a snapshot of a width [inch]."""
    labels = [*_fleet_labels(record), _REPORTS, "target", *[_HALO] * halos, *[_SENSOR] * sensors]
    return ROW * _rows(labels, width)


def map_legend_height(record: Record, width: float) -> float:
    """Height of the legend above a trajectory map of a width [inch]."""
    return ROW * _rows([*_fleet_labels(record), "target", "start"], width)


def headroom(axes: "Axes", labels: list[str]) -> None:
    """Raise the upper y limit, leaving the ticks with the data, and put the legend of these labels there.

    `axes` have artists with these labels and y limits that the data just fit.
    """
    width, height = _inches(axes)
    columns = _columns(labels, width)
    share = (0.1 + ROW * _rows(labels, width)) / height if labels else 0.05
    bottom, top = axes.get_ylim()
    ticks = np.asarray(axes.get_yticks())
    top = next((tick for tick in ticks if top <= tick <= top + 0.35 * (ticks[1] - ticks[0])), top)
    axes.set_yticks(ticks[(ticks >= bottom) & (ticks <= top * (1 + 1e-9))])
    axes.set_ylim(bottom, bottom + (top - bottom) / (1 - min(share, 0.6)))
    if labels:
        axes.legend(loc="upper left", ncols=columns, borderaxespad=0.1, borderpad=0.2)


def marker_area(record: Record, fleet: int) -> float:
    """Area of a buoy's marker [pt2]: shrinks with the swarm, grows with the fleet's top speed."""
    facts = record.facts
    base = float(np.clip(44.0 * (50.0 / facts.agents) ** 0.5, 9.0, 60.0))
    return base * (0.5 + 0.5 * facts.max_speeds[fleet] / max(facts.max_speeds))


def short_name(name: str) -> str:
    """The name of a fleet as far as it fits a legend."""
    return legend_text(shorten(name, _LONGEST))


def _sign(label: str, marker: str, **look: Any) -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], linestyle="none", marker=marker, label=label, **look)


def _fleet_signs(record: Record) -> list[Any]:
    return [
        _sign(
            label, fleet_marker(fleet), color=fleet_color(fleet), markersize=max(4.0, marker_area(record, fleet) ** 0.5)
        )
        for fleet, label in enumerate(_fleet_labels(record))
    ]


def _target_sign() -> Any:
    return _sign("target", "o", markerfacecolor=TARGET + "38", markeredgecolor=TARGET, markersize=8)


def _above(axes: "Axes", signs: list[Any], width: float | None = None, shift: float = 0.0) -> float:
    """Put a legend above axes; return its height [inch]."""
    wide = _inches(axes)[0]
    width = width or wide
    labels = [str(sign.get_label()) for sign in signs]
    axes.legend(
        handles=signs, loc="lower left", bbox_to_anchor=(-shift / wide, 1.0), ncols=_columns(labels, width),
        borderaxespad=0.2, borderpad=0.2,
    )  # fmt: skip
    return ROW * _rows(labels, width)


def _fleet_labels(record: Record) -> list[str]:
    facts = record.facts
    return [f"{short_name(name)}, {speed:.3g} m/s" for name, speed in zip(facts.fleets, facts.max_speeds, strict=True)]


def _columns(labels: list[str], width: float) -> int:
    """Columns of the fewest rows that fit a width [inch], each column as wide as its longest label."""
    for rows in range(1, len(labels)):
        columns = -(-len(labels) // rows)
        filled = np.array_split(np.array([len(label) for label in labels]), columns)  # as matplotlib fills them
        if sum(_SIGN + _LETTER * int(column.max()) for column in filled) <= width:
            return columns
    return 1


def _rows(labels: list[str], width: float) -> int:
    return -(-len(labels) // _columns(labels, width))


def _inches(axes: "Axes") -> tuple[float, float]:
    """Width and height of the room that axes were given."""
    figure = axes.get_figure(root=True)
    if figure is None:
        return 0.0, 1.0
    room = axes.get_position(original=True)
    return float(figure.get_figwidth() * room.width), float(figure.get_figheight() * room.height)
