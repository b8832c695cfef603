"""Where a curve over k peaks, as a figure shows it; found as the claims find it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from shoal.experiments.rows import Row
from shoal.paper.cases import told_number
from shoal.paper.curves import Interval, curve, peak
from shoal.paper.figures_series import Quantity


@dataclass(frozen=True)
class PeakMark:
    """The k at which a curve peaks, and the height there in the unit of the figure; bounds are NaN with one seed."""

    place: Interval
    height: Interval
    at_edge: bool

    @property
    def text(self) -> str:
        """18.2 [16.9, 19.5]."""
        return told_number(self.place) + (" (edge)" if self.at_edge else "")

    def rows(self, quantity: Quantity, **labels: Any) -> list[Row]:
        """Place and height, for the table behind a figure."""
        place = {**labels, "quantity": f"k of the peak of {quantity.name}", "unit": "1"}
        height = {**labels, "quantity": f"{quantity.name} at its peak", "unit": quantity.unit or "1"}
        return [
            {**what, "mean": number.value, "low": number.low, "high": number.high}
            for what, number in ((place, self.place), (height, self.height))
        ]


def peak_of(rows: Sequence[Row], quantity: Quantity) -> PeakMark | None:
    """The peak over k of a quantity in the rows of one swarm and target speed; None with fewer than four k."""
    found = peak(curve([row for row in rows if row.get(quantity.column) is not None], quantity.column))
    if not math.isfinite(found.place.value):
        return None
    return PeakMark(found.place, found.height.times(quantity.factor), found.at_edge)
