"""Legends that cover nothing: above a snapshot, or in room made for them above the data of a chart."""

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.text import plain
from shoal.drawing.style import GRAY, INK, TARGET, fleet_color, fleet_line, fleet_marker
from shoal.drawing.words import legend_text
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW = 0.18  # [inch] height of a row
_LETTER, _SIGN = 0.058, 0.42  # [inch] width of a letter; of a sign and the space around it
_USUAL = 8.0  # [square inch] of a snapshot
_LONGEST = 34  # letters of a line of a name
_HALO, _SENSOR, _REPORTS = "repulsion a_R", "sensor", "reports a target"
_WALL = "agents' wall"


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
    return _above(axes, [*signs, *_wall_signs(record)], width, shift)


def draw_map_legend(axes: "Axes", record: Record) -> float:
    """Name the signs of a trajectory map above it; return the height taken [inch]."""
    ring = _sign("start", "o", markerfacecolor="white", markeredgecolor=GRAY, markersize=4)
    return _above(axes, [*_fleet_signs(record), _target_sign(), ring, *_wall_signs(record)])


def legend_height(record: Record, width: float, *, halos: bool = False, sensors: bool = False) -> float:
    """Height of the legend above a snapshot of a width [inch]."""
    labels = [*_fleet_labels(record), _REPORTS, "target", *[_HALO] * halos, *[_SENSOR] * sensors]
    labels += [str(sign.get_label()) for sign in _wall_signs(record)]
    return _height(labels, width)


def map_legend_height(record: Record, width: float) -> float:
    """Height of the legend above a trajectory map of a width [inch]."""
    walls = [str(sign.get_label()) for sign in _wall_signs(record)]
    return _height([*_fleet_labels(record), "target", "start", *walls], width)


def headroom(axes: "Axes", labels: list[str]) -> None:
    """Raise the upper y limit, leaving the ticks with the data, and put the legend of these labels there.

    `axes` have artists with these labels and y limits that the data just fit.
    """
    width, height = _inches(axes)
    columns = _columns(labels, width)
    share = (0.1 + _height(labels, width)) / height if labels else 0.05
    bottom, top = axes.get_ylim()
    ticks = np.asarray(axes.get_yticks())
    top = next((tick for tick in ticks if top <= tick <= top + 0.35 * (ticks[1] - ticks[0])), top)
    axes.set_yticks(ticks[(ticks >= bottom) & (ticks <= top * (1 + 1e-9))])
    axes.set_ylim(bottom, bottom + (top - bottom) / (1 - min(share, 0.6)))
    if labels:
        axes.legend(loc="upper left", ncols=columns, borderaxespad=0.1, borderpad=0.2)


def legend_above(axes: "Axes") -> None:
    """Put the legend of what axes show above them, in columns that fit their width."""
    handles, labels = axes.get_legend_handles_labels()
    width = _inches(axes)[0]
    axes.legend(
        handles, labels, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=_columns(labels, width),
        borderaxespad=0.2, borderpad=0.2,
    )  # fmt: skip


def legend_room(labels: Sequence[str], width: float) -> float:
    """Height of `legend_above` [inch]; nothing if nothing has a label."""
    return _height([label for label in labels if label], width)


def marker_area(record: Record, fleet: int) -> float:
    """Area of a buoy's marker [pt2]: shrinks with the swarm, grows with the fleet's top speed."""
    facts = record.facts
    base = float(np.clip(44.0 * (50.0 / facts.agents) ** 0.5, 9.0, 60.0))
    return base * (0.5 + 0.5 * facts.max_speeds[fleet] / max(facts.max_speeds))


def room_of(axes: "Axes") -> float:
    """Factor of the areas of marks: 1 in axes of a usual size, less in smaller ones."""
    figure = axes.get_figure(root=True)
    box = axes.get_position(original=True)
    size = figure.get_figwidth() * box.width * figure.get_figheight() * box.height if figure else _USUAL
    return float(np.clip(size / _USUAL, 0.35, 1.0))


def name_lines(name: str, letters: int = _LONGEST) -> str:
    """A name for a legend, over as many lines as it takes."""
    return legend_text("\n".join(textwrap.wrap(plain(name), letters)))


def _sign(label: str, marker: str, **look: Any) -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], linestyle="none", marker=marker, label=label, **look)


def _fleet_signs(record: Record) -> list[Any]:
    return [
        _sign(
            label,
            fleet_marker(fleet),
            markerfacecolor=fleet_color(fleet),
            markeredgecolor=fleet_line(fleet),
            markeredgewidth=0.6,
            markersize=max(4.0, marker_area(record, fleet) ** 0.5),
        )
        for fleet, label in enumerate(_fleet_labels(record))
    ]


def _target_sign() -> Any:
    return _sign("target", "o", markerfacecolor=TARGET + "38", markeredgecolor=TARGET, markersize=8)


def _wall_signs(record: Record) -> list[Any]:
    """Of the dashed line, where there is one: see arena.py."""
    from matplotlib.lines import Line2D

    if not record.scenario.area.agent_margin:
        return []
    return [Line2D([], [], color=GRAY, linewidth=0.7, linestyle=(0, (4, 3)), label=_WALL)]


def _above(axes: "Axes", signs: list[Any], width: float | None = None, shift: float = 0.0) -> float:
    """Put a legend above axes; return its height [inch]."""
    wide = _inches(axes)[0]
    width = width or wide
    labels = [str(sign.get_label()) for sign in signs]
    axes.legend(
        handles=signs, loc="lower left", bbox_to_anchor=(-shift / wide, 1.0), ncols=_columns(labels, width),
        borderaxespad=0.2, borderpad=0.2,
    )  # fmt: skip
    return _height(labels, width)


def _fleet_labels(record: Record) -> list[str]:
    facts = record.facts
    return [f"{name_lines(name)}, {speed:.3g} m/s" for name, speed in zip(facts.fleets, facts.max_speeds, strict=True)]


def _columns(labels: list[str], width: float) -> int:
    """Columns of the fewest rows that fit a width [inch], each column as wide as its longest label."""
    for rows in range(1, len(labels)):
        columns = -(-len(labels) // rows)
        filled = np.array_split(np.array([_letters(label) for label in labels]), columns)  # as matplotlib fills them
        if sum(_SIGN + _LETTER * int(column.max()) for column in filled) <= width:
            return columns
    return 1


def _height(labels: list[str], width: float) -> float:
    """Height of a legend [inch], whose names may take several lines."""
    if not labels:
        return 0.0
    columns = _columns(labels, width)
    lines = np.array([label.count("\n") + 1 for label in labels])
    return ROW * max(int(column.sum()) for column in np.array_split(lines, columns))


def _letters(label: str) -> int:
    return max(map(len, label.split("\n")))


def _inches(axes: "Axes") -> tuple[float, float]:
    """Width and height of the room that axes were given; that they take, where a layout decides."""
    figure = axes.get_figure(root=True)
    if figure is None:
        return 0.0, 1.0
    placed = figure.get_layout_engine() is not None
    if placed:
        figure.draw_without_rendering()
    room = axes.get_position(original=not placed)
    return float(figure.get_figwidth() * room.width), float(figure.get_figheight() * room.height)
