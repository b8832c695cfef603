"""What frames show, measured: how many are on a target, Xi, phi, and whom agents hear. Nothing else measures frames."""

import hashlib
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError
from shoal.core.links import MOST_LINKED, unpacked
from shoal.metrics.contract import Facts
from shoal.metrics.heading_bearing import CENTERS, phi_histogram
from shoal.metrics.moment import Agents, Room, tally_moment
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import new_tally
from shoal.record.trajectory import Trajectory

PHI_EDGES = np.concatenate([[-1.0], (CENTERS[:-1] + CENTERS[1:]) / 2, [1.0]])  # of the 11 bins of phi

_tally_moment: Any = tally_moment  # kernels have no types that mypy sees
_TARGET = np.dtype([("x", np.float64), ("y", np.float64), ("present", np.int64)])


def trajectory_sha256(frames: Trajectory, steps: int) -> str | None:
    """SHA-256 of where all agents were: little-endian doubles x (N,), then y (N,), of one frame after the other.

    None unless the frames of all of so many steps were kept.
    """
    if len(frames.step) != steps:
        return None
    digest = hashlib.sha256()
    for x, y in zip(frames.x, frames.y, strict=True):
        for each in (x, y):
            digest.update(np.ascontiguousarray(each, "<f8").tobytes())
    return digest.hexdigest()


def engaged_by_frame(frames: Trajectory) -> npt.NDArray[np.int64]:
    """How many agents are on a present target, (K,). False alarms do not count."""
    engaged: npt.NDArray[np.int64] = np.asarray(frames.engaged).sum(axis=1)
    return engaged


def present_by_frame(frames: Trajectory) -> npt.NDArray[np.bool_]:
    """Whether a target is present, (K,)."""
    present: npt.NDArray[np.bool_] = np.any(frames.target_present, axis=1)
    return present


class Moment(NamedTuple):
    """What the metrics say of one frame.

    xi : velocity fluctuation over the mean top speed
    phi : (F, 11) agents of each fleet per bin of phi; NaN where no target is present. The heading is that of the
        velocity which an agent last wanted, within its limits, the bearing that to the nearest target of the frame
    """

    xi: float
    phi: npt.NDArray[np.float64]


class _Swarm(NamedTuple):
    """The fields of a swarm that `tally_moment` reads."""

    x: Any
    y: Any
    vx: Any
    vy: Any
    command_x: Any
    command_y: Any
    alive: Any
    max_speed: Any
    fleet_end: Any


def moment_of(frames: Trajectory, at: int, facts: Facts) -> Moment:
    """Xi and phi of a frame, by the metrics' own sums over it alone."""
    swarm = _Swarm(
        **{name: np.array(getattr(frames, name)[at], np.float64) for name in _Swarm._fields[:7]},
        max_speed=np.repeat(facts.max_speeds, facts.counts),
        fleet_end=np.cumsum(facts.counts),
    )
    targets = np.zeros(frames.target_x.shape[1], _TARGET).view(np.recarray)
    targets["x"], targets["y"] = frames.target_x[at], frames.target_y[at]
    targets["present"] = frames.target_present[at]
    tally = new_tally(1, 1, len(facts.fleets), facts.agents, targets.size)
    scratch = Room(*(np.empty(facts.agents) for _ in range(3)))
    _tally_moment(tally, Agents(facts.agents), swarm, targets, scratch)
    return Moment(METRICS["xi"].formula(tally, facts), phi_histogram(tally))


def who_hears_whom(frames: Trajectory, at: int) -> npt.NDArray[np.bool_]:
    """Whom each agent really heard in the step that a frame begins, (N, N): row i is true where i heard j.

    Raises
    ------
    RecordError : links were not kept
    """
    if not frames.links.shape[2]:
        agents = frames.x.shape[1]
        problem, fix = f"keep no links: there are more than {MOST_LINKED} agents", "draw them without links"
        if agents <= MOST_LINKED:
            problem, fix = "keep no links: an older Shoal wrote them", "run the scenario again, or draw without links"
        raise RecordError(f"the frames of {agents} agents", problem, fix)
    return unpacked(frames.links[at])


def linked_pairs(frames: Trajectory, at: int) -> npt.NDArray[np.int64]:
    """Pairs (P, 2), i < j, each once, of which at least one heard the other in the step that a frame begins.

    Raises
    ------
    RecordError : links were not kept
    """
    heard = who_hears_whom(frames, at)
    pairs: npt.NDArray[np.int64] = np.argwhere(np.triu(heard | heard.T, 1))
    return pairs
