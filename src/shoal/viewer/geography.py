"""Where on Earth a run is, for the page: land, longitude and latitude, currents. All of it is the run's own."""

from functools import lru_cache
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.errors import ShoalError
from shoal.core.geodesy import Frame
from shoal.core.graticule import Line, graticule
from shoal.run.arrows import ARROWS, arrow_places
from shoal.run.sea import EXACT, build_sea, flow_at, places_on_earth
from shoal.scenario.at_sea import OpenSea, open_sea
from shoal.scenario.schema import Area, Scenario
from shoal.scenario.sea import EddyFlow, TideFlow

FINENESS = 1500  # of the longer side: closer points of a shore are one
CELLS = 160  # along the longer side, of land that is known by a grid alone
TIMES = 200  # at which a current is told, at most
NUMBERS = 40_000  # of them all
BEYOND = 1.1  # of half the longer side: as far as places are known on Earth


def geography_of(scenario: Scenario) -> dict[str, Any] | None:
    """Return what the page shows of place and water (docs/reference/view-protocol.md); None where nothing is known.

    A record does not hold the files of its sea: where they are gone, what they held is left out.
    """
    if scenario.sea is None and scenario.area.origin is None:
        return None
    return _known(scenario.model_dump_json(include={"area", "sea", "steps", "time_step"}), _Key(scenario))


class _Key:
    """A scenario that is like any other in a cache: what matters of it is in the text beside it."""

    def __init__(self, scenario: Scenario) -> None:
        self.scenario = scenario

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Key)

    def __hash__(self) -> int:
        return 0


@lru_cache(maxsize=4)
def _known(text: str, key: _Key) -> dict[str, Any]:
    scenario = key.scenario
    try:
        opened = open_sea(scenario)
    except ShoalError:
        opened = None
    coast, limits = (opened.coast, opened.limits) if opened else ((), ())
    fine = max(scenario.area.width, scenario.area.height) / FINENESS
    return {
        "land": [_thinned(ring, fine) for each in coast for ring in (each.shell, *each.holes)],
        "limits": [_thinned(each.shell, fine) for each in limits],
        "cells": _cells(opened, scenario.area),
        "earth": _earth(scenario.area),
        "currents": _currents(scenario, opened),
    }


def _thinned(ring: npt.NDArray[np.float64], fine: float) -> list[float]:
    """x, y, x, y, ... of a ring [m], without points that are closer than this to the one before."""
    kept = [ring[0]]
    for point in ring[1:]:
        if max(abs(point - kept[-1])) >= fine:
            kept.append(point)
    decimals = max(0, int(np.ceil(-np.log10(fine))) + 1)
    numbers: list[float] = np.round(np.concatenate(kept), decimals).tolist()
    return numbers


def _cells(opened: OpenSea | None, area: Area) -> list[list[float]]:
    """Land that no polygon tells: rows of cells, each x, y of the southwest corner, width and height [m]."""
    if opened is None or opened.land is None or opened.coast:
        return []
    raster = opened.land
    every = max(1, max(raster.distance.shape) // CELLS)
    land = raster.distance[::every, ::every] < 0.0
    side = raster.cell * every
    edges = np.diff(np.pad(land, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    begin, end = np.argwhere(edges == 1), np.argwhere(edges == -1)
    west, south = raster.x0 - side / 2, raster.y0 - side / 2
    rows = zip(begin.tolist(), end.tolist(), strict=True)
    cells = [(west + i * side, south + j * side, (k - i) * side, side) for (j, i), (_, k) in rows]
    return np.round(cells, 1).tolist()  # type: ignore[no-any-return]


def _earth(area: Area) -> dict[str, Any] | None:
    """Longitude and latitude of places, and lines at round ones; None without an origin."""
    if area.origin is None:
        return None
    try:
        frame = Frame(area.origin)
    except ShoalError:
        return None
    size = BEYOND * max(area.width, area.height) / 2
    coefficients, worst = places_on_earth(frame, size)
    if not worst <= EXACT:
        return None
    return {
        "size": size,
        "lon": coefficients[0].tolist(),
        "lat": coefficients[1].tolist(),
        "error": worst,
        "lines": [_told(line) for line in graticule(frame, area.width / 2, area.height / 2) if line.x.size],
    }


def _told(line: Line) -> dict[str, Any]:
    x, y = (np.round(each, 1).tolist() for each in (line.x, line.y))
    return {"words": line.words, "meridian": line.meridian, "x": x, "y": y}


def _currents(scenario: Scenario, opened: OpenSea | None) -> dict[str, Any] | None:
    """The current at some places and times, linear between these; None in still water."""
    if opened is None or scenario.sea is None or scenario.sea.currents is None:
        return None
    flow, field = scenario.sea.currents, build_sea(scenario, opened).currents
    duration = scenario.steps * scenario.time_step
    period = flow.period if isinstance(flow, TideFlow) else None
    if period is not None:
        times = np.linspace(0.0, period, 25)
    elif isinstance(flow, EddyFlow):
        times = np.linspace(0.0, duration, 49)
    elif opened.currents is not None:
        times = np.union1d([0.0, duration], field.times[(field.times > 0.0) & (field.times < duration)])
    else:
        times = np.zeros(1)
    times = times[np.unique(np.linspace(0, times.size - 1, min(times.size, TIMES)).astype(int))]
    places, apart = arrow_places(scenario.area, opened.land, _along(times.size))
    values = np.array([flow_at(field, places, time) for time in times.tolist()])  # (T, P, 2)
    fastest = float(np.hypot(values[..., 0], values[..., 1]).max(initial=0.0))
    if fastest == 0.0:
        return None
    return {
        "times": np.round(times, 3).tolist(),
        "period": period,
        "fastest": fastest,
        "apart": apart,
        "places": np.round(places, 2).ravel().tolist(),
        "values": np.rint(values * 100.0 / fastest).astype(int).ravel().tolist(),  # % of the fastest
    }


def _along(times: int) -> int:
    """How many arrows along the longer side keep the numbers within their limit."""
    return int(max(5, min(ARROWS, np.sqrt(NUMBERS / (2 * times)))))
