"""Voyages as KML 2.2: a gx:Track per craft, to be played in time, in the colors of the fleets."""

from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from shoal.core.palette import FLEET_COLORS, TARGET
from shoal.record.voyage.anchor import iso_all
from shoal.record.voyage.voyages import DIGITS, Craft, Voyages

NAMESPACES = 'xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2"'


def kml_lines(voyages: Voyages) -> Iterator[str]:
    """Yield the text of a file: a folder per fleet and one of targets, a track per stretch without a break."""
    times = iso_all(voyages.times)
    fleets = list(dict.fromkeys(craft.fleet for craft in voyages.crafts))
    yield f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- Shoal -->\n<kml {NAMESPACES}>\n<Document>\n'
    yield f"<name>{escape(voyages.title)}</name>\n"
    for number, fleet in enumerate(fleets):
        yield _style(f"fleet-{number}", FLEET_COLORS[number % len(FLEET_COLORS)] if fleet else TARGET)
    for number, fleet in enumerate(fleets):
        yield f"<Folder><name>{escape(fleet or 'targets')}</name>\n"
        for m, craft in voyages.known():
            if craft.fleet == fleet:
                yield from _placemark(voyages, m, craft, f"fleet-{number}", times)
        yield "</Folder>\n"
    yield "</Document>\n</kml>\n"


def _style(name: str, color: str) -> str:
    """Lines and icons of a color, which KML writes backwards: alpha, blue, green, red."""
    color = f"<color>ff{color[5:7]}{color[3:5]}{color[1:3]}</color>".lower()
    icon = f"<IconStyle>{color}<scale>0.6</scale></IconStyle><LabelStyle><scale>0.6</scale></LabelStyle>"
    return f"<Style id={quoteattr(name)}>{icon}<LineStyle>{color}<width>2</width></LineStyle></Style>\n"


def _placemark(voyages: Voyages, m: int, craft: Craft, style: str, times: list[str]) -> Iterator[str]:
    data = "".join(
        f'<Data name="{name}"><value>{escape(text)}</value></Data>'
        for name, text in (("id", craft.id), ("kind", craft.kind), ("fleet", craft.fleet))
        if text
    )
    yield f"<Placemark><name>{escape(craft.name)}</name><styleUrl>#{style}</styleUrl>"
    yield f"<ExtendedData>{data}</ExtendedData>\n"
    pieces = voyages.pieces(m)
    if len(pieces) > 1:
        yield "<gx:MultiTrack><gx:interpolate>0</gx:interpolate>\n"
    for piece in pieces:
        yield "<gx:Track>\n"
        yield from (f"<when>{time}</when>\n" for time in times[piece])
        for lon, lat in zip(voyages.lon[piece, m].tolist(), voyages.lat[piece, m].tolist(), strict=True):
            yield f"<gx:coord>{lon:.{DIGITS}f} {lat:.{DIGITS}f} 0</gx:coord>\n"
        yield "</gx:Track>\n"
    if len(pieces) > 1:
        yield "</gx:MultiTrack>\n"
    yield "</Placemark>\n"
