"""Polygons of a GeoJSON file, around an arena, in its local meters."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import SeaError
from shoal.core.geodesy import Frame
from shoal.core.text import quoted
from shoal.sea.clip import clipped
from shoal.sea.opened import check_there
from shoal.sea.window import Window

Ring = NDArray[np.float64]

DEGREES = re.compile(r"(CRS:?84|EPSG:{1,2}(4326|4258|4269|4979)|WGS ?84)$", re.IGNORECASE)
LONGEST_EDGE = 0.02  # [deg] straight in the file is straight in local meters within 0.2 m
MOST_PIECES = 100_000  # of an edge
CONVERSIONS = {
    ".shp": "ogr2ogr -t_srs EPSG:4326 coast.geojson FILE",
    ".gpkg": "ogr2ogr -t_srs EPSG:4326 coast.geojson FILE",
    ".kml": "ogr2ogr coast.geojson FILE",
    ".kmz": "ogr2ogr coast.geojson FILE",
    ".zip": "unpack it, then: ogr2ogr -t_srs EPSG:4326 coast.geojson FILE.shp",
}
LINES = "give areas, such as the land polygons of osmdata.openstreetmap.de, not lines"


class Polygon(NamedTuple):
    """A shell and its holes, closed rings (n, 2)."""

    shell: Ring
    holes: list[Ring]


def read_polygons(path: Path) -> tuple[list[Polygon], list[str]]:
    """Return all polygons of a file, in longitude and latitude [deg], and what was left out.

    Raises
    ------
    SeaError : it is not GeoJSON in longitude and latitude, a ring is not closed, or it holds no polygons
    """
    content = _content(path)
    polygons: list[Polygon] = []
    others: dict[str, int] = {}
    for place, kind, coordinates in _geometries(path, content):
        if kind == "Polygon":
            polygons.append(_polygon(place, coordinates))
        elif kind == "MultiPolygon":
            polygons += [_polygon(place, each) for each in _list(place, coordinates)]
        else:
            others[kind] = others.get(kind, 0) + 1
    polygons = [each for each in polygons if len(each.shell)]
    said = ", ".join(f"{count} of type {quoted(kind)}" for kind, count in others.items())
    if not polygons:
        raise SeaError(str(path), f"holds no polygons{f', but {said}' if said else ''}", LINES)
    return polygons, [f"Geometries of {path.name} that are no polygons were left out: {said}."] if said else []


def around(polygons: list[Polygon], window: Window, margin: float) -> list[Polygon]:
    """Return the parts of polygons near a window, still in degrees, longitudes continuous around its origin.

    Parameters
    ----------
    polygons : in longitude and latitude [deg]
    margin : [deg] beyond the window
    """
    low = np.array((window.west - margin, max(-90.0, window.south - margin)))
    high = np.array((window.east + margin, min(90.0, window.north + margin)))
    kept = []
    for polygon in polygons:
        shell = _unwrapped(polygon.shell)
        moved = [_beside(_unwrapped(hole), shell) for hole in polygon.holes]
        turns = np.arange(
            np.ceil((low[0] - shell[:, 0].max()) / 360.0), np.floor((high[0] - shell[:, 0].min()) / 360.0) + 1
        )
        for turn in turns:
            shift = np.array((360.0 * turn, 0.0))
            part = clipped(shell + shift, low, high)
            if len(part):
                holes = [clipped(hole + shift, low, high) for hole in moved]
                kept.append(Polygon(part, [hole for hole in holes if len(hole)]))
    return kept


def in_meters(polygons: list[Polygon], frame: Frame) -> list[Polygon]:
    """Return polygons in local meters, their long edges as straight in longitude and latitude as they were."""

    def local(ring: Ring) -> Ring:
        fine = _fine(ring)
        return np.stack(frame.local(fine[:, 0], fine[:, 1]), axis=-1)

    return [Polygon(local(each.shell), [local(hole) for hole in each.holes]) for each in polygons]


def _content(path: Path) -> Any:
    check_there(path)
    if path.suffix.lower() in CONVERSIONS:
        problem = f"is a {path.suffix} file; polygons are read from GeoJSON"
        raise SeaError(str(path), problem, CONVERSIONS[path.suffix.lower()])
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"))
    except json.JSONDecodeError as error:
        raise SeaError(f"{path}:{error.lineno}", f"is not JSON ({error.msg})", "export it again, as GeoJSON") from error
    except (UnicodeDecodeError, RecursionError) as error:
        raise SeaError(str(path), "is not JSON in UTF-8", "export it again, as GeoJSON") from error
    if not isinstance(content, dict) or "type" not in content:
        raise SeaError(str(path), "is not GeoJSON: it is no object with a type", "export it again, as GeoJSON")
    crs = content.get("crs")
    properties = crs.get("properties") if isinstance(crs, dict) else None
    name = properties.get("name") if isinstance(properties, dict) else None
    if crs is not None and not (isinstance(name, str) and DEGREES.search(name)):
        problem = f"is in the coordinate system {quoted(name or crs)}, not in longitude and latitude (WGS 84)"
        raise SeaError(str(path), problem, f"ogr2ogr -t_srs EPSG:4326 degrees.geojson {path.name}")
    return content


def _geometries(path: Path, content: Any) -> Iterator[tuple[str, str, Any]]:
    """Place, type and coordinates of every geometry."""
    unread: list[tuple[str, Any]] = [(str(path), content)]
    while unread:
        place, node = unread.pop()
        if not isinstance(node, dict):
            if node is not None:  # a feature may have no geometry
                raise SeaError(place, f"is {quoted(node)}, not a GeoJSON object", "export the file again")
            continue
        kind = node.get("type")
        if kind == "FeatureCollection":
            features = _list(place, node.get("features"))
            unread += [(f"{path} feature {i}", each) for i, each in reversed(list(enumerate(features)))]
        elif kind == "Feature":
            unread.append((place, node.get("geometry")))
        elif kind == "GeometryCollection":
            unread += [(place, each) for each in reversed(_list(place, node.get("geometries")))]
        else:
            yield place, str(kind), node.get("coordinates")


def _list(place: str, value: Any) -> list[Any]:
    if not isinstance(value, list):
        raise SeaError(place, f"has {quoted(value)} where a list belongs", "export the file again, as GeoJSON")
    return value


def _polygon(place: str, coordinates: Any) -> Polygon:
    rings = [_ring(place, each, number) for number, each in enumerate(_list(place, coordinates))]
    return Polygon(rings[0], rings[1:]) if rings else Polygon(np.empty((0, 2)), [])


def _ring(place: str, positions: Any, number: int) -> Ring:
    where = f"{place} ring {number}"
    try:
        ring = np.array([(float(each[0]), float(each[1])) for each in _list(where, positions)], np.float64).reshape(
            -1, 2
        )
    except (TypeError, ValueError, IndexError, KeyError) as error:
        if isinstance(error, SeaError):
            raise
        raise SeaError(where, "has a position that is not [lon, lat]", "export the file again, as GeoJSON") from error
    if not np.isfinite(ring).all() or (np.abs(ring) > (540.0, 90.0 + 1e-9)).any():
        problem = "has positions that are not degrees of longitude and latitude"
        raise SeaError(where, problem, "ogr2ogr -s_srs EPSG:CODE -t_srs EPSG:4326 degrees.geojson FILE")
    if len(ring) < 4 or (ring[0] != ring[-1]).any():
        problem = "has fewer than 4 positions" if len(ring) < 4 else "is not closed: its last position is not its first"
        raise SeaError(where, problem, "repeat the first position of each ring at its end")
    return ring


def _unwrapped(ring: Ring) -> Ring:
    """A ring whose longitudes do not jump by 360; as it is if it goes around a pole."""
    lon = np.unwrap(ring[:, 0], period=360.0)
    return np.stack((lon, ring[:, 1]), axis=-1) if abs(lon[-1] - lon[0]) < 1e-6 else ring


def _beside(hole: Ring, shell: Ring) -> Ring:
    """A hole on the same turn of the Earth as its shell."""
    middle = (shell[:, 0].min() + shell[:, 0].max()) / 2.0
    turns = np.round((middle - (hole[:, 0].min() + hole[:, 0].max()) / 2.0) / 360.0)
    return np.asarray(hole + np.array((360.0 * turns, 0.0)))


def _fine(ring: Ring) -> Ring:
    """A ring with positions put into its long edges."""
    edges = np.abs(np.diff(ring, axis=0)).max(axis=1)
    pieces = np.clip(np.ceil(edges / LONGEST_EDGE), 1, MOST_PIECES).astype(np.intp)
    edge = np.repeat(np.arange(len(edges)), pieces)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(pieces) - pieces, pieces)) / pieces[edge]
    between = ring[edge] + share[:, None] * (ring[edge + 1] - ring[edge])
    return np.concatenate((between, ring[-1:]))
