"""Voyages as CSV: a row per time and craft that is there."""

import csv
import math
from collections.abc import Iterator
from io import StringIO

from shoal.record.voyage.anchor import iso_all
from shoal.record.voyage.voyages import DIGITS, KNOT, Voyages

COLUMNS = ("time", "id", "kind", "fleet", "name", "lon", "lat", "sog_kn", "cog_deg", "heading_deg", "on_target")
FORMULA = ("=", "+", "-", "@", "\t", "\r")  # a cell that begins so is one to a spreadsheet


def csv_lines(voyages: Voyages) -> Iterator[str]:
    """Yield the text of a table, craft by craft; cells of what is unknown are empty.

    A name that a spreadsheet would take for a formula begins with an apostrophe.
    """
    row = StringIO()
    writer = csv.writer(row, lineterminator="\n")

    def line(*cells: object) -> str:
        row.seek(0)
        row.truncate()
        writer.writerow(cells)
        return row.getvalue()

    yield line(*COLUMNS)
    times = iso_all(voyages.times)
    for m, craft in voyages.known():
        who = (craft.id, craft.kind, _text(craft.fleet), _text(craft.name))
        for piece in voyages.pieces(m):
            columns = (voyages.lon, voyages.lat, voyages.speed, voyages.course, voyages.heading, voyages.on_target)
            values = zip(times[piece], *(column[piece, m].tolist() for column in columns), strict=True)
            for time, lon, lat, speed, course, heading, on in values:
                place = (f"{lon:.{DIGITS}f}", f"{lat:.{DIGITS}f}")
                motion = (_number(speed / KNOT, 3), _number(course, 1), _number(heading, 1))
                yield line(time, *who, *place, *motion, int(on) if craft.kind == "buoy" else "")


def _text(name: str) -> str:
    return f"'{name}" if name.startswith(FORMULA) else name


def _number(value: float, digits: int) -> str:
    return "" if math.isnan(value) else f"{value:.{digits}f}"
