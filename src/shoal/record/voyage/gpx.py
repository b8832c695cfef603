"""Voyages as GPX 1.1: a track per craft, a segment per stretch without a break."""

from collections.abc import Iterator
from xml.sax.saxutils import escape, quoteattr

from shoal.core.version import VERSION
from shoal.record.voyage.anchor import iso_all
from shoal.record.voyage.voyages import DIGITS, Voyages


def gpx_lines(voyages: Voyages) -> Iterator[str]:
    """Yield the text of a file."""
    times = iso_all(voyages.times)
    yield '<?xml version="1.0" encoding="UTF-8"?>\n'
    yield f'<gpx version="1.1" creator={quoteattr(f"Shoal {VERSION}")} xmlns="http://www.topografix.com/GPX/1/1">\n'
    yield f"<metadata><name>{escape(voyages.title)}</name></metadata>\n"
    for m, craft in voyages.known():
        words = (("name", craft.name), ("desc", craft.fleet), ("src", craft.id), ("type", craft.kind))
        yield "<trk>" + "".join(f"<{tag}>{escape(text)}</{tag}>" for tag, text in words if text) + "\n"
        for piece in voyages.pieces(m):
            yield "<trkseg>\n"
            places = zip(voyages.lat[piece, m].tolist(), voyages.lon[piece, m].tolist(), times[piece], strict=True)
            for lat, lon, time in places:
                yield f'<trkpt lat="{lat:.{DIGITS}f}" lon="{lon:.{DIGITS}f}"><time>{time}</time></trkpt>\n'
            yield "</trkseg>\n"
        yield "</trk>\n"
    yield "</gpx>\n"
