"""The runs of a sweep's folder as a DataFrame, and how two points of it differ."""

from pathlib import Path
from typing import TYPE_CHECKING

from shoal.experiments.paired import paired_difference as paired_difference
from shoal.experiments.results import read_rows
from shoal.record.tables import data_frame

if TYPE_CHECKING:
    import pandas


def load_results(folder: str | Path) -> "pandas.DataFrame":
    """Return the rows of a sweep as a pandas.DataFrame, one row per run; `.set_index([...]).to_xarray()` labels them.

    Raises
    ------
    RecordError : the folder holds no sweep
    MissingExtraError : pandas is absent
    """
    _, rows = read_rows(folder)
    return data_frame(rows, "loading results as a DataFrame")
