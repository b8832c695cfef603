"""Which reader takes which file."""

import difflib
import re
from collections.abc import Callable
from pathlib import Path

from shoal.core.errors import TrackError
from shoal.tracks.csv_file import csv_table
from shoal.tracks.geojson import geojson_table
from shoal.tracks.gpx import gpx_table
from shoal.tracks.kml import kml_table
from shoal.tracks.netcdf import netcdf_table
from shoal.tracks.nmea import nmea_table
from shoal.tracks.table import Table
from shoal.tracks.wanted import Wanted

START = 65_536  # [bytes] of a .txt or .log that tell what it is
NMEA_SENTENCE = re.compile(rb"[!$][A-Z]{2}(VDM|VDO|RMC|GGA|GLL|GSV),")


def text_table(path: Path, wanted: Wanted) -> Table:
    """Return the fixes of a text file that may be an NMEA log or a table."""
    with path.open("rb") as file:
        return (nmea_table if NMEA_SENTENCE.search(file.read(START)) else csv_table)(path, wanted)


READERS: dict[str, Callable[[Path, Wanted], Table]] = {
    ".csv": csv_table,
    ".tsv": csv_table,
    ".txt": text_table,
    ".dat": text_table,
    ".log": text_table,
    ".nmea": nmea_table,
    ".nm4": nmea_table,
    ".aivdm": nmea_table,
    ".gpx": gpx_table,
    ".kml": kml_table,
    ".geojson": geojson_table,
    ".json": geojson_table,
    ".mfjson": geojson_table,
    ".nc": netcdf_table,
    ".nc4": netcdf_table,
    ".cdf": netcdf_table,
}
CONVERSIONS = {
    ".kmz": "unzip it: the .kml inside is read",
    ".zip": "unzip it first",
    ".gz": "unpack it first",
    ".zst": "unpack it first",
    ".xlsx": "save the sheet as CSV, times as text such as 2022-01-03T00:05:07Z",
    ".xls": "save the sheet as CSV, times as text such as 2022-01-03T00:05:07Z",
    ".parquet": "pandas.read_parquet(FILE).to_csv('track.csv')",
    ".gpkg": "ogr2ogr track.csv FILE -lco GEOMETRY=AS_XY",
    ".shp": "ogr2ogr track.csv FILE -lco GEOMETRY=AS_XY",
    ".fit": "gpsbabel -i garmin_fit -f FILE -o gpx -F track.gpx",
    ".tcx": "gpsbabel -i gtrnctr -f FILE -o gpx -F track.gpx",
    ".alog": "write time, lat and lon from NAV_LAT and NAV_LONG (MOOS: aloggrep FILE NAV_LAT NAV_LONG) to CSV",
    ".bag": "write time, lat and lon of a NavSatFix topic to CSV",
}


def check_file(path: Path) -> None:
    """Refuse a file that is absent, empty or of an unknown kind.

    Raises
    ------
    TrackError : says what to do instead
    """
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise TrackError(
            str(path),
            f"tracks are read from {', '.join(READERS)} files, not from '{path.suffix or path.name}'",
            CONVERSIONS.get(suffix, "convert the file to one of these"),
        )
    if not path.is_file():
        there = [entry.name for entry in path.parent.iterdir()] if path.parent.is_dir() else []
        near = difflib.get_close_matches(path.name, there, n=1)
        raise TrackError(str(path), "no such file", f"did you mean {near[0]}?" if near else "check the path")
    if path.stat().st_size == 0:
        raise TrackError(str(path), "is empty", "record or export the track again")


def read_table(path: Path, wanted: Wanted) -> Table:
    """Return what a file holds, by the reader of its suffix.

    Raises
    ------
    TrackError : it cannot be read as what it seems to be
    MissingExtraError : a library that its format needs is not installed
    """
    try:
        return READERS[path.suffix.lower()](path, wanted)
    except OSError as error:
        raise TrackError(str(path), f"cannot be read ({error.strerror or error})", "check the file") from error
    except (UnicodeError, RecursionError, MemoryError) as error:
        raise TrackError(str(path), f"cannot be read ({error or type(error).__name__})", "export it again") from error
