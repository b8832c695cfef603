"""Numbers and positions as files write them."""

import math
import re
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

MISSING = ("", "nan", "na", "n/a", "null", "none", "nat", "-", "--", "*", "?", "\\n", "nil", "undefined")
FILLS = (-999.0, 999.0, -9999.0, 9999.0, -99999.0, 99999.0, -32768.0)
HUGE = 1e10  # nothing in degrees is: netCDF's default fill, 1e20, -1e34
NO_LAT, NO_LON = 91.0, 181.0  # AIS: not available
NUMBER = re.compile(r"[+-]?(\d+[.,]?\d*|[.,]\d+)([eE][+-]?\d+)?", re.ASCII)


def number(text: str) -> float:
    """Return the number that a text is, with a point or a comma; NaN if it is none."""
    text = text.strip()
    return float(text.replace(",", ".")) if NUMBER.fullmatch(text) else math.nan


def numbers(texts: Sequence[str]) -> tuple[NDArray[np.float64], dict[int, str]]:
    """Return numbers, NaN where missing, and by index the texts that are none."""
    joined = "".join(texts)
    if joined.isascii() and "_" not in joined:
        try:
            values = np.array(list(map(float, texts)))
        except ValueError:
            pass
        else:
            if not np.isinf(values).any():
                return values, {}
    values = np.array([number(text) for text in texts], np.float64)
    unknown = (int(i) for i in np.flatnonzero(~np.isfinite(values)))
    return values, {i: texts[i] for i in unknown if texts[i].strip().lower() not in MISSING}


def without_fills(
    lat: NDArray[np.float64], lon: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return positions with NaN in both where a value means that there is none, such as 91, 181 or -9999."""
    missing = np.isnan(lat) | np.isnan(lon) | (lat == NO_LAT)
    for values in (lat, lon):
        missing |= np.isin(values, FILLS) | (np.abs(values) >= HUGE)
    if not np.any(lon[~missing & (lon != NO_LON)] > 180.0):  # else 181 is a place in the Pacific
        missing |= lon == NO_LON
    return np.where(missing, np.nan, lat), np.where(missing, np.nan, lon)
