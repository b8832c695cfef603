"""shoal export: where the buoys and targets of a record were, for maps, plotters and other programs."""

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger
from shoal.cli.older import opened
from shoal.cli.progress import note


def export(
    record: Path,
    /,
    *,
    out: Path,
    to: Literal["geojson", "kml", "gpx", "netcdf", "csv", "nmea"] | None = None,
    run: Integer = 0,
    every: MaybeInteger = None,
    start: str | None = None,
    origin: Annotated[str | None, Parameter(allow_leading_hyphen=True)] = None,
) -> None:
    """Write the tracks of a record, on the Earth and in real time, to a file for other programs.

    Parameters
    ----------
    record
        Folder made by `shoal run --out`.
    out
        File to write; one that exists is never replaced.
    to
        Format; default what the suffix of --out says: .geojson, .kml, .gpx, .nc, .csv, .nmea.
    run
        Number of the run.
    every
        Only steps that are multiples of this number; default all that were kept.
    start
        Time of step 0, such as 2015-11-16T06:00:00Z; default that of the scenario's sea or recorded track.
    origin
        Longitude and latitude of the center, LON,LAT in degrees; default the scenario's area.origin.
    """
    from shoal.core.files import check_file
    from shoal.record.voyage.anchor import place_of
    from shoal.record.voyage.export import export as write
    from shoal.record.voyage.export import format_of

    kind = format_of(out, to)
    check_file(out, new=True)
    place = None if origin is None else place_of(origin)
    made = write(opened(record), out, to=kind, run=run, every=every, start=start, origin=place)
    note(f"{kind}: {out}, {made.crafts} buoys and targets at {made.times:,} times, {made.first} to {made.last}")
