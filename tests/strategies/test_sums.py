"""Named sums and ranks: what the engine adds up is what a slow loop over the neighbors adds up."""

from types import SimpleNamespace

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.draws import uniform
from shoal.core.errors import StrategyError
from shoal.run.simulation import Simulation
from shoal.strategies import CATALOGUE, strategy
from shoal.strategies.plugins import find_strategy, load_strategies
from shoal.strategies.rank import asks_for_rank

WITNESS = '''"""Remembers what it hears."""

from typing import NamedTuple

import shoal


class Witness(NamedTuple):
    few: int = 6


def influence(me, other, params):
    near = 1.0 if other.rank < params.few else 0.0
    return other.rank, near, near * other.x, me.time - other.time


def priority(me, other, params):
    return -float(other.rank)  # the farthest


@shoal.strategy(
    "witness",
    params=Witness,
    memory={"ranks": "1", "near": "1", "near_x": "m", "age": "s", "leader_x": "m", "first": "1", "second": "1"},
    influence=influence,
    leads=lambda other, params: True,
    priority=priority,
    sums=("ranks", "near", "near_x", "age"),
)
def witness(me, heard, memory, params, draw):
    """Walk in circles."""
    memory.ranks, memory.near, memory.near_x = heard.sums.ranks, heard.sums.near, heard.sums.near_x
    memory.age, memory.leader_x = heard.sums.age, heard.x
    memory.first, memory.second = heard.sum_x, heard.sum_y
    turn = shoal.uniform(draw, 0)
    return me.max_speed * (turn - 0.3), me.max_speed * 0.2
'''
K, FEW = 20, 6


@pytest.fixture(autouse=True)
def own_catalogue():
    before = dict(CATALOGUE)
    yield
    CATALOGUE.clear()
    CATALOGUE.update(before)


@pytest.fixture(scope="module")
def witness(tmp_path_factory):
    file = tmp_path_factory.mktemp("sums") / "witness.py"
    file.write_text(WITNESS, encoding="utf-8")
    return load_strategies({"file": str(file)})


def frames_of(chosen, steps=12):
    simulation = Simulation(chosen)
    return simulation, simulation.advance(steps, every=1)


def heard_by(frames, at, i, k=K):
    """Indices of the k nearest, nearest first, ties to the lower index."""
    square = (frames.x[at] - frames.x[at, i]) ** 2 + (frames.y[at] - frames.y[at, i]) ** 2
    square[i] = np.inf
    return np.argsort(square, kind="stable")[:k]


class TestSums:
    """As many as are named."""

    def test_are_those_of_a_slow_loop_and_so_is_the_leader(self, witness):
        _, frames = frames_of(scenario("oceans2020", {"strategy": witness}))
        for at in (0, 5, 10):
            for i in range(50):
                near = heard_by(frames, at, i)
                memory = {name: values[at + 1, i] for name, values in frames.memory.items()}
                assert memory["ranks"] == memory["first"] == sum(range(K))
                assert memory["near"] == memory["second"] == FEW
                assert memory["near_x"] == pytest.approx(frames.x[at][near[:FEW]].sum(), abs=1e-12)
                assert memory["leader_x"] == frames.x[at, near[-1]]
                assert memory["age"] == 0.0

    def test_of_agents_that_all_lie_in_one_place_rank_by_index(self, witness):
        fleets = [{"name": "all", "count": 50, "max_speed": 1.0, "start": "center"}]
        chosen = scenario("oceans2020", {"strategy": witness, "fleets": fleets})
        simulation = Simulation(chosen)
        with simulation.edit() as now:
            now.swarm.x[:50] = np.arange(50) // 25
        with simulation.edit() as now:
            now.swarm.y[:50] = 0.0
        frames = simulation.advance(2, every=1)
        assert frames.memory["near_x"][1].tolist() == [0.0] * 25 + [6.0] * 25
        assert (frames.memory["ranks"][1] == sum(range(K))).all()

    def test_count_what_is_left_under_range_loss_and_delay(self, witness):
        network = {"neighbors": K, "range": 6.0, "loss": 0.3, "delay": 2}
        _, frames = frames_of(scenario("oceans2020", {"strategy": witness, "network": network}))
        ranks, age = frames.memory["ranks"][4:], frames.memory["age"][4:]
        heard = (1 + np.sqrt(1 + 8 * ranks)) / 2  # 0 + 1 + ... + (n - 1) = n (n - 1) / 2
        np.testing.assert_array_equal(heard, heard.round())
        assert heard.min() < heard.max() <= K
        several = heard > 1  # of one heard, its rank does not tell
        np.testing.assert_allclose(age[several], 0.2 * heard[several])

    def test_of_two_strategies_in_one_swarm_keep_to_themselves(self, witness):
        """The paper's fleet, with two sums, swims as it does beside others that it cannot tell apart."""
        charged = {"name": "charged-pso", "charge": 0.63, "core": 0.3, "perception": 4.0}
        fleets = [
            {"name": "one", "count": 20, "max_speed": 1.0, "strategy": witness},
            {"name": "other", "count": 30, "max_speed": 1.0, "strategy": charged},
        ]
        simulation, frames = frames_of(scenario("oceans2020", {"fleets": fleets}))
        assert simulation.crew.sums == 4
        for i in (0, 7, 19):
            near = heard_by(frames, 5, i)
            assert frames.memory["near_x"][6, i] == pytest.approx(frames.x[5][near[:FEW]].sum(), abs=1e-12)
        for i in (20, 49):
            near = heard_by(frames, 5, i)
            dx, dy = frames.x[5, i] - frames.x[5][near], frames.y[5, i] - frames.y[5][near]
            distance = np.hypot(dx, dy)
            push = 0.63**3 / (np.maximum(distance, 0.3) ** 2 * distance) * (distance <= 4.0)
            if not frames.on_target[5][near].any():
                wanted = np.array(
                    [0.7 * frames.vx[5, i] + 10 * (push * dx).sum(), 0.7 * frames.vy[5, i] + 10 * (push * dy).sum()]
                )
                wanted *= min(1.0, 1.0 / np.hypot(*wanted))
                assert [frames.vx[6, i], frames.vy[6, i]] == pytest.approx(list(wanted), abs=1e-9)


def refused(**given):
    from collections import namedtuple

    with pytest.raises(StrategyError) as caught:
        strategy("mine", params=namedtuple("Mine", []), **given)(lambda me, heard, memory, params, draw: (0.0, 0.0))
    return str(caught.value)


class TestErrors:
    """One sentence each, when the strategy is written."""

    def test_sums_that_are_no_names(self):
        push = {"influence": lambda me, other, params: (0.0, 0.0)}
        assert "is one word" in refused(sums="push", **push)
        assert "duplicate" in refused(sums=("push", "push"), **push)
        assert "valid identifiers" in refused(sums=("push x", "y"), **push)

    def test_sums_that_nothing_adds_to(self):
        assert "nothing adds to them" in refused(sums=("a", "b", "c"))

    def test_a_rank_where_there_is_none(self):
        assert "asked once for all listeners" in refused(leads=lambda other, params: other.rank < 3)

    @pytest.mark.slow
    def test_another_number_of_numbers(self, tmp_path):
        file = tmp_path / "witness.py"
        file.write_text(WITNESS.replace("return other.rank, near,", "return near,"), encoding="utf-8")
        chosen = scenario("oceans2020", {"strategy": {"file": str(file)}})
        with pytest.raises(
            StrategyError, match="influence returns 3 numbers, but the sums are ranks, near, near_x, age"
        ):
            Simulation(chosen).advance(1)


def helper(other):
    return other.rank


class TestCalledFromPython:
    """With whatever has the fields: nobody needs the engine to test a strategy."""

    def test_with_made_up_objects(self, witness):
        known = find_strategy(witness["name"], witness["source"])
        me = SimpleNamespace(time=1.0, max_speed=2.0)
        assert known.influence(me, SimpleNamespace(rank=5, x=3.0, time=0.5), known.params()) == (5, 1.0, 3.0, 0.5)
        sums = known.sums(1.0, 2.0, 3.0, 4.0)
        heard = SimpleNamespace(sums=sums, x=7.0, sum_x=1.0, sum_y=2.0)
        memory = SimpleNamespace()
        vx, vy = known.decide(me, heard, memory, known.params(), 1)
        assert vx == 2.0 * (uniform(1, 0) - 0.3)
        assert vy == 0.4
        assert (memory.ranks, memory.age, memory.leader_x) == (1.0, 4.0, 7.0)


class TestAskingForRank:
    """Ranks are worked out for those that ask, and for nobody else."""

    def test_directly_or_through_a_function(self):
        assert asks_for_rank(lambda me, other, params: other.rank)
        assert asks_for_rank(lambda me, other, params: helper(other))
        assert asks_for_rank(lambda me, other, params: [each.rank for each in other])

    def test_no_built_in_does(self):
        assert not any(known.ranked for known in CATALOGUE.values() if known.builtin)
        assert Simulation(scenario())._scratch.links.rank.size == 0
