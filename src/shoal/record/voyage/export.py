"""Export the tracks of a record for other programs: one door, a format per suffix."""

from collections.abc import Callable, Iterator, Sequence
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import NamedTuple

from shoal.core.errors import RecordError, ScenarioError, UnknownNameError
from shoal.core.files import atomic_file, check_file
from shoal.record.record import Record
from shoal.record.voyage.anchor import anchor_of, iso
from shoal.record.voyage.csv_text import csv_lines
from shoal.record.voyage.geojson import geojson_lines
from shoal.record.voyage.gpx import gpx_lines
from shoal.record.voyage.kml import kml_lines
from shoal.record.voyage.netcdf import write_netcdf
from shoal.record.voyage.nmea import nmea_lines
from shoal.record.voyage.voyages import Voyages, frames_of, voyages_of


class Exported(NamedTuple):
    """What was written: crafts that were there, times, and the first and the last of these in ISO 8601."""

    crafts: int
    times: int
    first: str
    last: str


class _Format(NamedTuple):
    suffixes: tuple[str, ...]
    write: Callable[[Voyages, Path], None]


def _write_text(lines: Callable[[Voyages], Iterator[str]], voyages: Voyages, path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.writelines(lines(voyages))


FORMATS = {
    "geojson": _Format((".geojson", ".json"), partial(_write_text, geojson_lines)),
    "kml": _Format((".kml",), partial(_write_text, kml_lines)),
    "gpx": _Format((".gpx",), partial(_write_text, gpx_lines)),
    "netcdf": _Format((".nc", ".nc4"), write_netcdf),
    "csv": _Format((".csv",), partial(_write_text, csv_lines)),
    "nmea": _Format((".nmea", ".nm4", ".aivdm"), partial(_write_text, nmea_lines)),
}


def export(
    record: Record,
    file: str | Path,
    *,
    to: str | None = None,
    run: int = 0,
    every: int | None = None,
    start: str | datetime | None = None,
    origin: Sequence[float] | None = None,
) -> Exported:
    """Write where every agent and target of a run was, on the Earth and in real time, to a new file.

    Parameters
    ----------
    record : what runs left behind
    file : where; a file that exists is never replaced
    to : "geojson", "kml", "gpx", "netcdf", "csv" or "nmea"; default what the suffix of `file` says
    run : number of the run, of those that kept frames
    every : only steps that are multiples of it; default all that were kept
    start : time of step 0, with its zone; default the start of the scenario's sea, or of its recorded track
    origin : (lon, lat) [deg] of local (0, 0); default the scenario's area.origin

    Raises
    ------
    RecordError : the run kept no frames, the file exists or cannot be written
    ScenarioError : where or when is unknown, or no place or time
    UnknownNameError : no format of this name
    MissingExtraError : pyproj is not installed; xarray or netCDF4 for netcdf, pyais for nmea
    """
    form = FORMATS[format_of(file, to)]
    check_file(file, new=True)
    frames = frames_of(record, run, every)
    anchor = anchor_of(record.scenario, origin=origin, start=start)
    voyages = voyages_of(frames, record.facts, anchor, record.scenario.name)
    if not voyages.there.any():
        raise RecordError(f"run {run}", "keeps no frame in which anybody is there", "export another run")
    with atomic_file(file, new=True) as partial_file:
        form.write(voyages, partial_file)
    first, last = (iso(int(voyages.times[at])) for at in (0, -1))
    return Exported(sum(1 for _ in voyages.known()), voyages.times.size, first, last)


def format_of(file: str | Path, to: str | None) -> str:
    """Return the name of a format: the one that is asked for, or that of a file's suffix.

    Raises
    ------
    UnknownNameError, ScenarioError : there is none
    """
    if to is not None:
        if to not in FORMATS:
            raise UnknownNameError.of("format", to, FORMATS)
        return to
    suffix = Path(file).suffix.lower()
    found = next((name for name, form in FORMATS.items() if suffix in form.suffixes), None)
    if found is None:
        known = ", ".join(form.suffixes[0] for form in FORMATS.values())
        raise ScenarioError(str(file), "does not say by its suffix what it is", f"name it {known}, or give --to")
    return found
