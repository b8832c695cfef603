"""Episodes: swarms that begin runs anew, what their agents know and earn; what both environments are made of."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.learn.errors import LearnError
from shoal.learn.spec import Act, Observe, acting, earned_by, names_of, seen_by
from shoal.run.swarms import Swarms
from shoal.scenario.load import Source, load


class Episodes:
    """E swarms, each in a run of its own, which is an episode of `scenario.steps` steps.

    Chance is that of Shoal's runs: with a seed, episode n of swarm e is run n E + e of that seed, with a seed for each
    swarm it is run n of its own; so every episode is one that `shoal.simulate` can have.

    Parameters
    ----------
    scenario : what shoal.load takes; `count` : E
    observe, act : what agents know and do
    reward : weights of time_on_target (1 at a step with an agent on a target), targets_observed (share of the targets
        present that somebody is on), engaged (1 for an agent that is on a target itself) and energy (minus the cube of
        its speed as a share of its top speed)

    Attributes
    ----------
    observations : (E, N, F), of what is known now; names : of what each of the F numbers is
    rewards, terms, there : (E, N), (E, N, R), (E, N) each agent's, what they are the weighted sum of, who is there
    team_rewards : (E,) the mean reward of the agents that are there
    seeds, runs : (E,) of the episodes
    swarms : what runs

    Raises
    ------
    ScenarioError, StrategyError : it cannot run, or not for all at once
    LearnError : a spec is of what there is not
    """

    def __init__(self, scenario: Source, count: int, observe: Observe, act: Act, reward: Mapping[str, float]) -> None:
        if count < 1:
            raise LearnError("num_envs", f"is {count}", "ask for 1 or more")
        self.scenario = scenario = load(scenario)
        crew, actions = acting(act, scenario)
        seen, earned = seen_by(observe, scenario, crew, count), earned_by(reward, scenario.agents, count)
        self.count, self.observed = count, seen
        self.names = names_of(observe, seen)
        self.observations, self.there = seen.observations, seen.there
        self.rewards, self.terms, self.team_rewards = earned.rewards, earned.terms, earned.team
        self.swarms = Swarms(scenario, count, crew, actions, seen, earned)
        self.actions = self.swarms.actions
        self.seeds = [int(scenario.seed)] * count
        self.runs = np.arange(count)
        self._stride = count
        self._begun = np.zeros(count, np.bool_)

    def reset(self, seed: int | Sequence[int | None] | None = None, which: npt.NDArray[np.bool_] | None = None) -> None:
        """Let swarms begin an episode, and say what their agents know.

        Parameters
        ----------
        seed : of all, or one each (None: go on); default: the next episodes of the seed that there is
        which : (E,) of which swarms; default: all

        Raises
        ------
        LearnError : a seed is no whole number from 0 to 2^64 - 1, or there are not E of them
        """
        chosen = range(self.count) if which is None else np.flatnonzero(which)
        seeds = self._checked(seed)
        for e in chosen:
            if (own := seeds[e]) is not None:
                self.seeds[e], self._begun[e] = own, False
                self._stride = self.count if isinstance(seed, int | np.integer) else 1
                self.runs[e] = e if self._stride > 1 else 0
            self._begin(int(e))
        self.swarms.step(None)

    def step(self, actions: Any, anew: Sequence[int] = ()) -> None:
        """Do a step of all swarms; those that are to begin `anew` begin their next episode instead, and earn nothing.

        Raises
        ------
        LearnError : actions are of another shape, or not finite; nothing was done then
        StrategyError : a position or a velocity is not finite
        """
        wanted = np.asarray(actions)
        if wanted.shape != self.actions.shape:
            problem = f"are of shape {wanted.shape}, where {self.actions.shape} are asked for"
            raise LearnError("actions", problem, "give each agent of each swarm its numbers")
        if anew and not np.isfinite(wanted).all():  # before anything begins anew
            raise _not_finite()
        for e in anew:
            self._begin(e)
        if not self.swarms.step(wanted):
            raise _not_finite()
        for e in anew:
            self.rewards[e], self.terms[e], self.team_rewards[e] = 0.0, 0.0, 0.0

    def over(self) -> npt.NDArray[np.bool_]:
        """Which episodes have done all their steps, (E,)."""
        return np.asarray(self.swarms.number >= self.scenario.steps)

    def gone(self, e: int) -> npt.NDArray[np.bool_]:
        """Which agents of a swarm are lost for good, (N,)."""
        return np.asarray(self.swarms.swarm(e).leaves[: self.scenario.agents] <= self.swarms.number[e])

    def state(self, e: int = 0) -> npt.NDArray[np.float32]:
        """What is true of swarm e, which no buoy knows: for a critic that sees all, not for policies; (5 N + 3 T,).

        Of each agent x, y, vx, vy and whether it is there, then of each target x, y and whether it is present. Places
        are shares of half the area's longer side, velocities of the fastest fleet's top speed, as in observations, but
        not cut; of who is not there all is 0. How a target moves is the difference between two states.
        """
        swarm, targets, agents = self.swarms.swarm(e), self.swarms.targets(e), self.scenario.agents
        length, speed = self.observed.per_length, self.observed.per_speed
        there, present = swarm.alive[:agents] > 0.0, targets["present"] > 0
        own = [swarm.x * length, swarm.y * length, swarm.vx * speed, swarm.vy * speed]
        about = np.array([*(each[:agents] for each in own), np.ones(agents)]) * there
        aims = np.array([targets["x"] * length, targets["y"] * length, np.ones(len(targets))]) * present
        return np.concatenate([about.T.ravel(), aims.T.ravel()]).astype(np.float32)

    def _begin(self, e: int) -> None:
        if self._begun[e]:
            self.runs[e] += self._stride
        self._begun[e] = True
        self.swarms.reset(e, self.seeds[e], int(self.runs[e]))

    def _checked(self, seed: Any) -> list[int | None]:
        seeds: list[Any] = [seed] * self.count if seed is None or isinstance(seed, int | np.integer) else list(seed)
        if len(seeds) != self.count:
            raise LearnError("seed", f"has {len(seeds)} numbers for {self.count} swarms", "give one, or one for each")
        for each in seeds:
            whole = isinstance(each, int | np.integer) and not isinstance(each, bool) and 0 <= each < 2**64
            if each is not None and not whole:
                raise LearnError("seed", f"is {each!r}", "give a whole number from 0")
        return [None if each is None else int(each) for each in seeds]


def _not_finite() -> LearnError:
    return LearnError("actions", "are not finite", "look for a division by zero in the policy")
