"""Relayed and kept reports: who has whose, beside a search and a list that know nothing of the engine."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hearsay import Hearsay, searched
from scenarios import scenario, small
from shoal.core.agents import new_swarm
from shoal.core.errors import ScenarioError
from shoal.core.links import unpacked
from shoal.run.simulation import Simulation
from shoal.world.neighbors import new_links
from shoal.world.radio import new_radio
from shoal.world.reception import collecting, new_words, recall, relay


@given(
    agents=st.integers(2, 70),
    most=st.integers(1, 6),
    share=st.sampled_from([0.01, 0.03, 0.1]),
    seed=st.integers(0, 2**32),
)
@settings(max_examples=150, deadline=None)
def test_relays_are_a_search_from_every_speaker(agents, most, share, seed):
    direct = np.random.default_rng(seed).random((agents, agents)) < share  # one way now and then: links may be
    np.fill_diagonal(direct, False)
    links, hops = new_links(agents, 72), np.full((agents, 72), 7, np.int8)
    links.square[:agents, :agents] = np.where(direct, 1.0, np.inf)
    relay(links, hops, new_words(agents), most, agents)
    assert hops[:, :agents].tolist() == searched(direct.tolist(), most)
    assert not hops[:, agents:].any()


@given(max_age=st.integers(1, 9), interval=st.integers(1, 4), delay=st.integers(0, 5), seed=st.integers(0, 2**32))
@settings(max_examples=25, deadline=None)
def test_the_newest_that_was_heard_is_gone_by_until_it_is_too_old(max_age, interval, delay, seed):
    chance, agents = np.random.default_rng(seed), 3
    swarm, links = new_swarm([agents], ()), new_links(agents, 8)
    plain = new_radio(8, (), limited=True, reach=np.inf, delay=delay, loss=0.0, degree=None, interval=interval)
    radio, rows = collecting(plain, agents, max_age, 1), {}
    heard = {(j, i): [] for j in range(agents) for i in range(agents)}
    for number in range(30):
        if number % interval == 0:
            rows[number] = chance.random(agents)
            radio.x[(number // interval) % len(radio.x), :agents] = rows[number]
        then = (number - delay) - (number - delay) % interval
        arrives = (chance.random((agents, agents)) < 0.3) & (then >= 0) & ~np.eye(agents, dtype=bool)
        links.square[:agents, :agents] = np.where(arrives, 0.5, np.inf)
        recall(links, radio, swarm, then, True, agents)
        for (j, i), steps in heard.items():
            steps += [then] if arrives[j, i] else []
            fresh = [step for step in steps if step >= then - max_age]
            wanted = np.inf if not fresh else 0.5 if max(fresh) == then and arrives[j, i] else None
            if wanted is None:
                apart = swarm.x[i] - rows[max(fresh)][j]
                wanted = apart * apart
            assert links.square[j, i] == wanted


def test_a_look_remembers_nothing():
    swarm, links = new_swarm([2], ()), new_links(2, 8)
    radio = collecting(new_radio(8, (), limited=True, reach=9.0, delay=0, loss=0.0, degree=None), 2, 3, 1)
    links.square[0, 1] = 1.0
    recall(links, radio, swarm, 4, False, 2)
    assert radio.heard.max() == -1
    recall(links, radio, swarm, 4, True, 2)
    assert radio.heard[0, 1] == 4


POOR = {"range": 5.0, "loss": 0.4, "delay": 2, "interval": 0.3}
RULES = {
    "kept": {"max_age": 1, "loss": 0.5},
    "kept for long, late": {**POOR, "max_age": 5},
    "relayed": {"range": 4.0, "hops": 3},
    "relayed once, lost": {"range": 4.0, "loss": 0.3, "hops": 2},
    "both": {**POOR, "max_age": 7, "hops": 4},
}


@pytest.mark.parametrize("network", RULES.values(), ids=list(RULES))
def test_whom_agents_hear_is_what_a_list_of_all_reports_says(network):
    changes = {
        "losses": [{"step": 12, "count": 3}, {"step": 25, "agents": [0, 7]}],
        "joins": [{"step": 15, "count": 3, "fleet": "make 0"}],
        **{f"network.{name}": value for name, value in network.items()},
    }
    chosen = small(17, 4, changes)
    frames = Simulation(chosen).advance(40, every=1)
    links, list_of_all = np.array([unpacked(each) for each in frames.links]), Hearsay(chosen, frames)
    for step in range(40):
        assert (links[step] == list_of_all.step(step)).all(), step
    assert links.any(axis=(1, 2)).sum() > 30


def test_the_state_goes_on_where_it_was(tmp_path):
    chosen = small(17, 4, {"network.loss": 0.5, "network.max_age": 6})
    whole, first, second = (Simulation(chosen) for _ in range(3))
    whole.advance(60)
    first.advance(30)
    first.look()
    first.save(tmp_path / "state.npz")
    second.restore(tmp_path / "state.npz")
    second.advance(30)
    assert whole.swarm.x.tobytes() == second.swarm.x.tobytes()
    assert whole.tally.heard.tobytes() == second.tally.heard.tobytes()


def test_what_is_kept_is_not_received_again():
    """Of 16 others, 4 are gone by; of what is lost nothing is received, however long the rest is kept."""
    silent = Simulation(small(17, 4, {"network.loss": 1.0, "network.max_age": 9}))
    silent.advance(20)
    half = Simulation(small(17, "all", {"network.loss": 0.5, "network.max_age": 50}))
    frames = half.advance(200, every=1)
    assert silent.tally.heard.sum() == 0
    assert abs(half.tally.heard.sum() - 0.5 * 200 * 17 * 16) < 5 * np.sqrt(200 * 17 * 16 * 0.25)
    assert sum(unpacked(each).sum() for each in frames.links[20:]) == 180 * 17 * 16


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"network.max_age": -1}, "max_age"),
        ({"network.max_age": 1001}, "max_age"),
        ({"network.max_age": 1.5}, "max_age"),
        ({"network.hops": 0}, "hops"),
        ({"network.hops": 101}, "hops"),
        ({"network.hops": "many"}, "hops"),
        ({"network.max_age": 2, "motion.update_order": "sequential"}, "write synchronous"),
        ({"network.hops": 2, "motion.update_order": "sequential"}, "network.hops is 2"),
    ],
)
def test_what_cannot_be_is_refused(changes, words):
    with pytest.raises(ScenarioError, match=words):
        scenario("oceans2020", changes)


def test_left_out_or_said_as_it_is_they_are_no_choice():
    assert scenario("oceans2020", {"network.max_age": 0, "network.hops": 1}).hash == scenario().hash
    assert scenario("oceans2020", {"network.hops": 2}).hash != scenario().hash
