"""Voyages as GeoJSON (RFC 7946): a feature per craft, a line with its times, cut at the antimeridian."""

import json
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

from shoal.record.voyage.anchor import iso, iso_all
from shoal.record.voyage.voyages import Craft, Voyages

Point = tuple[float, float, int, str, bool]  # lon, lat [deg], time [us], the same in words, on target


def geojson_lines(voyages: Voyages) -> Iterator[str]:
    """Yield the text of a FeatureCollection, a feature per line.

    Properties are id, kind, fleet and name, and beside each position its time (`coordTimes`) and whether the craft
    reports a target (`onTarget`), nested as the coordinates are. A craft that was away leaves a gap: a MultiLineString.
    A line needs two positions, so a fix by itself is written twice.
    """
    yield '{"type": "FeatureCollection", "generator": "Shoal", "name": ' + json.dumps(voyages.title) + ', "features": ['
    separator = ""
    times = iso_all(voyages.times)
    for m, craft in voyages.known():
        yield separator + json.dumps(_feature(craft, _lines(voyages, m, times)))
        separator = ",\n"
    yield "\n]}\n"


def _feature(craft: Craft, lines: list[list[Point]]) -> dict[str, Any]:
    coordinates: list[Any] = [[[lon, lat] for lon, lat, *_ in line] for line in lines]
    times: list[Any] = [[words for _, _, _, words, _ in line] for line in lines]
    on_target: list[Any] = [[on for *_, on in line] for line in lines]
    if len(lines) == 1:
        (coordinates,), (times,), (on_target,) = coordinates, times, on_target
    return {
        "type": "Feature",
        "id": craft.id,
        "properties": {
            "id": craft.id,
            "kind": craft.kind,
            "fleet": craft.fleet or None,
            "name": craft.name,
            "coordTimes": times,
            **({"onTarget": on_target} if craft.kind == "buoy" else {}),
        },
        "geometry": {"type": "LineString" if len(lines) == 1 else "MultiLineString", "coordinates": coordinates},
    }


def _lines(voyages: Voyages, m: int, words: list[str]) -> list[list[Point]]:
    """The stretches of a craft's way, each cut where it crosses the antimeridian."""
    lines: list[list[Point]] = []
    for piece in voyages.pieces(m):
        parts = (voyages.lon[piece, m], voyages.lat[piece, m], voyages.times[piece], voyages.on_target[piece, m])
        points = list(zip(*(part.tolist() for part in parts[:3]), words[piece], parts[3].tolist(), strict=True))
        line = [points[0]]
        for last, point in pairwise(points):
            if abs(point[0] - last[0]) > 180.0:
                end, begin = _cut(last, point)
                lines.append([*line, end])
                line = [begin]
            line.append(point)
        lines.append(line if len(line) > 1 else line * 2)
    return lines


def _cut(one: Point, other: Point) -> tuple[Point, Point]:
    """Where the way from one point to another meets the antimeridian, seen from each side."""
    side = 180.0 if one[0] > 0.0 else -180.0
    there = other[0] + 2.0 * side - one[0]  # degrees to the other point
    share = (side - one[0]) / there if there else 0.0
    lat = round(one[1] + share * (other[1] - one[1]), 8)
    time = round(one[2] + share * (other[2] - one[2]))
    return (side, lat, time, iso(time), one[4]), (-side, lat, time, iso(time), one[4])
