"""VectorEnv: many swarms in one compiled call, as Gymnasium has vectors of environments; one policy for all agents."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np

from shoal.learn.episodes import Episodes
from shoal.learn.errors import LearnError
from shoal.learn.libraries import GYMNASIUM_VECTOR_ENV, needed
from shoal.learn.spaces import action_box, batched, observation_box
from shoal.learn.spec import Act, Observe
from shoal.scenario.load import Source

Autoreset = Literal["next-step", "same-step", "disabled"]


class VectorEnv(GYMNASIUM_VECTOR_ENV):  # type: ignore[misc]
    """E swarms of N agents: observations (E, N, F), actions (E, N, A), rewards (E,), the mean over a swarm's agents.

    >>> env = VectorEnv(shoal.load("oceans2020", neighbors=8, steps=1000), 64)
    >>> observations, _ = env.reset(seed=1)
    >>> observations, rewards, terminated, truncated, infos = env.step(env.action_space.sample())

    An episode has as many steps as the scenario and is then truncated; it is terminated if all agents are lost.

    Parameters
    ----------
    scenario : what shoal.load takes; num_envs : E
    observe, act, reward : see Observe, Act and Episodes; default: Observe(), Act() and {"time_on_target": 1.0}
    autoreset : when a swarm whose episode is over begins the next one: at the next step, whose action is ignored; at
        once, with the last observation in infos["final_obs"]; or never, but by reset(options={"reset_mask": ...})
    copy : whether observations and rewards are copies; False: the same arrays at every step, nothing is copied

    Attributes
    ----------
    episodes : the swarms: `episodes.observations`, (E, N, F) numbers of 32 bits that stay where they are, for
        torch.from_dlpack and the like; `episodes.rewards`, (E, N), of each agent; `episodes.names`
    """

    def __init__(
        self,
        scenario: Source,
        num_envs: int = 1,
        *,
        observe: Observe | None = None,
        act: Act | None = None,
        reward: Mapping[str, float] | None = None,
        autoreset: Autoreset = "next-step",
        copy: bool = True,
    ) -> None:
        gymnasium = needed("gymnasium", "an environment")
        act = act or Act()
        modes = gymnasium.vector.AutoresetMode
        known = {"next-step": modes.NEXT_STEP, "same-step": modes.SAME_STEP, "disabled": modes.DISABLED}
        mode = known.get(autoreset)
        if mode is None:
            raise LearnError("autoreset", f"is {autoreset!r}", f"write one of: {', '.join(known)}")
        self.episodes = Episodes(scenario, num_envs, observe or Observe(), act, reward or {"time_on_target": 1.0})
        self.metadata = {"autoreset_mode": mode, "render_modes": []}
        self.num_envs = num_envs
        self.single_observation_space = observation_box(self.episodes)
        self.single_action_space = action_box(self.episodes, act)
        self.observation_space = batched(self.single_observation_space, num_envs)
        self.action_space = batched(self.single_action_space, num_envs)
        self._autoreset, self._copy = autoreset, copy
        self._over, self._any_over = np.zeros(num_envs, np.bool_), False

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin episodes; return what all agents know.

        Parameters
        ----------
        seed : of all swarms, or one each; default: the next episodes of the seed that there is
        options : `reset_mask`, (E,): which swarms begin anew; default: all
        """
        which = None if options is None else options.get("reset_mask")
        if which is not None:
            which = np.asarray(which, np.bool_)
            if which.shape != (self.num_envs,) or not which.any():
                raise LearnError("reset_mask", f"is of shape {which.shape}", f"give {self.num_envs} truths, one true")
        if isinstance(seed, int | np.integer):
            super().reset(seed=int(seed))
        self.episodes.reset(seed, which)
        self._over[slice(None) if which is None else which] = False
        self._any_over = bool(self._over.any())
        return self._given(self.episodes.observations), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:
        """Do a step of every swarm; return observations, rewards, terminated, truncated, infos.

        Parameters
        ----------
        actions : (E, N, A), of any library whose arrays NumPy takes
        """
        episodes, infos = self.episodes, {}
        anew = [int(e) for e in np.flatnonzero(self._over)] if self._any_over else []
        if anew and self._autoreset == "disabled":
            problem = f"of swarm {anew[0]} is over"
            raise LearnError("the episode", problem, 'begin the next one: reset(options={"reset_mask": ...})')
        episodes.step(actions, anew)
        rewards = self._given(episodes.team_rewards)
        terminated = self._all_lost()
        truncated = episodes.over() & ~terminated
        self._over = terminated | truncated
        self._any_over = bool(self._over.any())
        if self._any_over and self._autoreset == "same-step":
            infos, rewards = self._last_words(), rewards.copy()  # what follows writes the first of the next episode
            episodes.reset(None, self._over)
            self._any_over = False
        return self._given(episodes.observations), rewards, terminated, truncated, infos

    def _all_lost(self) -> Any:
        if not self.episodes.swarms.template.world.mortal:
            return np.zeros(self.num_envs, np.bool_)
        return np.array([self.episodes.gone(e).all() for e in range(self.num_envs)])

    def _last_words(self) -> dict[str, Any]:
        """What is said of episodes that are over, as Gymnasium says it."""
        infos: dict[str, Any] = {}
        for e in np.flatnonzero(self._over):
            last = {"final_obs": self.episodes.observations[e].copy(), "final_info": {}}
            infos = self._add_info(infos, last, int(e))
        return infos

    def _given(self, array: Any) -> Any:
        return array.copy() if self._copy else array
