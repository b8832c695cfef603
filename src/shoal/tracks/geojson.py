"""Fixes of a GeoJSON or OGC Moving Features JSON file: points with a time, lines with their times, moving points."""

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from shoal.core.errors import TrackError
from shoal.tracks import names
from shoal.tracks.points import Points
from shoal.tracks.table import Table
from shoal.tracks.wanted import Wanted

TIMES = ("datetimes", "coordtimes", "times", "timestamps", "time", "timestamp")  # of a line: one for each position
UNTIMED = 'give each point a property "time", or each line "coordTimes" or "datetimes"'


def geojson_table(path: Path, wanted: Wanted) -> Table:
    """Return the fixes of all features; their properties are columns, `track` counts lines and moving points.

    Raises
    ------
    TrackError : it is not JSON, holds no positions, or a line has not as many times as positions
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8-sig"), parse_int=str, parse_float=str)
    except json.JSONDecodeError as error:
        raise TrackError(f"{path}:{error.lineno}", f"is not JSON ({error.msg})", "export the track again") from error
    points, lines = Points(), Points(("track",))
    for index, feature in enumerate(_features(content)):
        place = f"{path} feature {index}"
        properties = feature.get("properties")
        properties = properties if isinstance(properties, dict) else {}
        cells = {key: str(value) for key, value in {"id": feature.get("id"), **properties}.items() if _is_scalar(value)}
        for times, positions in _moving(place, feature, properties):
            track = {"track": str(index), **cells}
            for time, position in zip(times, positions, strict=True):
                lines.add(time, *_lat_lon(place, position), index, track)
        geometry = feature.get("geometry")
        if isinstance(geometry, dict) and geometry.get("type") == "Point" and "temporalGeometry" not in feature:
            column = _time_of(cells)
            points.add(cells.pop(column) if column else "", *_lat_lon(place, geometry.get("coordinates")), index, cells)
    if not (points.line or lines.line):
        raise TrackError(str(path), "holds no points or lines with times", UNTIMED)

    def place_of(index: int) -> str:
        return f"{path} feature {index}"

    if lines.line:
        return lines.table(path, ("track",), place_of, UNTIMED)
    return points.table(path, None, place_of, UNTIMED)


def _features(content: Any) -> Iterator[dict[str, Any]]:
    """The features of a collection, or of several inside each other."""
    unread = [content]
    while unread:
        node = unread.pop()
        if isinstance(node, list):
            unread += reversed(node)
        elif isinstance(node, dict):
            inside = node.get("features")
            if isinstance(inside, list):
                unread += reversed(inside)
            else:
                yield node if node.get("type") == "Feature" else {"geometry": node, **node}


def _is_scalar(value: Any) -> bool:
    return isinstance(value, str | bool)  # numbers are text, too


def _time_of(cells: Mapping[str, str]) -> str | None:
    columns = list(cells)
    at = names.find(columns, (*names.TIME_NAMES, "t"), names.TIME_LIKE)
    return None if at is None else columns[at]


def _moving(
    place: str, feature: Mapping[str, Any], properties: Mapping[str, Any]
) -> Iterator[tuple[list[str], list[Any]]]:
    """Times and positions of each line or moving point of a feature."""
    moving = feature.get("temporalGeometry")
    if isinstance(moving, dict):
        parts = moving.get("prisms") if isinstance(moving.get("prisms"), list) else [moving]
        for part in parts or []:
            if isinstance(part, dict):
                yield _paired(place, _list(part.get("datetimes")), _list(part.get("coordinates")))
        return
    geometry = feature.get("geometry")
    if not isinstance(geometry, dict):
        return
    inner = properties.get("coordinateProperties")
    known = {
        names.plain(key): value for key, value in {**properties, **(inner if isinstance(inner, dict) else {})}.items()
    }
    times = next((known[name] for name in TIMES if isinstance(known.get(name), list)), None)
    positions = _list(geometry.get("coordinates"))
    if geometry.get("type") == "LineString":
        if times is None and positions and all(isinstance(each, list) and len(each) > 3 for each in positions):
            times = [each[3] for each in positions]
        yield _paired(place, times or [""] * len(positions), positions)
    elif geometry.get("type") == "MultiLineString":
        pieces = [_list(each) for each in positions]
        lists = _list(times) or [[""] * len(piece) for piece in pieces]
        if lists and not isinstance(lists[0], list):
            lists, pieces = [lists], [[each for piece in pieces for each in piece]]
        if len(lists) != len(pieces):
            raise _unpaired(place, len(lists), len(pieces))
        for some, piece in zip(lists, pieces, strict=True):
            yield _paired(place, _list(some), piece)


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _paired(place: str, times: Sequence[Any], positions: list[Any]) -> tuple[list[str], list[Any]]:
    if len(times) != len(positions):
        raise _unpaired(place, len(times), len(positions))
    return ["" if each is None else str(each) for each in times], positions


def _unpaired(place: str, times: int, positions: int) -> TrackError:
    return TrackError(place, f"has {times} times for {positions} positions", "export the track again")


def _lat_lon(place: str, position: Any) -> tuple[str, str]:
    if not isinstance(position, list) or len(position) < 2:
        raise TrackError(place, "has no position [lon, lat]", "export the track again")
    lon, lat = ("" if each is None else str(each) for each in position[:2])
    return lat, lon
