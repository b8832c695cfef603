"""Mixed fleets after a target that flees: curves over k, what a lower k gains, and what fewer buoys can do."""

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from shoal.drawing.style import GRAY, lettered, line_color, new_figure, style
from shoal.experiments.rows import Row
from shoal.paper.alife_claims import BASE_FAST
from shoal.paper.figures_series import (
    DOUBLE,
    TIME_ON_TARGET,
    curve,
    levels,
    seeds_text,
    series,
    show_means,
    speed_text,
    swarm_text,
    where,
)
from shoal.paper.later_plan import AGENTS, FEWER, FLEES_AT, SHARES, SPEED, UNEQUAL_AT
from shoal.paper.results import Figure

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_MARKERS = ("o", "s", "^", "D")
_COLORS = tuple(map(line_color, range(4)))
_TITLE = "Time on target of a target that flees"

Draw = Callable[["Axes", float], list[Row]]


def alife_figures(rows: Mapping[str, Sequence[Row]]) -> list[Figure]:
    """Return the three figures; what was not run is left out.

    Parameters
    ----------
    rows : by group of later_plan.evasive_groups
    """
    main, unequal, fewer = (_finished(rows.get(name, ())) for name in ("main", "unequal", "fewer"))
    seeds = seeds_text(main)

    def over_k(axes: "Axes", speed: float) -> list[Row]:
        data: list[Row] = []
        for fast, color, marker in zip(SHARES, _COLORS, _MARKERS, strict=False):
            mine = where(main, fast=fast, **{SPEED: speed})
            data += _line(axes, mine, "neighbors", swarm_text(fast), color, marker)
        return data

    def lower(axes: "Axes", speed: float) -> list[Row]:
        data: list[Row] = []
        looks = iter(zip(_COLORS, _MARKERS, strict=True))
        for fast in SHARES[1:]:
            for k in UNEQUAL_AT:
                color, marker = next(looks)
                mine = where(unequal, fast=fast, neighbors=k, **{SPEED: speed})
                same = [{**row, _FAST_K: k} for row in where(main, fast=fast, neighbors=k, **{SPEED: speed})]
                label = f"{fast} fast, the slow hear {k}"
                data += _line(axes, [*mine, *same], _FAST_K, label, color, marker)
        return data

    def few(axes: "Axes", speed: float) -> list[Row]:
        data: list[Row] = []
        k = UNEQUAL_AT[0]
        whole = [{**row, "agents": AGENTS} for row in where(main, neighbors=k, **{SPEED: speed})]
        for agents, color, marker in zip((*FEWER, AGENTS), _COLORS, _MARKERS, strict=False):
            mine = where([*fewer, *whole], agents=agents, **{SPEED: speed})
            data += _line(axes, mine, "fast", f"{agents} buoys", color, marker)
        base = series(where(whole, fast=BASE_FAST), "fast", TIME_ON_TARGET)
        if base.mean:
            axes.axhline(
                base.mean[0], color=GRAY, linewidth=0.9, linestyle=(0, (4, 3)), label=f"{AGENTS} with {BASE_FAST} fast"
            )
        return data

    made = [
        _figure(
            "alife_k", _TITLE, over_k, "number of neighbors k", f"Against k, for three fleets of {AGENTS}. {seeds}"
        ),
        _figure(
            "alife_lower",
            f"{_TITLE}, with fast buoys that hear fewer",
            lower,
            "neighbors of the fast buoys",
            f"Against the k of the fast buoys; the last point of each curve is the same k for all. {seeds}",
        ),
        _figure(
            "alife_fewer",
            f"{_TITLE}, with fewer buoys",
            few,
            "fast buoys",
            f"Against the number of fast buoys among 30, 40 and {AGENTS}, k = {UNEQUAL_AT[0]}. The dashed line: "
            f"{AGENTS} buoys with {BASE_FAST} fast ones. {seeds}",
        ),
    ]
    return [figure for figure in made if figure is not None]


_FAST_K = "fleets.BoB-1.neighbors"


def _finished(rows: Sequence[Row]) -> list[Row]:
    return [row for row in rows if row.get("status", "done") == "done"]


def _line(axes: "Axes", rows: Sequence[Row], x: str, label: str, color: str, marker: str) -> list[Row]:
    points = series(rows, x, TIME_ON_TARGET)
    if not points.x:
        return []
    curve(axes, points, label, color, marker)
    speed = levels(rows, SPEED)[0]
    return points.rows(x, TIME_ON_TARGET, curve=label, target_speed=speed)


def _figure(name: str, title: str, draw: Draw, x: str, caption: str) -> Figure | None:
    data: list[Row] = []
    with style():
        figure = new_figure(DOUBLE, 3.0)
        figure.set_layout_engine("constrained", h_pad=0.05, w_pad=0.06)
        panels: Any = figure.subplots(1, len(FLEES_AT), squeeze=False)[0]
        for number, (axes, speed) in enumerate(zip(panels, FLEES_AT, strict=True)):
            shown = draw(axes, speed)
            if shown:
                show_means(axes, shown)
            axes.set_title(lettered(number, speed_text(speed)))
            axes.set_xlabel(x)
            axes.grid(visible=True)
            data += shown
        panels[0].set_ylabel(TIME_ON_TARGET.label)
        handles, labels = panels[0].get_legend_handles_labels()
        if handles:
            figure.legend(
                handles, labels, loc="outside upper left", ncols=2 if len(labels) > 3 else 3, borderaxespad=0.2
            )
    return Figure(name, title, caption, figure, data) if data else None
