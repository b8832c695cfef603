"""ParallelEnv: one swarm, an agent per buoy, as PettingZoo has environments of several agents."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from shoal.learn.episodes import Episodes
from shoal.learn.errors import LearnError
from shoal.learn.libraries import PETTINGZOO_PARALLEL_ENV, needed
from shoal.learn.spaces import action_box, observation_box, state_box
from shoal.learn.spec import Act, Observe
from shoal.scenario.load import Source


class ParallelEnv(PETTINGZOO_PARALLEL_ENV):  # type: ignore[misc]
    """A swarm of N agents, buoy_0 to buoy_N-1, which observe (F,), do (A,) and are rewarded each for itself.

    >>> env = ParallelEnv(shoal.load("oceans2020", neighbors=8, steps=1000))
    >>> observations, infos = env.reset(seed=1)
    >>> actions = {agent: env.action_space(agent).sample() for agent in env.agents}
    >>> observations, rewards, terminations, truncations, infos = env.step(actions)

    An episode has as many steps as the scenario; an agent that is lost is terminated. Who has not joined yet observes
    zeros. Episode n of a seed is its run n.

    Parameters
    ----------
    scenario : what shoal.load takes
    observe, act, reward : see Observe, Act and Episodes; default: Observe(), Act() and {"time_on_target": 1.0}

    Attributes
    ----------
    episodes : the swarm; its `terms`, (1, N, R), are what rewards are made of
    state_space : of `state`, (5 N + 3 T,) numbers of 32 bits
    """

    metadata = {"name": "shoal", "render_modes": [], "is_parallelizable": True}  # noqa: RUF012 (PettingZoo's word)

    def __init__(
        self,
        scenario: Source,
        *,
        observe: Observe | None = None,
        act: Act | None = None,
        reward: Mapping[str, float] | None = None,
    ) -> None:
        needed("pettingzoo", "an environment with an agent per buoy")
        act = act or Act()
        self.episodes = Episodes(scenario, 1, observe or Observe(), act, reward or {"time_on_target": 1.0})
        self.render_mode = None
        self.possible_agents = [f"buoy_{i}" for i in range(self.episodes.scenario.agents)]
        self.agents: list[str] = []
        self._number = {agent: i for i, agent in enumerate(self.possible_agents)}
        self.observation_spaces = {agent: observation_box(self.episodes, i) for agent, i in self._number.items()}
        self.state_space = state_box(self.episodes)
        self.action_spaces = {agent: action_box(self.episodes, act, i) for agent, i in self._number.items()}

    def observation_space(self, agent: str) -> Any:
        """What an agent can know."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> Any:
        """What an agent can do."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begin an episode; return what each agent knows, and nothing else of it.

        Parameters
        ----------
        seed : default: the next episode of the seed that there is
        options : none are known
        """
        self.episodes.reset(seed)
        self.agents = list(self.possible_agents)
        return self._each(self.episodes.observations[0].copy()), {agent: {} for agent in self.agents}

    def step(self, actions: Mapping[str, Any]) -> tuple[dict[str, Any], ...]:
        """Do a step; return observations, rewards, terminations, truncations and infos of all agents that were there.

        Parameters
        ----------
        actions : (A,) of each agent in `agents`

        Raises
        ------
        LearnError : the episode is over; somebody has no action, or does not act
        """
        if not self.agents:
            raise LearnError("the episode", "is over", "begin another one: reset()")
        if actions.keys() != set(self.agents):
            odd = sorted(actions.keys() ^ set(self.agents), key=lambda agent: self._number.get(agent, -1))
            raise LearnError("actions", f"of {odd[0]} are too many or missing", "give one for each of `agents`")
        wanted = np.zeros(self.episodes.actions.shape)
        for agent, action in actions.items():
            wanted[0, self._number[agent]] = action
        episodes = self.episodes
        episodes.step(wanted)
        gone, over = episodes.gone(0), bool(episodes.over()[0])
        terminations = {agent: bool(gone[self._number[agent]]) for agent in self.agents}
        truncations = {agent: over and not terminations[agent] for agent in self.agents}
        rewards = {agent: float(episodes.rewards[0, self._number[agent]]) for agent in self.agents}
        given = self._each(episodes.observations[0].copy()), rewards, terminations, truncations
        infos: dict[str, Any] = {agent: {} for agent in self.agents}
        self.agents = [agent for agent in self.agents if not (over or terminations[agent])]
        return *given, infos

    def state(self) -> Any:
        """What is true, (5 N + 3 T,), see Episodes.state: for a centralized critic; no policy of a buoy knows it."""
        return self.episodes.state()

    def render(self) -> None:
        """Nothing: `shoal watch` shows runs."""

    def close(self) -> None:
        """Nothing is open."""

    def _each(self, observations: Any) -> dict[str, Any]:
        return {agent: observations[self._number[agent]] for agent in self.agents}
