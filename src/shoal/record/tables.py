"""Rows as a table of pandas, which is not always there."""

from typing import TYPE_CHECKING, Any

from shoal.core.errors import MissingExtraError

if TYPE_CHECKING:
    import pandas


def data_frame(rows: Any, what: str) -> "pandas.DataFrame":
    """Return a table of rows, or of whatever else pandas makes one of.

    Parameters
    ----------
    rows : what it is made of
    what : what was asked for, as the error calls it

    Raises
    ------
    MissingExtraError : pandas is not installed
    """
    try:
        import pandas as pd
    except ImportError:
        raise MissingExtraError.of("pandas", "sweep", what) from None
    return pd.DataFrame(rows)
