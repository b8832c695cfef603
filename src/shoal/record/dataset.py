"""An xarray.Dataset that refuses to become the product of all its dimensions."""

import math
from collections.abc import Sequence
from typing import Any

import xarray

from shoal.core.errors import RecordError

MOST_ROWS = 1_000_000  # of a table whose variables do not share their dimensions


class RecordDataset(xarray.Dataset):  # type: ignore[no-untyped-call]
    """Metrics and trajectories of a record, see `Record.to_xarray`."""

    __slots__ = ()

    def to_dataframe(self, dim_order: Sequence[Any] | None = None) -> Any:
        """Return a table with a row for every combination of the dimensions, where that makes sense.

        Raises
        ------
        RecordError : variables do not share their dimensions, and a row per combination would be a flood
        """
        rows = math.prod(self.sizes.values())
        largest = max((variable.size for variable in self.data_vars.values()), default=0)
        if rows > max(MOST_ROWS, largest):
            dimensions = " x ".join(f"{size} {name}" for name, size in self.sizes.items())
            raise RecordError(
                "to_dataframe()",
                f"would have {rows:,} rows, one for every combination of {dimensions}",
                'use record.to_pandas() or record.to_pandas("frames"), or choose variables: ds[["x", "y"]]',
            )
        return super().to_dataframe(dim_order)
