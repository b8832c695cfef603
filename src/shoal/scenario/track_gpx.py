"""Fixes of a GPX file."""

from pathlib import Path
from xml.etree import ElementTree
from xml.parsers import expat

from shoal.core.errors import TrackError
from shoal.scenario.track_table import Row, Table


def gpx_table(path: Path) -> Table:
    """Return the points of every trk of a GPX file; a track has an index and may have a name."""
    root = _gpx_root(path)
    tracks = root.findall("trk")
    if root.tag != "gpx" or not tracks:
        raise TrackError(str(path), "holds no <trk> inside <gpx>", "export a recorded track, not a route")
    rows = [
        Row(
            place=f"{path}:{point.get('line')}",
            time=point.findtext("time", ""),
            lat=point.get("lat", ""),
            lon=point.get("lon", ""),
            cells=(str(index), track.findtext("name", "")),
        )
        for index, track in enumerate(tracks)
        for point in track.iterfind("trkseg/trkpt")
    ]
    return Table(("track", "name"), ("track",), rows)


def _gpx_root(path: Path) -> ElementTree.Element:
    """The tree, tags without namespace, each element with its line as attribute `line`."""
    builder = ElementTree.TreeBuilder()
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        builder.start(tag.rpartition(":")[2], {**attributes, "line": str(parser.CurrentLineNumber)})

    def end(tag: str) -> None:
        builder.end(tag.rpartition(":")[2])

    def refuse_doctype(*_: object) -> None:  # it can define entities: bombs, other files
        raise TrackError(f"{path}:{parser.CurrentLineNumber}", "has a DOCTYPE, which GPX needs not", "remove it")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse_doctype
    try:
        with path.open("rb") as file:
            parser.ParseFile(file)
    except expat.ExpatError as error:
        raise TrackError(
            f"{path}:{error.lineno}",
            f"is not XML ({expat.ErrorString(error.code)})",
            "export the track again",
        ) from error
    return builder.close()
