"""The spaces of observations and actions, in Gymnasium's words."""

from typing import Any

import numpy as np

from shoal.learn.episodes import Episodes
from shoal.learn.libraries import needed
from shoal.learn.spec import MOST, Act


def observation_box(episodes: Episodes, agent: int | None = None) -> Any:
    """What an agent can know, (F,); None: all agents of a swarm, (N, F). What is remembered has no bounds."""
    size = len(episodes.names)
    high = np.array([np.inf if name.startswith("memory.") else MOST for name in episodes.names], np.float32)
    shape = (size,) if agent is not None else (episodes.scenario.agents, size)
    return _box(np.broadcast_to(-high, shape), np.broadcast_to(high, shape))


def action_box(episodes: Episodes, act: Act, agent: int | None = None) -> Any:
    """What an agent can do, (A,); None: all agents of a swarm, (N, A)."""
    agents, size = episodes.scenario.agents, episodes.actions.shape[2]
    high = np.ones((agents, size), np.float32)
    if not act.scaled:
        high *= np.asarray(episodes.swarms.swarm(0).max_speed[:agents, None], np.float32)
    return _box(-high, high) if agent is None else _box(-high[agent], high[agent])


def state_box(episodes: Episodes) -> Any:
    """What is true of a swarm, (5 N + 3 T,): it has no bounds."""
    high = np.full(episodes.state().shape, np.inf, np.float32)
    return _box(-high, high)


def batched(space: Any, count: int) -> Any:
    """The space of `count` environments."""
    return needed("gymnasium", "an environment").vector.utils.batch_space(space, count)


def _box(low: Any, high: Any) -> Any:
    return needed("gymnasium", "an environment").spaces.Box(low, high, dtype=np.float32)
