"""Where every agent and target was on Earth, and when: the frames of a run, tied to charts and clocks."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError, ScenarioError
from shoal.core.text import plain
from shoal.metrics.contract import Facts
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.record.voyage.anchor import Anchor

KNOT = 1852.0 / 3600.0  # [m/s]
DIGITS = 8  # of degrees: 1.1 mm
RADIUS, SQUARED = 6378137.0, 0.0066943799901413165  # of WGS84: equator [m], eccentricity squared
QUARTER_OF_EARTH = 1e7  # [m] from pole to equator
BLOCK = 250_000  # places worked out at once
STILL = 1e-3  # [m/s] slower than this has no course

Floats = npt.NDArray[np.float64]


class Craft(NamedTuple):
    """An agent or a target, as others name it.

    id : "agent-7", "target-0"; number : 7, 0
    kind : "buoy" or "target"; fleet : name of the fleet, "" of a target
    name : of fleet and number; no two have the same
    """

    id: str
    number: int
    kind: str
    fleet: str
    name: str


class Voyages(NamedTuple):
    """Where M crafts were at K times, agents first; NaN where one was not there.

    title : name of the scenario
    crafts : who
    times : (K,) Unix time [us]
    there : (K, M) lost agents, those that have not joined and absent targets are not
    lon, lat : (K, M) [deg], from -180 to below 180
    speed : (K, M) [m/s] over ground; course : (K, M) [deg] from north, clockwise; NaN where unknown, or none
    on_target : (K, M) what an agent reports
    """

    title: str
    crafts: Sequence[Craft]
    times: npt.NDArray[np.int64]
    there: npt.NDArray[np.bool_]
    lon: Floats
    lat: Floats
    speed: Floats
    course: Floats
    on_target: npt.NDArray[np.bool_]

    def known(self) -> Iterator[tuple[int, Craft]]:
        """Column and craft of all that were ever there."""
        return ((m, craft) for m, craft in enumerate(self.crafts) if self.there[:, m].any())

    def pieces(self, m: int) -> list[slice]:
        """The stretches of frames over which craft `m` was there without a break."""
        edges = np.flatnonzero(np.diff(np.concatenate([[False], self.there[:, m], [False]]).astype(np.int8)))
        return [slice(first, last) for first, last in edges.reshape(-1, 2).tolist()]


def crafts_of(facts: Facts, targets: int) -> list[Craft]:
    """All agents, then all targets."""
    fleets = [plain(name) for name, count in zip(facts.fleets, facts.counts, strict=True) for _ in range(count)]
    agents = [Craft(f"agent-{i}", i, "buoy", fleet, f"{fleet} {i}") for i, fleet in enumerate(fleets)]
    return agents + [Craft(f"target-{j}", j, "target", "", f"target {j}") for j in range(targets)]


def frames_of(record: Record, run: int, every: int | None = None) -> Trajectory:
    """Return the frames that a record keeps of a run; with `every`, those of steps that are multiples of it.

    Raises
    ------
    RecordError : there are none
    ScenarioError : `every` is below 1
    """
    if run not in record.trajectories:
        kept = ", ".join(map(str, record.trajectories))
        fix = f"there are frames of run {kept}" if kept else "run the scenario again with --out, or with --every 1"
        raise RecordError(f"run {run}", "keeps no frames", fix)
    frames = record.trajectories[run]
    if every is None:
        return frames
    if every < 1:
        raise ScenarioError("every", f"is {every}", "ask for 1 or more")
    chosen = np.flatnonzero(np.asarray(frames.step) % every == 0)
    if not chosen.size:
        raise RecordError(f"run {run}", f"keeps no frame of a step that is a multiple of {every}", "ask for fewer")
    return Trajectory.from_arrays({name: part[chosen] for name, part in frames.arrays().items()})


def voyages_of(frames: Trajectory, facts: Facts, anchor: Anchor, title: str) -> Voyages:
    """Return where everybody was.

    The velocity of an agent is the one that it made in the step before a frame, that of a target its mean since the
    frame before; of neither more is known.

    Raises
    ------
    ScenarioError : a time lies after the year 9999, or a place a quarter of the Earth away
    """
    seconds: Floats = np.asarray(frames.step, np.float64) * facts.time_step
    times = anchor.times(seconds)
    pairs = ((frames.x, frames.target_x), (frames.y, frames.target_y))
    velocities = zip((frames.vx, frames.vy), _mean_velocities(frames, seconds), strict=True)
    sources = (*pairs, *velocities)
    there = np.hstack([frames.alive, frames.target_present]).astype(np.bool_)
    places = [np.empty(there.shape) for _ in range(4)]
    rows = max(1, BLOCK // there.shape[1])
    for block in (slice(first, first + rows) for first in range(0, len(there), rows)):
        away = ~there[block]
        x, y, vx, vy = (np.where(away, 0.0, np.hstack([each[block] for each in pair])) for pair in sources)
        _check_near(x, y)
        for whole, part in zip(places, _on_earth(anchor, x, y, vx, vy), strict=True):
            whole[block] = np.where(away, np.nan, part)
    lon, lat, speed, course = places
    on_target = np.hstack([frames.on_target, np.zeros(frames.target_x.shape, np.bool_)]) & there
    crafts = crafts_of(facts, frames.target_x.shape[1])
    return Voyages(plain(title), crafts, times, there, lon, lat, speed, course, on_target)


def _check_near(x: Floats, y: Floats) -> None:
    farthest = float(np.hypot(x, y).max(initial=0.0))
    if not farthest < QUARTER_OF_EARTH:
        raise ScenarioError(
            "area",
            f"reaches {farthest / 1e3:,.0f} km from its origin, where local meters mean nothing",
            "make it smaller",
        )


def _mean_velocities(frames: Trajectory, seconds: Floats) -> tuple[Floats, Floats]:
    """Velocities of targets since the frame before, NaN at the first and after an absence, (K, T) each [m/s]."""
    present = np.asarray(frames.target_present, np.bool_)
    since = np.diff(seconds)[:, np.newaxis]
    velocities = []
    for place in (frames.target_x, frames.target_y):
        velocity = np.full(place.shape, np.nan)
        velocity[1:] = np.where(present[1:] & present[:-1], np.diff(place, axis=0) / since, np.nan)
        velocities.append(velocity)
    return velocities[0], velocities[1]


def _on_earth(anchor: Anchor, x: Floats, y: Floats, vx: Floats, vy: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Longitude, latitude [deg], speed over ground [m/s] and course [deg] of local places and velocities.

    Speed and course are of the way that a second leads, on the ellipsoid: with radii of curvature M (north) and N,

    north = M dlat,  east = N cos(lat) dlon
    """
    moved = np.isfinite(vx) & np.isfinite(vy)
    lon, lat = (np.asarray(each, np.float64) for each in anchor.frame.geographic(x, y))
    further = anchor.frame.geographic(x + np.where(moved, vx, 0.0), y + np.where(moved, vy, 0.0))
    dlon = np.radians((further[0] - lon + 180.0) % 360.0 - 180.0)
    dlat = np.radians(further[1] - lat)
    bend = 1.0 - SQUARED * np.sin(np.radians(lat)) ** 2
    north = RADIUS * (1.0 - SQUARED) / bend**1.5 * dlat
    east = RADIUS / np.sqrt(bend) * np.cos(np.radians(lat)) * dlon
    speed = np.where(moved, np.hypot(east, north), np.nan)
    course = np.where(speed >= STILL, np.degrees(np.arctan2(east, north)) % 360.0, np.nan)
    lon = np.round(lon, DIGITS)
    return np.where(lon >= 180.0, lon - 360.0, lon), np.round(lat, DIGITS), speed, course
