"""What the metrics of a run are now, for pages that chart them."""

import math
from typing import Any

from shoal.record.charted import charted, describe_metric
from shoal.record.course import value_of
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.schema import Scenario


class Measures:
    """The metrics of a scenario, in the order in which pages get them; `names` are theirs."""

    def __init__(self, scenario: Scenario) -> None:
        self._facts = facts_of(scenario)
        self.names = charted(scenario)

    def told(self) -> list[dict[str, Any]]:
        """Name, label, unit, sentence and bounds of each."""
        return [describe_metric(name) for name in self.names]

    def values(self, simulation: Simulation) -> list[float | None]:
        """What each is now, over the steps since the sums began; None where it has no value."""
        values = [value_of(name, simulation.tally, self._facts) for name in self.names]
        return [float(f"{value:.7g}") if math.isfinite(value) else None for value in values]
