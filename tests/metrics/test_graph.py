"""Components, clustering and messages of the network."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from coasting import coasting
from scenarios import fleets, scenario
from shoal.core.agents import new_swarm
from shoal.engine.stage import model_stage
from shoal.metrics.contract import Step
from shoal.metrics.graph import tally_graph
from shoal.metrics.summary import evaluate
from shoal.metrics.tally import new_tally
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.world.neighbors import new_links


def measured(linked, alive=None):
    """Components and mean clustering of a graph: linked[j, i] if i hears j."""
    n = len(linked)
    links = new_links(n, n)
    links.square[:n] = np.where(linked, 1.0, np.inf)
    links.reach[:] = 1.0
    world = model_stage().world._replace(agents=n, fleets=1, time_step=0.1)
    tally = new_tally(steps=1, batches=1, fleets=1, agents=n, targets=1)
    there = np.ones(n) if alive is None else np.asarray(alive, float)
    scratch = model_stage().scratch._replace(links=links, leader=np.zeros(n, np.int64), a=np.zeros(n))
    swarm = new_swarm([n], ())
    swarm.alive[:n] = there
    tally_graph(tally, Step(0, 0, 0), world, swarm, None, scratch)
    return tally.components[0], tally.clustering[0]


def brute(linked):
    """The same, the plain way: by flooding, and pair by pair."""
    n = len(linked)
    either = linked | linked.T
    left, parts = set(range(n)), 0
    while left:
        reached, grown = set(), {min(left)}
        while grown != reached:
            reached, grown = grown, grown | {int(j) for i in grown for j in np.flatnonzero(either[i])}
        left -= reached
        parts += 1
    total = 0.0
    for i in range(n):
        pairs = list(itertools.combinations(np.flatnonzero(linked[:, i]), 2))
        total += sum(either[a, b] for a, b in pairs) / len(pairs) if pairs else 0.0
    return parts, total / n


def both_ways(n, edges):
    linked = np.zeros((n, n), bool)
    for a, b in edges:
        linked[a, b] = linked[b, a] = True
    return linked


class TestKnownGraphs:
    """Closed forms."""

    @pytest.mark.parametrize("n", [2, 3, 7])
    def test_a_complete_graph(self, n):
        assert measured(~np.eye(n, dtype=bool)) == (1, 1.0 if n > 2 else 0.0)

    def test_nobody_linked(self):
        assert measured(np.zeros((5, 5), bool)) == (5, 0.0)

    @pytest.mark.parametrize("n", [4, 9])
    def test_a_ring_and_a_star_have_no_triangles(self, n):
        assert measured(both_ways(n, [(i, (i + 1) % n) for i in range(n)])) == (1, 0.0)
        assert measured(both_ways(n, [(0, i) for i in range(1, n)])) == (1, 0.0)

    @pytest.mark.parametrize("half", [2, 3, 5])
    def test_the_ring_lattice_of_watts_and_strogatz(self, half):
        """Each linked to `half` on either side: C = 3 (K - 2) / (4 (K - 1)) with K = 2 half."""
        n, degree = 40, 2 * half
        edges = [(i, (i + step) % n) for i in range(n) for step in range(1, half + 1)]
        parts, clustering = measured(both_ways(n, edges))
        assert parts == 1
        assert clustering == pytest.approx(3 * (degree - 2) / (4 * (degree - 1)))

    def test_two_cliques(self):
        edges = [*itertools.combinations(range(4), 2), *itertools.combinations(range(4, 9), 2)]
        assert measured(both_ways(9, edges)) == (2, 1.0)

    def test_one_direction_joins_parts_too(self):
        """0 -> 1 -> 2: weakly connected."""
        linked = np.zeros((3, 3), bool)
        linked[0, 1] = linked[1, 2] = True
        assert measured(linked)[0] == 1


class TestAnyGraph:
    """Against the plain way."""

    @given(n=st.integers(2, 25), density=st.floats(0.0, 0.5), seed=st.integers(0, 2**32))
    @settings(max_examples=100)
    def test_is_what_flooding_and_counting_pairs_say(self, n, density, seed):
        linked = np.random.default_rng(seed).random((n, n)) < density
        np.fill_diagonal(linked, False)
        parts, clustering = measured(linked)
        assert (parts, clustering) == (brute(linked)[0], pytest.approx(brute(linked)[1]))

    @given(n=st.integers(3, 20), seed=st.integers(0, 2**32))
    @settings(max_examples=50)
    def test_who_is_not_there_is_no_part_of_it(self, n, seed):
        rng = np.random.default_rng(seed)
        linked, alive = rng.random((n, n)) < 0.3, rng.random(n) < 0.6
        np.fill_diagonal(linked, False)
        linked[:, ~alive] = False  # who is not there hears nobody, but its last words may be on their way
        rest = linked[np.ix_(alive, alive)]
        expected = brute(rest) if alive.any() else (0, 0.0)
        assert measured(linked, alive) == (expected[0], pytest.approx(expected[1]))


class TestInARun:
    """Looked at in steps 0, 500, ..."""

    def metric(self, simulation, name):
        return evaluate(name, simulation.tally, facts_of(simulation.scenario))[0]

    def test_of_pairs_far_apart(self):
        places = [(-9, -9), (-9, -8), (9, 9), (9, 8), (-9, 9), (-8, 9)]
        simulation = coasting(places, np.zeros((6, 2)))
        simulation.advance(20)
        assert self.metric(simulation, "components") == 3
        assert self.metric(simulation, "clustering") == 0.0

    def test_all_to_all_is_one_clique(self):
        simulation = Simulation(scenario("oceans2020", {"network.neighbors": "all"}))
        simulation.advance(501)
        assert (self.metric(simulation, "components"), self.metric(simulation, "clustering")) == (1.0, 1.0)
        assert simulation.tally.graphs.sum() == 2

    def test_the_sequential_order_has_no_graph(self):
        simulation = Simulation(scenario("oceans2020", {"motion.update_order": "sequential"}))
        simulation.advance(10)
        assert np.isnan(self.metric(simulation, "components"))

    def test_messages_and_bytes(self):
        """Each of 50 hears 20 reports a step of 0.1 s: 200 a second; an id of 4 bytes, 4 doubles, a bit."""
        simulation = Simulation(scenario())
        simulation.advance(30)
        assert self.metric(simulation, "messages") == pytest.approx(200.0)
        assert self.metric(simulation, "bandwidth") == pytest.approx(200.0 * 37)

    def test_what_is_told_makes_reports_longer(self):
        simulation = Simulation(scenario("oceans2020", {"strategy": "shared-sighting"}))
        assert facts_of(simulation.scenario).report_bytes == 37 + 3 * 8

    def test_messages_are_of_those_who_are_there(self):
        changes = {"fleets": fleets((30, 1.0), (20, 1.0)), "network.neighbors": 5}
        simulation = Simulation(scenario("oceans2020", {**changes, "losses": [{"step": 10, "count": 20}]}))
        simulation.advance(40)
        assert self.metric(simulation, "messages") == pytest.approx(50.0)
