"""Fixes of a KML file: gx:Track, or places that each have a TimeStamp."""

from collections.abc import Iterator
from pathlib import Path
from xml.etree.ElementTree import Element

from shoal.core.errors import TrackError
from shoal.tracks.points import Points
from shoal.tracks.table import Table
from shoal.tracks.wanted import Wanted
from shoal.tracks.xml_tree import xml_tree


def kml_table(path: Path, wanted: Wanted) -> Table:
    """Return the fixes of every gx:Track, or else of the placemarks with a time; both may have a name.

    Raises
    ------
    TrackError : it is not XML, or holds no track with times
    """
    root = xml_tree(path, "KML")
    tracked = Points(("track", "name"))
    placed = Points(("folder", "name"))
    index = 0
    for folder, placemark in _placemarks(root, ""):
        name = placemark.findtext("name", "").strip()
        for track in placemark.iter("Track"):
            times, places = track.findall("when"), track.findall("coord")
            if len(times) != len(places):
                raise TrackError(
                    f"{path}:{track.get('line')}",
                    f"has {len(times)} times <when> for {len(places)} places <gx:coord>",
                    "export the track again",
                )
            for when, coord in zip(times, places, strict=True):
                lon, lat, *_ = [*(coord.text or "").split(), "", ""]
                line = int(coord.get("line", 0))
                tracked.add(when.text or "", lat, lon, line, {"track": str(index), "name": name})
            index += 1
        stamp, at = placemark.find("TimeStamp/when"), placemark.find("Point/coordinates")
        if stamp is not None and at is not None:
            lon, lat, *_ = [*(at.text or "").strip().split(","), "", ""]
            placed.add(stamp.text or "", lat, lon, int(at.get("line", 0)), {"folder": folder, "name": name})
    if tracked.line:
        return tracked.table(path, ("track",))
    if placed.line:
        return placed.table(path, ("folder",) if len(set(placed.cells["folder"])) > 1 else None)
    raise TrackError(
        str(path),
        "holds no <gx:Track> and no placemarks with a <TimeStamp>" if root.tag == "kml" else "holds no <kml>",
        "export a recorded track with its times; a line or a route has none",
    )


def _placemarks(element: Element, folder: str) -> Iterator[tuple[str, Element]]:
    """Every placemark with the name of the folder that it lies in."""
    open_elements = [(folder, element)]
    while open_elements:
        folder, element = open_elements.pop()
        if element.tag == "Placemark":
            yield folder, element
            continue
        if element.tag in ("Folder", "Document"):
            folder = element.findtext("name", "").strip() or folder
        open_elements += [(folder, child) for child in reversed(element)]
