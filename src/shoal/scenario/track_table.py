"""What a file of tracks holds, before any of it is checked."""

from collections.abc import Iterable, Sequence
from decimal import Decimal, InvalidOperation
from typing import NamedTuple

TIME_NAMES = ("time", "timestamp", "datetime", "date_time", "basedatetime", "base_date_time")
LAT_NAMES = ("lat", "latitude")
LON_NAMES = ("lon", "longitude", "lng", "long")
ID_NAMES = (
    "track_id", "trajectory", "trajectory_id", "mmsi", "drifter_id", "buoy_id",
    "vessel_id", "ship_id", "platform_id", "imo", "id", "name", "vessel_name", "vesselname",
)  # fmt: skip


class Row(NamedTuple):
    """One fix as the file has it, unchecked."""

    place: str
    time: str | float  # text, or decoded unix time [s]
    lat: str | float
    lon: str | float
    cells: Sequence[str]  # one for each of the table's columns
    missing: bool = False  # the file marks its time or position so


class Table(NamedTuple):
    """All fixes of a file."""

    columns: Sequence[str]
    id_columns: Sequence[str]  # those that tell tracks apart, the best first
    rows: Iterable[Row]


def comparable(text: str) -> Decimal | str:
    """Equal for '235070762' and '235070762.0'; exact, so long numbers stay apart."""
    try:
        number = Decimal(text.strip())
    except InvalidOperation:
        return text.strip()
    return number if number.is_finite() else text.strip()
