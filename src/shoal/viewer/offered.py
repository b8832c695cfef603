"""What can be charted of a run: each metric that says something of its scenario, as tables and figures call it."""

import math
from collections.abc import Iterable
from typing import Any

from shoal.metrics.summary import METRICS
from shoal.metrics.tally import Tally
from shoal.record.course import value_of
from shoal.run.facts import facts_of
from shoal.scenario.schema import Scenario

FIRST = ("time_on_target", "xi", "engaged")  # charted unless others are chosen


class Offered:
    """The metrics of a scenario that vary on the way, those that pages begin with first."""

    def __init__(self, scenario: Scenario) -> None:
        self._facts = facts_of(scenario)
        several = len(scenario.targets) > 1
        known = [
            name
            for name, each in METRICS.items()
            if (several or not each.several_targets)
            and (not each.asked or name in scenario.metrics)
            and (name in FIRST or name in scenario.metrics or not scenario.metrics)
        ]
        self.names = in_order(known)

    def told(self) -> list[dict[str, Any]]:
        """Name, label, unit and sentence of each."""
        return [describe_metric(name) for name in self.names]

    def values(self, tally: Tally) -> list[float | None]:
        """What each is now, over the steps since the sums began; None where it has no value."""
        values = [value_of(name, tally, self._facts) for name in self.names]
        return [float(f"{value:.7g}") if math.isfinite(value) else None for value in values]


def in_order(names: Iterable[str]) -> list[str]:
    """The names of metrics, those first that pages begin with."""
    return sorted(names, key=lambda name: FIRST.index(name) if name in FIRST else len(FIRST))


def describe_metric(name: str) -> dict[str, Any]:
    """What a metric is called, for pages."""
    metric = METRICS[name]
    return {
        "name": name,
        "label": metric.words,
        "unit": metric.unit,
        "sentence": metric.sentence,
        "least": metric.low if math.isfinite(metric.low) else None,
        "most": metric.high if isinstance(metric.high, (int, float)) and math.isfinite(metric.high) else None,
    }
