"""Fixes of a GPX file."""

from pathlib import Path

from shoal.core.errors import TrackError
from shoal.tracks.points import Points
from shoal.tracks.table import Table
from shoal.tracks.wanted import Wanted
from shoal.tracks.xml_tree import xml_tree


def gpx_table(path: Path, wanted: Wanted) -> Table:
    """Return the points of every trk of a GPX file; a track has an index and may have a name.

    Raises
    ------
    TrackError : it is not XML, or holds no track
    """
    root = xml_tree(path, "GPX")
    tracks = root.findall("trk")
    if root.tag != "gpx" or not tracks:
        raise TrackError(str(path), "holds no <trk> inside <gpx>", "export a recorded track, not a route")
    points = Points(("track", "name"))
    for index, track in enumerate(tracks):
        cells = {"track": str(index), "name": track.findtext("name", "")}
        for point in track.iterfind("trkseg/trkpt"):
            points.add(
                point.findtext("time", ""), point.get("lat", ""), point.get("lon", ""), int(point.get("line", 0)), cells
            )
    return points.table(path, ("track",))
