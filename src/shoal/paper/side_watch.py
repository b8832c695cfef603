"""What no metric of a run tells: whether buoys pass each other, and whether they fill the area, seen in frames."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.experiments.design import Point
from shoal.paper.curves import Floats
from shoal.paper.plan import SHARE_NEIGHBORS, SPEEDS
from shoal.paper.side_plan import CONSTANT, constant
from shoal.record.trajectory import Trajectory
from shoal.run.simulation import Simulation
from shoal.scenario.edit import apply
from shoal.scenario.load import read_table, scenario_from

NEAREST = 6  # neighbors of a hexagonal lattice
APART = 100  # steps after which neighbors are compared
FIELDS = 5  # along each side of the area open to buoys: two buoys a field, if they are even
_EVERY = 50


class Watched(NamedTuple):
    """What was seen in every run (R,).

    turnover : by (a_R, or None where it adapts; target speed): share of the six nearest that others replace in 10 s
    filled : by (a_R, k): share of 25 equal fields of the buoys' area with a buoy in it, without any target
    """

    turnover: dict[tuple[float | None, float], Floats]
    filled: dict[tuple[float, int], Floats]


def watch_sides(preset: str, steps: int, runs: int) -> Watched:
    """Run the mixed swarm with adaptive and with equal constant a_R, and without a target at the largest a_R.

    steps : of each run, at least 400
    """
    steps = max(steps, 400)
    turnover = {
        (strength, speed): _each_run(
            preset, {"target_speed": speed, **(constant(strength) if strength else {})}, steps, runs
        )
        for strength in (None, *CONSTANT)
        for speed in SPEEDS
    }
    filled = {
        (strength, k): _each_run(preset, {"neighbors": k, **constant(strength), **_UNSEEN}, steps // 4, runs, fill=True)
        for strength, ks in ((CONSTANT[-1], SHARE_NEIGHBORS), (CONSTANT[0], (20,)))
        for k in ks
    }
    return Watched(turnover, filled)


def neighbor_turnover(frames: Trajectory, apart: int = APART // _EVERY) -> float:
    """Mean share of the six nearest agents that are others so many frames later."""
    x, y = np.asarray(frames.x), np.asarray(frames.y)
    near = np.array([_nearest(*frame) for frame in zip(x, y, strict=True)])
    stayed = (near[:-apart] & near[apart:]).sum(axis=2) / NEAREST
    return float(1.0 - stayed.mean())


def filled_share(frames: Trajectory, half_x: float, half_y: float) -> float:
    """Mean share of 5 x 5 equal fields of an area (half sides [m]) with an agent in it, over the later frames."""
    later = slice(len(frames.step) // 2, None)
    column, row = (
        np.clip(((np.asarray(places)[later] / half + 1.0) / 2.0 * FIELDS).astype(int), 0, FIELDS - 1)
        for places, half in ((frames.x, half_x), (frames.y, half_y))
    )
    return float(np.mean([len(set(fields)) for fields in (FIELDS * row + column).tolist()])) / FIELDS**2


_UNSEEN: Point = {"targets": [{"kind": "still", "radius": 0.0, "x": 0.1234, "y": 0.2345}]}  # a point: nobody is on it


def _each_run(preset: str, changes: Point, steps: int, runs: int, *, fill: bool = False) -> Floats:
    scenario = scenario_from(apply(read_table(preset), {**changes, "steps": steps}))
    found = []
    for run in range(runs):
        frames = Simulation(scenario, run).advance(steps, every=_EVERY)
        if frames is not None:
            area = scenario.area
            sides = (area.width / 2 - area.agent_margin, area.height / 2 - area.agent_margin)
            found.append(filled_share(frames, *sides) if fill else neighbor_turnover(frames))
    return np.array(found)


def _nearest(x: Floats, y: Floats) -> npt.NDArray[np.bool_]:
    """Whether agent j is among the six nearest of agent i, (N, N)."""
    square = (x[:, np.newaxis] - x) ** 2 + (y[:, np.newaxis] - y) ** 2
    np.fill_diagonal(square, np.inf)
    who = np.argsort(square, axis=1, kind="stable")[:, :NEAREST]
    near = np.zeros(square.shape, bool)
    np.put_along_axis(near, who, values=True, axis=1)
    return near
