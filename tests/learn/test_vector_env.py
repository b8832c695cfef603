"""Many swarms as Gymnasium has vectors of environments."""

import numpy as np
import pytest

import shoal
from scenarios import scenario
from shoal.core.errors import MissingExtraError
from shoal.learn.env import Act, Observe, VectorEnv
from shoal.learn.errors import LearnError

gymnasium = pytest.importorskip("gymnasium", reason="environments need gymnasium: pip install '.[rl]'")
CHOSEN = scenario("oceans2020", {"steps": 6, "network.neighbors": 8})


def walked(env, steps, seed=1):
    """All that `steps` random actions give, after a reset."""
    env.action_space.seed(3)
    said = [env.reset(seed=seed)]
    return said + [env.step(env.action_space.sample()) for _ in range(steps)]


class TestConformance:
    """What Gymnasium's checker asks of one environment, asked of a vector."""

    def test_is_a_vector_env_with_batched_spaces(self):
        env = VectorEnv(CHOSEN, 3)
        assert isinstance(env, gymnasium.vector.VectorEnv)
        assert env.observation_space == gymnasium.vector.utils.batch_space(env.single_observation_space, 3)
        assert env.action_space == gymnasium.vector.utils.batch_space(env.single_action_space, 3)

    @pytest.mark.parametrize("act", [Act(), Act(kind="repulsion"), Act(scaled=False)], ids=["v", "a_R", "m/s"])
    def test_what_it_gives_is_in_its_spaces_and_of_the_kinds_that_are_asked_for(self, act):
        env = VectorEnv(CHOSEN, 3, act=act)
        (observations, infos), *steps = walked(env, 8)
        assert observations in env.observation_space
        assert infos == {}
        for observations, rewards, terminated, truncated, infos in steps:
            assert observations in env.observation_space
            assert (rewards.shape, terminated.shape, truncated.shape) == ((3,), (3,), (3,))
            assert (rewards.dtype, terminated.dtype, truncated.dtype) == (np.float64, np.bool_, np.bool_)
            assert isinstance(infos, dict)

    def test_the_same_seed_gives_the_same_and_another_another(self):
        one, same, other = (walked(VectorEnv(CHOSEN, 2), 8, seed) for seed in (1, 1, 2))
        for mine, its in zip(one, same, strict=True):
            assert all(np.array_equal(a, b) for a, b in zip(mine[:-1], its[:-1], strict=True))
        assert not np.array_equal(one[0][0], other[0][0])

    def test_what_was_given_does_not_change_later_unless_that_is_asked_for(self):
        for copy in (True, False):
            env = VectorEnv(CHOSEN, 2, copy=copy)
            first, _ = env.reset(seed=1)
            before = first.copy()
            env.step(env.action_space.sample())
            assert np.array_equal(first, before) == copy

    def test_wrappers_of_gymnasium_take_it(self):
        env = gymnasium.wrappers.vector.RecordEpisodeStatistics(VectorEnv(CHOSEN, 2, reward={"engaged": 50.0}))
        *_, last = walked(env, 6)
        assert last[-1]["episode"]["l"].tolist() == [6, 6]


class TestAutoreset:
    """Episodes end with the scenario's steps; the next one is the seed's next run."""

    def test_the_next_step_begins_the_next_episode_and_earns_nothing(self):
        env = VectorEnv(CHOSEN, 2)
        env.reset(seed=1)
        ends = [env.step(env.action_space.sample()) for _ in range(8)]
        assert [each[3].tolist() for each in ends] == [[False] * 2] * 5 + [[True] * 2] + [[False] * 2] * 2
        assert ends[6][1].tolist() == [0.0, 0.0]
        assert env.episodes.runs.tolist() == [2, 3]
        fresh = VectorEnv(CHOSEN, 4)
        first, _ = fresh.reset(seed=1)
        assert np.array_equal(ends[6][0], first[2:])

    def test_at_once_with_the_last_observation_in_the_infos(self):
        later, once = VectorEnv(CHOSEN, 2), VectorEnv(CHOSEN, 2, autoreset="same-step", copy=False)
        said = walked(later, 7)
        (_, rewards, _, truncated, infos) = walked(once, 6)[-1]
        assert truncated.all()
        assert infos["_final_obs"].all()
        assert np.array_equal(np.stack(infos["final_obs"]), said[6][0])
        assert np.array_equal(rewards, said[6][1])
        assert np.array_equal(once.episodes.observations, said[7][0])

    def test_or_never_but_by_a_mask(self):
        env = VectorEnv(CHOSEN, 2, autoreset="disabled")
        walked(env, 6)
        with pytest.raises(LearnError, match="is over"):
            env.step(env.action_space.sample())
        before = env.episodes.observations[1].copy()
        env.reset(options={"reset_mask": np.array([True, False])})
        assert env.episodes.runs.tolist() == [2, 1]
        assert np.array_equal(env.episodes.observations[1], before)

    def test_a_swarm_that_is_lost_is_terminated(self):
        doomed = scenario("oceans2020", {"steps": 9, "losses": [{"step": 4, "count": 50}]})
        said = walked(VectorEnv(doomed, 1), 5)
        assert [each[2].tolist() for each in said[1:]] == [[False]] * 3 + [[True], [False]]
        assert not said[4][0].any()


def test_rewards_are_what_they_are_called():
    env = VectorEnv(
        scenario("oceans2020", {"steps": 400, "network.neighbors": 8}), 1, reward={"time_on_target": 1.0, "energy": 0.5}
    )
    env.reset(seed=1)
    rng = np.random.default_rng(1)
    watched = 0
    for _ in range(60):
        _, rewards, *_ = env.step(rng.uniform(-1, 1, env.action_space.shape))
        swarm, terms = env.episodes.swarms.swarm(0), env.episodes.terms[0]
        engaged = swarm.engaged[:50]
        watched += engaged.any()
        assert (terms[:, 0] == engaged.any()).all()
        assert (terms[:, 1] == engaged.any()).all()
        assert np.array_equal(terms[:, 2], engaged)
        share = np.hypot(swarm.vx, swarm.vy)[:50] / swarm.max_speed[:50]
        assert terms[:, 3] == pytest.approx(-(share**3))
        assert rewards == pytest.approx((terms[:, 0] + 0.5 * terms[:, 3]).mean())
    assert 0 < watched < 60


def test_an_action_on_the_memory_is_there_when_the_strategy_decides():
    bounds = {"repulsion": (0.5, 1.0)}
    env = VectorEnv(CHOSEN, 1, observe=Observe(memory=("repulsion",)), act=Act(kind="repulsion", bounds=bounds))
    env.reset(seed=1)
    observations, *_ = env.step(np.full(env.action_space.shape, 0.5))
    assert observations[0, :, -1] == pytest.approx(0.875)


@pytest.mark.parametrize(
    ("wrong", "what"),
    [
        ({"observe": Observe(own=("z",))}, "there is no 'z'"),
        ({"observe": Observe(reports=50)}, "49 others at most"),
        ({"observe": Observe((), (), 0)}, "is of nothing"),
        ({"reward": {"fun": 1.0}}, "there is no 'fun'"),
        ({"act": Act(kind="fly")}, "write velocity"),
        ({"act": Act(kind="memory")}, "name no field"),
        ({"act": Act(kind="repulsion", bounds={"repulsion": (2.0, 1.0)})}, "the lower first"),
        ({"autoreset": "now"}, "write one of"),
        ({"num_envs": 0}, "ask for 1 or more"),
    ],
)
def test_what_there_is_not_is_refused(wrong, what):
    with pytest.raises(LearnError, match=what):
        VectorEnv(CHOSEN, **wrong)


@pytest.mark.parametrize(
    ("actions", "what"), [(np.zeros((2, 50)), "are of shape"), (np.full((2, 50, 2), np.nan), "are not finite")]
)
def test_actions_that_cannot_be_taken_change_nothing(actions, what):
    env = VectorEnv(CHOSEN, 2)
    before, _ = env.reset(seed=1)
    with pytest.raises(LearnError, match=what):
        env.step(actions)
    assert np.array_equal(env.episodes.observations, before)
    assert env.episodes.swarms.number.tolist() == [0, 0]


def test_without_the_library_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "gymnasium", None)
    with pytest.raises(MissingExtraError, match=r"pip install '\.\[rl\]'"):
        VectorEnv(CHOSEN)


def test_arrays_go_to_other_libraries_without_a_copy():
    env = VectorEnv(shoal.load("oceans2020", steps=6), 2)
    seen = np.from_dlpack(env.episodes.observations)
    env.reset(seed=1)
    assert np.array_equal(seen, env.episodes.observations)
    assert seen.any()
