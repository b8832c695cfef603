"""Where a curve over k peaks, and how sure that is."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from shoal.paper.figures_series import Quantity, series
from shoal.paper.results import Row


@dataclass(frozen=True)
class Peak:
    """The k at which a curve peaks, and the height there in the unit of the figure, with 95 % intervals."""

    x: float
    low: float
    high: float
    height: float
    height_low: float
    height_high: float

    @property
    def text(self) -> str:
        """18 [16, 20]."""
        return f"{self.x:.3g} [{self.low:.3g}, {self.high:.3g}]"

    def row(self, quantity: Quantity, symbol: str, **labels: Any) -> Row:
        """The row of the table behind a figure."""
        return {**labels, "neighbors": self.x, "quantity": f"{symbol} of {quantity.name}", "unit": "1",
                "mean": self.x, "low": self.low, "high": self.high, "height": self.height}  # fmt: skip


def peak_of(rows: Sequence[Row], quantity: Quantity) -> Peak | None:
    p = series(rows, "neighbors", quantity)
    if len(p.x) < 3:
        return None
    i = p.mean.index(max(p.mean))
    return Peak(p.x[i], p.x[max(i - 1, 0)], p.x[min(i + 1, len(p.x) - 1)], p.mean[i], p.low[i], p.high[i])
