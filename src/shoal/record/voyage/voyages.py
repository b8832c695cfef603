"""Where every agent and target was on Earth, and when: the frames of a run, tied to charts and clocks."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError, ScenarioError
from shoal.core.geodesy import Frame, meters_per_degree
from shoal.core.text import plain
from shoal.metrics.contract import Facts
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.record.voyage.anchor import Anchor

KNOT = 1852.0 / 3600.0  # [m/s]
DIGITS = 8  # of degrees: 1.1 mm
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


class Places(NamedTuple):
    """The parts of a Trajectory that say where everybody was, for whom nothing else is known."""

    step: npt.NDArray[np.int64]
    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    on_target: npt.NDArray[np.bool_]
    alive: npt.NDArray[np.bool_]
    target_x: Floats
    target_y: Floats
    target_present: npt.NDArray[np.bool_]


class Voyages(NamedTuple):
    """Where M crafts were at K times, agents first; NaN where one was not there.

    title : name of the scenario
    crafts : who
    times : (K,) Unix time [us]
    there : (K, M) lost agents, those that have not joined and absent targets are not
    lon, lat : (K, M) [deg], from -180 to below 180; angles are from north, clockwise, and NaN of who stands still
    speed, course : (K, M) [m/s], [deg] over ground, the mean since the frame before; NaN at the first and after a gap
    heading : (K, M) [deg] of an agent's velocity through the water in the step before
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
    heading: Floats
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


def voyages_of(frames: Trajectory | Places, facts: Facts, anchor: Anchor, title: str) -> Voyages:
    """Return where everybody was.

    Raises
    ------
    ScenarioError : a time lies after the year 9999, or a place a quarter of the Earth away
    """
    seconds: Floats = np.asarray(frames.step, np.float64) * facts.time_step
    there = np.hstack([frames.alive, frames.target_present]).astype(np.bool_)
    known = there.copy()  # how they came here
    known[:1] = False
    known[1:] &= there[:-1]
    none = np.zeros(frames.target_x.shape)
    pairs = ((frames.x, frames.target_x), (frames.y, frames.target_y), (frames.vx, none), (frames.vy, none))
    x, y, vx, vy = (np.where(there, np.hstack(pair), 0.0) for pair in pairs)
    _check_near(x, y)
    lon, lat, speed, course, heading = (np.empty(there.shape) for _ in range(5))
    crafts = max(1, BLOCK // max(len(there), 1))
    for some in (np.s_[:, first : first + crafts] for first in range(0, there.shape[1], crafts)):
        here = x[some], y[some], *anchor.frame.geographic(x[some], y[some])
        lon[some], lat[some] = (np.where(there[some], part, np.nan) for part in here[2:])
        way = _way(anchor.frame, *here, *_since_before(x[some], y[some], seconds))
        speed[some], course[some] = (np.where(known[some], part, np.nan) for part in way)
        heading[some] = np.where(there[some], _way(anchor.frame, *here, vx[some], vy[some])[1], np.nan)
    lon = np.round(lon, DIGITS)
    return Voyages(
        title=plain(title),
        crafts=crafts_of(facts, frames.target_x.shape[1]),
        times=anchor.times(seconds),
        there=there,
        lon=np.where(lon >= 180.0, lon - 360.0, lon),
        lat=np.round(lat, DIGITS),
        speed=speed,
        course=course,
        heading=heading,
        on_target=np.hstack([frames.on_target, np.zeros(none.shape, np.bool_)]) & there,
    )


def _check_near(x: Floats, y: Floats) -> None:
    farthest = float(np.hypot(x, y).max(initial=0.0))
    if not farthest < QUARTER_OF_EARTH:
        raise ScenarioError(
            "area",
            f"reaches {farthest / 1e3:,.0f} km from its origin, where local meters mean nothing",
            "make it smaller",
        )


def _since_before(x: Floats, y: Floats, seconds: Floats) -> tuple[Floats, Floats]:
    """Mean velocities [m/s] since the frame before; 0 at the first."""
    since = np.diff(seconds, prepend=seconds[0] - 1.0)[:, np.newaxis]
    return np.diff(x, axis=0, prepend=x[:1]) / since, np.diff(y, axis=0, prepend=y[:1]) / since


def _way(frame: Frame, x: Floats, y: Floats, lon: Floats, lat: Floats, vx: Floats, vy: Floats) -> tuple[Floats, Floats]:
    """Speed [m/s] on the ellipsoid and direction [deg] of local velocities: of the way that a second leads."""
    further_lon, further_lat = frame.geographic(x + vx, y + vy)
    to_east, to_north = meters_per_degree(lat)
    east = ((further_lon - lon + 180.0) % 360.0 - 180.0) * to_east
    north = (further_lat - lat) * to_north
    speed = np.hypot(east, north)
    return speed, np.where(speed >= STILL, np.degrees(np.arctan2(east, north)) % 360.0, np.nan)
