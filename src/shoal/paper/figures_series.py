"""Rows of runs as the points of a curve: means over seeds with their 95 % intervals."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.drawing.curves import Curve, draw_curve
from shoal.drawing.style import WIDTHS
from shoal.experiments.rows import Row
from shoal.metrics.summary import METRICS, Bounds
from shoal.paper.curves import FEW, intervals
from shoal.paper.plan import AGENTS
from shoal.record.names import unit_text
from shoal.scenario.edit import SHORTHANDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SINGLE, DOUBLE = WIDTHS["single"], WIDTHS["double"]  # [inch]
ALL_SLOW = 0  # fast buoys, as MIXED
CURVE_FIELDS = ("fast", "neighbors", "target_speed")


@dataclass(frozen=True)
class Quantity:
    """A metric as a figure shows it: the column, its name, unit, the factor from the column to the unit, a bound."""

    column: str
    name: str
    unit: str
    factor: float = 1.0
    most: float = math.inf  # [unit] intervals end here, and at 0

    @property
    def label(self) -> str:
        """For an axis."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


TIME_ON_TARGET = Quantity("time_on_target", "time on target", "share", most=1.0)
XI = Quantity("xi", "velocity fluctuation Ξ", "")
XI_RAW = Quantity("xi_raw", "Ξ not normalized", "m/s")
RESPONSE = Quantity("response", "response", unit_text(METRICS["response"]))


@dataclass(frozen=True)
class Series:
    """Mean and 95 % interval over seeds at each x; the interval is NaN where there is one seed only."""

    x: tuple[float, ...]
    mean: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    runs: tuple[int, ...]

    def rows(self, x: str, quantity: Quantity, **labels: Any) -> list[Row]:
        """One row per point, for the table behind a figure."""
        points = zip(self.x, self.mean, self.low, self.high, self.runs, strict=True)
        return [
            {**labels, x: int(at) if at.is_integer() else at, "quantity": quantity.name, "unit": quantity.unit or "1",
             "mean": mean, "low": low, "high": high, "runs": runs}
            for at, mean, low, high, runs in points
        ]  # fmt: skip


def plain_rows(rows: Iterable[Row]) -> list[Row]:
    """The finished runs that differ from the preset in nothing but fast, neighbors and target speed."""
    return [
        row
        for row in rows
        if row.get("status", "done") == "done"
        and not any(value is not None and _varies_more(name) for name, value in row.items())
    ]


def levels(rows: Iterable[Row], field: str) -> list[Any]:
    """The values of a field, each once, sorted."""
    return sorted({row[field] for row in rows if row.get(field) is not None})


def where(rows: Iterable[Row], **fields: Any) -> list[Row]:
    """The rows in which the fields have these values."""
    return [row for row in rows if all(row.get(name) == value for name, value in fields.items())]


def series(rows: Iterable[Row], x: str, quantity: Quantity) -> Series:
    """The mean of a quantity at each value of the field x, in order; cells without a number are left out."""
    cells: dict[float, list[float]] = {}
    for row in rows:
        value = row.get(quantity.column)
        if row.get(x) is not None and value is not None and math.isfinite(value):
            cells.setdefault(float(row[x]), []).append(quantity.factor * value)
    places = sorted(cells)
    known = intervals([np.array(cells[at]) for at in places], Bounds(0.0, quantity.most))
    return Series(
        tuple(places),
        tuple(each.value for each in known),
        tuple(each.low for each in known),
        tuple(each.high for each in known),
        tuple(len(cells[at]) for at in places),
    )


def curve(
    axes: "Axes", points: Series, label: str, color: str, marker: str, x_factor: float = 1.0, *, bold: bool = False
) -> None:
    """Draw a series with its band and a marker per cell; a single point gets its interval as a bar."""
    drawn = Curve(label)
    for x, mean, low, high in zip(points.x, points.mean, points.low, points.high, strict=True):
        drawn.add(x_factor * x, mean, low, high)
    draw_curve(axes, drawn, color, marker, bold=bold)


def show_means(axes: "Axes", rows: Iterable[Row]) -> None:
    """Fit the y axis to the means of the rows; wide bands may reach out of the panel."""
    axes.set_ylim(*limits(rows, "mean"))


def limits(rows: Iterable[Row], value: str) -> tuple[float, float]:
    """The range of a column with some room, as much of it as the intervals (low, high) need."""
    rows = list(rows)
    values = np.array([row[value] for row in rows])
    bottom, top = float(values.min()), float(values.max())
    room = max(0.3 * (top - bottom), 0.02 * float(np.abs(values).max()), 1e-9)
    lowest = float(np.nanmin([bottom, *(row["low"] for row in rows)]))
    highest = float(np.nanmax([top, *(row["high"] for row in rows)]))
    return max(bottom - room, lowest - 0.25 * room), min(top + room, highest + 0.25 * room)


def spread(values: Sequence[Any], most: int, keep: Any = None) -> list[Any]:
    """At most so many of the sorted values, spread over them; `keep` is among them if it is one."""
    if len(values) <= most:
        return list(values)
    chosen = {values[round(number * (len(values) - 1) / (most - 1))] for number in range(most)}
    if keep in values and keep not in chosen:
        inner = [value for value in chosen if value not in (values[0], values[-1])] or list(chosen)
        chosen -= {min(inner, key=lambda value: abs(value - keep))}
        chosen |= {keep}
    return sorted(chosen)


def speed_text(speed: float) -> str:
    """The speed of a target, for a title."""
    return f"Target {speed:g} m/s"


def swarm_text(fast: int) -> str:
    """What a swarm of so many fast buoys is made of."""
    if fast == 0:
        return f"all {AGENTS} slow"
    return f"{fast} fast, {AGENTS - fast} slow" if fast < AGENTS else f"all {AGENTS} fast"


def seeds_text(rows: Iterable[Row]) -> str:
    """What the bands are over."""
    seeds = len({row.get("run") for row in rows})
    if seeds < 2:
        return "One seed: no intervals."
    pooled = ", their spread pooled over the points of a curve" if seeds < FEW else ""
    return f"Bands: 95 % interval over {seeds} seeds{pooled}."


def _varies_more(name: str) -> bool:
    """Whether a column is a field of the scenario that the paper's curves do not vary."""
    return "." in name or (name in SHORTHANDS and name not in CURVE_FIELDS)
