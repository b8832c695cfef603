"""A swarm as PettingZoo has environments of several agents."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import MissingExtraError
from shoal.learn.env import ParallelEnv, VectorEnv
from shoal.learn.errors import LearnError

pytest.importorskip("pettingzoo", reason="environments need pettingzoo: pip install '.[rl]'")
CHOSEN = scenario("oceans2020", {"steps": 20, "network.neighbors": 8})
LOSING = scenario("oceans2020", {"steps": 20, "losses": [{"step": 5, "count": 30}, {"step": 9, "count": 20}]})


@pytest.mark.parametrize("chosen", [CHOSEN, LOSING], ids=["as-it-is", "losing"])
def test_it_passes_the_conformance_test(chosen):
    from pettingzoo.test import parallel_api_test

    parallel_api_test(ParallelEnv(chosen), num_cycles=50)


def test_it_passes_the_test_of_seeds():
    from pettingzoo.test import parallel_seed_test

    parallel_seed_test(lambda: ParallelEnv(CHOSEN), num_cycles=10)


def test_it_is_the_first_swarm_of_a_vector():
    pytest.importorskip("gymnasium")
    one, many = ParallelEnv(CHOSEN, reward={"engaged": 1.0}), VectorEnv(CHOSEN, 1, reward={"engaged": 1.0})
    one.reset(seed=5)
    many.reset(seed=5)
    actions = many.action_space.sample()
    for _ in range(10):
        observations, rewards, *_ = one.step(dict(zip(one.agents, actions[0], strict=True)))
        together, mean, *_ = many.step(actions)
        assert np.array_equal(np.stack(list(observations.values())), together[0])
        assert np.mean(list(rewards.values())) == pytest.approx(mean[0])


def test_agents_that_are_lost_are_terminated_and_the_last_ends_the_episode():
    env = ParallelEnv(LOSING)
    env.reset(seed=1)
    left = []
    while env.agents:
        env.step({agent: np.zeros(2) for agent in env.agents})
        left.append(len(env.agents))
    assert left == [50] * 4 + [20] * 4 + [0]


@pytest.mark.parametrize("chosen", [CHOSEN, LOSING], ids=["as-it-is", "losing"])
def test_the_state_is_what_is_true_of_all_agents_and_targets(chosen):
    env = ParallelEnv(chosen)
    env.reset(seed=1)
    places = []
    for _ in range(6):
        env.step({agent: np.array([0.6, -0.2]) for agent in env.agents})
        state, swarm = env.state(), env.episodes.swarms.swarm(0)
        assert state in env.state_space
        assert (state.shape, state.dtype) == ((5 * 50 + 3,), np.float32)
        x, y, vx, vy, there = state[:250].reshape(50, 5).T
        alive = swarm.alive[:50] > 0
        assert there.tolist() == alive.tolist()
        for each, true, unit in ((x, swarm.x, 10.0), (y, swarm.y, 10.0), (vx, swarm.vx, 2.6), (vy, swarm.vy, 2.6)):
            assert each * unit == pytest.approx(true[:50] * alive, abs=1e-5)
        places.append(state[250:252] * 10.0)
        assert state[252] == 1.0
    assert np.hypot(*np.diff(places, axis=0).T) == pytest.approx(0.3, abs=1e-5)  # 3 m/s
    assert (there.sum() == 20) == (chosen is LOSING)


def test_the_state_of_a_target_that_nobody_can_see_is_zeros():
    diving = {"targets.0.surface_time": 0.1, "targets.0.dive_time": 100.0, "steps": 20}
    env = ParallelEnv(scenario("oceans2020", diving))
    env.reset(seed=1)
    for _ in range(10):
        env.step({agent: np.zeros(2) for agent in env.agents})
    assert env.state()[250:].tolist() == [0.0, 0.0, 0.0]


def test_actions_of_others_and_a_step_too_many_are_refused():
    env = ParallelEnv(CHOSEN)
    with pytest.raises(LearnError, match="begin another one"):
        env.step({})
    env.reset(seed=1)
    with pytest.raises(LearnError, match="of buoy_3 are too many or missing"):
        env.step({agent: np.zeros(2) for agent in env.agents if agent != "buoy_3"})


def test_without_the_library_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pettingzoo", None)
    with pytest.raises(MissingExtraError, match=r"pip install '\.\[rl\]'"):
        ParallelEnv(CHOSEN)
