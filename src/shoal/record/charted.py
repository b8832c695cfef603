"""What can be charted of a scenario: each metric that says something of it, as tables and figures call it."""

import math
from collections.abc import Iterable
from typing import Any

from shoal.metrics.summary import METRICS
from shoal.record.names import unit_text
from shoal.scenario.schema import Scenario

FIRST = ("time_on_target", "xi", "engaged")  # charted unless others are chosen


def charted(scenario: Scenario) -> list[str]:
    """Names of the metrics that a run of a scenario gives, those first that pages begin with."""
    several = len(scenario.targets) > 1
    return in_order(
        name
        for name, each in METRICS.items()
        if (several or not each.several_targets)
        and (not each.asked or name in scenario.metrics)
        and (name in FIRST or name in scenario.metrics or not scenario.metrics)
    )


def in_order(names: Iterable[str]) -> list[str]:
    """The names of metrics, those first that pages begin with."""
    return sorted(names, key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST))


def describe_metric(name: str) -> dict[str, Any]:
    """What a metric is called, for pages."""
    metric = METRICS[name]
    return {
        "name": name,
        "label": metric.words,
        "unit": unit_text(metric) or "1",
        "sentence": metric.sentence,
        "least": metric.low if math.isfinite(metric.low) else None,
        "most": metric.high if isinstance(metric.high, (int, float)) and math.isfinite(metric.high) else None,
    }
