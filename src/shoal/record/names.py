"""What a metric is called, and in which unit it is told: one name and one unit in tables, figures, pages and files."""

from shoal.metrics.contract import Metric
from shoal.metrics.summary import METRICS

_UNITS = {"m^2/s": "m²/s", "m^3/s^3": "m³/s³", "unit/step": "arena units/step"}


def unit_text(metric: Metric) -> str:
    """A unit as readers see it: of the unit 1 that it is a share, or nothing."""
    if metric.unit == "1":
        return "share" if metric.sentence.startswith("share ") else ""
    return _UNITS.get(metric.unit, metric.unit)


def label_of(name: str) -> str:
    """Name and unit, for an axis or the head of a column: time on target [share]."""
    metric = METRICS[name]
    unit = unit_text(metric)
    return f"{metric.words} [{unit}]" if unit and unit not in metric.words.split() else metric.words
