"""Xi and phi of single frames, of a record or of a run that is looked at, by the engine's own sums."""

from typing import Any, NamedTuple

import numpy as np

from shoal.core.agents import Floats, new_swarm
from shoal.metrics.contract import Facts, Step
from shoal.metrics.heading_bearing import phi_histogram, tally_heading_bearing
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import new_tally
from shoal.metrics.velocity_fluctuation import tally_velocity_fluctuation
from shoal.record.trajectory import Trajectory
from shoal.world.targets import TARGET

_tally_velocity_fluctuation: Any = tally_velocity_fluctuation  # kernels have no types that mypy sees
_tally_heading_bearing: Any = tally_heading_bearing


class _Agents(NamedTuple):
    agents: int


class _Room(NamedTuple):
    a: Floats
    b: Floats
    c: Floats


class Meter:
    """Xi and phi of a kept frame, by the engine's own sums over that frame alone."""

    def __init__(self, facts: Facts, kept: Trajectory) -> None:
        self._facts, self._kept = facts, kept
        self._swarm = new_swarm(list(facts.counts), ())
        self._swarm.max_speed[: facts.agents] = np.repeat(facts.max_speeds, facts.counts)
        self._targets = np.zeros(kept.target_x.shape[1], TARGET).view(np.recarray)
        self._world = _Agents(facts.agents)
        self._scratch = _Room(*(np.zeros(self._swarm.x.size) for _ in range(3)))

    def read(self, k: int) -> tuple[float, Floats]:
        """Xi, and phi (11,), of frame k."""
        kept, swarm, targets, agents = self._kept, self._swarm, self._targets, self._facts.agents
        for name in ("x", "y", "vx", "vy", "alive"):
            getattr(swarm, name)[:agents] = getattr(kept, name)[k]
        swarm.command_x[:], swarm.command_y[:] = swarm.vx, swarm.vy
        targets["x"], targets["y"], targets["present"] = kept.target_x[k], kept.target_y[k], kept.target_present[k]
        tally = new_tally(1, 1, len(self._facts.fleets), agents, targets.size)
        tally.steps[:] = 1
        _tally_velocity_fluctuation(tally, Step(0, 0, 0), self._world, swarm, targets, self._scratch)
        if targets["present"].any():
            tally.present[:] = 1
            _tally_heading_bearing(tally, Step(0, 0, 0), self._world, swarm, targets, self._scratch)
        return METRICS["xi"].formula(tally, self._facts), phi_histogram(tally).sum(axis=0)
