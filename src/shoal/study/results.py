"""The runs of a sweep's folder as a DataFrame."""

from pathlib import Path
from typing import TYPE_CHECKING

from shoal.core.errors import MissingExtraError
from shoal.experiments.results import read_rows

if TYPE_CHECKING:
    import pandas


def load_results(folder: str | Path) -> "pandas.DataFrame":
    """Return the rows of a sweep as a pandas.DataFrame, one row per run; `.set_index([...]).to_xarray()` labels them.

    Raises
    ------
    RecordError : the folder holds no sweep
    MissingExtraError : pandas is absent
    """
    try:
        import pandas as pd
    except ImportError:
        raise MissingExtraError.of("pandas", "sweep", "loading results as a DataFrame") from None
    _, rows = read_rows(folder)
    return pd.DataFrame(rows)
