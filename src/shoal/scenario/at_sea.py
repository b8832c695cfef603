"""Read the files that a scenario's sea names: what it is made of, in the local frame."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.geodesy import Frame
from shoal.scenario.schema import Scenario

if TYPE_CHECKING:
    from shoal.sea.gridded import Gridded
    from shoal.sea.polygons import Polygon
    from shoal.sea.raster import Raster


@dataclass(frozen=True)
class OpenSea:
    """What a scenario's files hold.

    Attributes
    ----------
    frame : the local frame, None where the area has no origin
    currents, wind : on their grids; None where a flow has a formula, or there is none
    land : signed distances to the shore; None on open water
    shore : the same, of land and of all that is outside the search area
    coast, limits : the polygons of land and of the search area, as far as they are given as such
    notes : what was assumed or dropped
    digest : of all that was read from files; None if there were none
    """

    frame: Frame | None
    currents: "Gridded | None"
    wind: "Gridded | None"
    land: "Raster | None"
    shore: "Raster | None"
    notes: tuple[str, ...]
    digest: str | None
    coast: "tuple[Polygon, ...]" = ()
    limits: "tuple[Polygon, ...]" = ()


def open_sea(scenario: Scenario) -> OpenSea | None:
    """Read what the sea of a scenario names; None where it has none.

    Raises
    ------
    SeaError : a file cannot be used, or does not cover the arena for as long as the run lasts
    ScenarioError : it does not hold what the scenario was made with
    MissingExtraError : a library is needed and absent
    """
    sea = scenario.sea
    if sea is None:
        return None
    stamps = [(str(Path(file).absolute()), *_stamp(file)) for _, file in sorted(sea.files.items())]
    duration = scenario.steps * scenario.time_step
    key = (sea.model_dump_json(exclude={"digest"}), *stamps, scenario.area.model_dump_json(), duration)
    if key not in _KEPT:
        while len(_KEPT) > 3:
            _KEPT.pop(next(iter(_KEPT)))
        _KEPT[key] = _read(scenario)
    opened = _KEPT[key]
    if sea.digest not in (None, opened.digest):
        raise ScenarioError(
            "sea", "its files do not hold what this scenario was made with", "restore them, or drop sea.digest"
        )
    return opened


def signed(scenario: Scenario) -> Scenario:
    """Return the scenario with the digest of what the files of its sea hold.

    Raises
    ------
    SeaError, MissingExtraError : see open_sea
    """
    opened = open_sea(scenario)
    if opened is None or scenario.sea is None or opened.digest is None:
        return scenario
    sea = scenario.sea.model_copy(update={"digest": opened.digest})
    return scenario.model_copy(update={"sea": sea})


_KEPT: dict[tuple[Any, ...], OpenSea] = {}  # read once for all runs of a process


def _stamp(file: str) -> tuple[int, int]:
    """When a file was changed last, and its size: one that changes is read anew."""
    try:
        found = Path(file).stat()
    except OSError:
        return 0, 0
    return found.st_mtime_ns, found.st_size


def _read(scenario: Scenario) -> OpenSea:
    sea, area = scenario.sea, scenario.area
    assert sea is not None
    half_x, half_y = area.width / 2, area.height / 2
    frame = Frame(area.origin) if area.origin else None
    notes: list[str] = []
    digests: list[str] = []
    currents, wind = (_gridded(scenario, name, frame, notes, digests) for name in ("currents", "wind"))
    coast = _coast(sea.coast, frame, half_x, half_y, notes, digests)
    limits = _search_area(sea.search_area, frame, digests)
    without = None if coast is not None or currents is None or not currents.land.any() else currents
    land = shore = None
    if coast or without is not None or limits is not None:
        from shoal.sea.raster import land_raster

        if coast or without is not None:
            land = shore = land_raster(coast, without, frame, half_x, half_y, sea.cell)
            notes.extend(land.notes)
        if limits is not None:
            shore = land_raster(coast, without, frame, half_x, half_y, sea.cell, limits)
    digest = hashlib.sha256("".join(digests).encode()).hexdigest()[:16] if digests else None
    polygons = tuple(coast or ()), tuple(limits or ())
    return OpenSea(frame, currents, wind, land, shore, tuple(notes), digest, *polygons)


def _gridded(
    scenario: Scenario, name: str, frame: Frame | None, notes: list[str], digests: list[str]
) -> "Gridded | None":
    """Currents or wind of a file; None where there is no file."""
    sea, area = scenario.sea, scenario.area
    file = getattr(sea, name)
    if not isinstance(file, str):
        return None
    from shoal.sea.gridded import read_gridded

    assert frame is not None  # the scenario insists on an origin where there are files,
    assert sea is not None
    assert sea.start is not None  # and on a start
    duration = scenario.steps * scenario.time_step
    read = read_gridded(file, name, frame, area.width / 2, area.height / 2, sea.start, duration)
    notes.extend(read.notes)
    digests.append(read.digest)
    return read


def _coast(
    chosen: Any, frame: Frame | None, half_x: float, half_y: float, notes: list[str], digests: list[str]
) -> "list[Polygon] | None":
    """Land as polygons in local meters; None where nothing is said."""
    if not isinstance(chosen, str):
        return _inline(chosen)
    from shoal.sea.coast import read_coast

    assert frame is not None
    coast = read_coast(chosen, frame, half_x, half_y)
    notes.extend(coast.notes)
    digests.append(coast.digest)
    return list(coast.polygons)


def _search_area(chosen: Any, frame: Frame | None, digests: list[str]) -> "list[Polygon] | None":
    """The polygons that agents and targets stay in, in local meters; None where nothing is said."""
    if not isinstance(chosen, str):
        return _inline(chosen)
    from shoal.sea.raster import search_area

    assert frame is not None
    polygons = search_area(chosen, frame)
    corners = [ring for each in polygons for ring in (each.shell, *each.holes)]
    digests.append(hashlib.sha256(b"".join(np.round(ring, 3).tobytes() for ring in corners)).hexdigest())
    return polygons


def _inline(chosen: Any) -> "list[Polygon] | None":
    """Polygons that the scenario itself spells out."""
    from shoal.sea.polygons import Polygon

    return None if chosen is None else [Polygon(np.array([*corners, corners[0]], np.float64), []) for corners in chosen]
