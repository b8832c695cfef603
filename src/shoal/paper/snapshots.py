"""Moments of a real run that the paper shows as pictures, found by rule and not by hand."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.drawing.footage import footage
from shoal.metrics.heading_bearing import which_stationary
from shoal.record.frames import engaged_by_frame
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.scenario.load import load
from shoal.scenario.schema import Scenario

STEPS = 20_000  # searched for the moments
_EDGE = 1e-6  # [m] from the wall
_ROUNDING = 1e-9  # [m] a_R climbs in steps that do not add up exactly

Flags = npt.NDArray[np.bool_]
Floats = npt.NDArray[np.float64]


class Locked(NamedTuple):
    """The frame with the most agents locked inside the area: `locked` (N,), `inside` (N,), those who do not touch the
    wall, and `pushing` (N,), those with a_R at its maximum.
    """

    frame: int
    locked: Flags
    inside: Flags
    pushing: Flags


class Clustering(NamedTuple):
    """Frames where the fast buoys are closest together and where they are apart again (None: not by the end).

    `distance` (K,) is the mean distance between two fast buoys [m] in every frame, `median` that of all frames [m].
    """

    together: int
    apart: int | None
    distance: Floats
    median: float


def watch(scenario: Scenario | None = None, steps: int = STEPS, run: int = 0) -> Record:
    """Run the paper's mixed swarm (or another scenario), and return the record with every frame kept."""
    return footage(scenario or load("oceans2020"), steps, run=run)


def find_locked(record: Record, run: int = 0) -> Locked:
    """Return the first frame with the most agents locked inside the area, off its wall, while another is on target.

    Of frames with equally many, the one with the most locked anywhere. An agent is locked if it has a_R at its
    maximum and is stationary, as in the histogram of phi.
    """
    frames = record.trajectories[run]
    top = record.roster.max_speed
    pushing = np.asarray(frames.memory["repulsion"]) >= record.scenario.strategy.params["repulsion_max"] - _ROUNDING
    locked = pushing & which_stationary(frames.vx, frames.vy, top)
    area = record.scenario.area
    inside = np.ones(locked.shape, bool)
    for places, side in ((frames.x, area.width), (frames.y, area.height)):
        inside &= np.abs(np.asarray(places)) < side / 2 - area.agent_margin - _EDGE
    tracked = engaged_by_frame(frames) > 0
    most = (locked & inside).sum(axis=1) * (locked.shape[1] + 1) + locked.sum(axis=1)
    frame = int(np.where(tracked, most, -1).argmax())
    return Locked(frame, locked[frame], inside[frame], pushing[frame])


def find_clustering(record: Record, run: int = 0) -> Clustering:
    """Return when the fast buoys are closest together while somebody is on target, and apart again later.

    Apart again is the first later frame in which their mean distance exceeds its median over all frames.
    """
    frames = record.trajectories[run]
    distance = mean_distance(frames, fast_agents(record))
    median = float(np.median(distance))
    tracking = engaged_by_frame(frames) > 0
    together = int(np.where(tracking, distance, np.inf).argmin())
    later = np.flatnonzero(distance[together:] > median)
    return Clustering(together, together + int(later[0]) if later.size else None, distance, median)


def fast_agents(record: Record) -> slice:
    """The agents of the fastest fleet."""
    fleet = int(np.argmax(record.facts.max_speeds))
    begin = sum(record.facts.counts[:fleet])
    return slice(begin, begin + record.facts.counts[fleet])


def mean_distance(frames: Trajectory, agents: slice) -> Floats:
    """Mean distance between two of the agents in every frame [m], (K,)."""
    x, y = np.asarray(frames.x[:, agents]), np.asarray(frames.y[:, agents])
    first, second = np.triu_indices(x.shape[1], 1)
    total = np.zeros(len(x))
    for i, j in zip(first, second, strict=True):  # pair by pair, so that memory does not grow with pairs
        total += np.hypot(x[:, i] - x[:, j], y[:, i] - y[:, j])
    distance: Floats = total / max(first.size, 1)
    return distance
