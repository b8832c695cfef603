"""Do the fast buoys cluster, and do they disperse again? Episodes of a run, found by rule."""

from typing import NamedTuple

import numpy as np

from shoal.experiments.design import Point
from shoal.paper.curves import Floats
from shoal.record.trajectory import Trajectory
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.edit import apply
from shoal.scenario.load import read_table, scenario_from

CLUSTERED = 0.6  # of random fifteen buoys of fifty, fewer than one in a hundred lie as close together in most frames
DISPERSED = 0.9  # half of random fifteen lie closer together than 0.98
EVERY = 5  # steps between frames; buoys move half a target radius


class Episode(NamedTuple):
    """From the frame in which the fast buoys are clustered to that in which they are not, or the end of the run."""

    run: int
    begin: int
    steps: int
    dispersed: bool


def watch_clusters(
    steps: int, runs: int, target_speeds: tuple[float, ...], changes: Point | None = None, preset: str = "oceans2020"
) -> list[Episode]:
    """Return the episodes in runs of the paper's mixed swarm (k = 20), with changes to the preset."""
    table = apply(read_table(preset), changes or {})
    found = []
    for speed in target_speeds:
        scenario = scenario_from(apply(table, {"target_speed": speed, "steps": steps}))
        facts = facts_of(scenario)
        fleet = int(np.argmax(facts.max_speeds))
        first = sum(facts.counts[:fleet])
        for run in range(runs):
            frames = Simulation(scenario, run).advance(steps, every=EVERY)
            if frames is not None:
                found += episodes(closeness(frames, slice(first, first + facts.counts[fleet])), run)
    return found


def closeness(frames: Trajectory, agents: slice) -> Floats:
    """Root mean square distance of some agents from their own center / that of the swarm, in every frame (K,).

    1 where they are spread like the swarm, 0 where they are in one place. Relative, since the whole swarm draws
    together when it is on target.
    """
    return _radius(frames.x[:, agents], frames.y[:, agents]) / _radius(frames.x, frames.y)


def episodes(near: Floats, run: int = 0, every: int = EVERY) -> list[Episode]:
    """Cut a series of closeness into episodes: from below CLUSTERED until above DISPERSED."""
    found: list[Episode] = []
    begin: int | None = None
    for frame, value in enumerate(near):
        if begin is None and value < CLUSTERED:
            begin = frame
        elif begin is not None and value > DISPERSED:
            found.append(Episode(run, every * begin, every * (frame - begin), dispersed=True))
            begin = None
    if begin is not None:
        found.append(Episode(run, every * begin, every * (len(near) - begin), dispersed=False))
    return found


def _radius(x: Floats, y: Floats) -> Floats:
    square: Floats = x.var(axis=1) + y.var(axis=1)
    return np.sqrt(square)
