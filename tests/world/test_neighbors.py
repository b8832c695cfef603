"""The k nearest others, ties to the lower index, whatever the guess of the step before."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shoal.world.neighbors import link_nearest, measure_distances, new_links, rank_heard, settle_ties

PADDING = 8


def links_of(x, y, neighbors, reach, first=0, lanes=None):
    """Who is linked after the engine's three calls: (speaker, listener)."""
    agents = len(x)
    lanes = agents if lanes is None else lanes
    links = new_links(agents, lanes)
    links.reach[:] = reach
    k = np.full(lanes, agents)  # a padding lane hears everybody
    k[: agents - first] = neighbors[first : first + lanes]
    listener_x, listener_y = np.full(lanes, 8.5), np.full(lanes, 8.5)
    listener_x[: agents - first], listener_y[: agents - first] = x[first : first + lanes], y[first : first + lanes]
    measure_distances(links, x, y, listener_x, listener_y, first, agents)
    links.wanted[:] = k
    link_nearest(links, agents)
    links.heard[:] = (links.square <= links.reach).sum(axis=0)
    settle_ties(links, agents)
    return (links.square <= links.reach)[:agents]


def nearest_by_sorting(x, y, neighbors):
    """The same, the plain way."""
    agents = len(x)
    linked = np.zeros((agents, agents), bool)
    for i in range(agents):
        square = (x[i] - x) ** 2 + (y[i] - y) ** 2
        square[i] = np.inf
        linked[np.lexsort((np.arange(agents), square))[: neighbors[i]], i] = True
    return linked


def swarms(most=70):
    """x, y, k of each agent: scattered, on a grid, in heaps, or with one far outside."""

    @st.composite
    def build(draw):
        agents, kind = (
            draw(st.integers(2, most)),
            draw(st.sampled_from(["scattered", "grid", "heaps", "one far", "many scales"])),
        )
        rng = np.random.default_rng(draw(st.integers(0, 2**32)))
        xy = {
            "scattered": lambda: rng.uniform(-10, 10, (2, agents)),
            "grid": lambda: rng.integers(-3, 4, (2, agents)).astype(float),
            "heaps": lambda: rng.uniform(-8, 8, (2, 3))[:, rng.integers(0, 3, agents)],
            "one far": lambda: np.where(np.arange(agents) == 0, 1e9, rng.uniform(-1, 1, (2, agents))),
            "many scales": lambda: rng.choice([-1, 1], (2, agents)) * 10.0 ** rng.uniform(-12, 6, (2, agents)),
        }[kind]()
        same = draw(st.booleans())
        k = np.full(agents, draw(st.integers(1, agents - 1))) if same else rng.integers(1, agents, agents)
        return xy[0], xy[1], k

    return build()


GUESSES = st.one_of(
    st.sampled_from([0.0, 1e-300, 1e-9, 1.0, 1e9, 1e300]), st.floats(0.0, 1e12, allow_nan=False), st.just("garbage")
)


def guess_of(reach, lanes):
    return 10.0 ** np.random.default_rng(lanes).uniform(-12, 12, lanes) if reach == "garbage" else reach


class TestNearest:
    """All listeners at once."""

    @given(swarm=swarms(), reach=GUESSES)
    @settings(max_examples=400)
    def test_are_those_that_sorting_finds(self, swarm, reach):
        x, y, k = swarm
        assert (links_of(x, y, k, guess_of(reach, len(x))) == nearest_by_sorting(x, y, k)).all()

    @given(
        places=st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2)), min_size=2, max_size=9),
        k=st.integers(1, 8),
        reach=st.sampled_from([0.0, 1.0, 4.0, 1e9]),
    )
    @settings(max_examples=300)
    def test_of_a_few_on_nine_places(self, places, k, reach):
        x, y = np.array(places, float).T.copy()
        neighbors = np.full(len(x), min(k, len(x) - 1))
        assert (links_of(x, y, neighbors, reach) == nearest_by_sorting(x, y, neighbors)).all()

    @given(swarm=swarms(), reach=GUESSES)
    @settings(max_examples=100)
    def test_with_padding_lanes(self, swarm, reach):
        x, y, k = swarm
        lanes = -(-len(x) // PADDING) * PADDING
        linked = links_of(x, y, k, guess_of(reach, lanes), lanes=lanes)
        assert (linked[:, : len(x)] == nearest_by_sorting(x, y, k)).all()
        assert linked[:, len(x) :].all()

    @given(swarm=swarms(40), reach=GUESSES)
    @settings(max_examples=100)
    def test_of_one_listener_at_a_time(self, swarm, reach):
        """As the sequential order asks; the guess is another agent's reach."""
        x, y, k = swarm
        expected = nearest_by_sorting(x, y, k)
        for i in range(len(x)):
            assert (links_of(x, y, k, guess_of(reach, 1), first=i, lanes=1)[:, 0] == expected[:, i]).all()

    @pytest.mark.parametrize("k", [1, 7, 100, 500, 998, 999])
    def test_of_a_thousand(self, k):
        x, y = np.random.default_rng(k).uniform(-10, 10, (2, 1000))
        neighbors = np.full(1000, k)
        assert (links_of(x, y, neighbors, 1.0) == nearest_by_sorting(x, y, neighbors)).all()


class TestTies:
    """By hand."""

    def test_the_lower_index_is_heard(self):
        x, y = np.array([0.0, 1.0, 0.0, -1.0, 0.0]), np.array([0.0, 0.0, 1.0, 0.0, -1.0])
        for k in range(1, 5):
            linked = links_of(x, y, np.full(5, k), 1.0)
            assert np.flatnonzero(linked[:, 0]).tolist() == list(range(1, k + 1))

    def test_nobody_hears_themselves_even_where_all_are_at_one_place(self):
        linked = links_of(np.zeros(6), np.zeros(6), np.full(6, 3), 1.0)
        assert not linked.diagonal().any()
        assert np.flatnonzero(linked[:, 0]).tolist() == [1, 2, 3]
        assert np.flatnonzero(linked[:, 5]).tolist() == [0, 1, 2]

    def test_nothing_is_mended_where_nothing_is_tied(self):
        x, y = np.random.default_rng(0).uniform(-10, 10, (2, 20))
        links = new_links(20, 20)
        measure_distances(links, x, y, x, y, 0, 20)
        links.wanted[:] = 6
        link_nearest(links, 20)
        links.heard[:] = (links.square <= links.reach).sum(axis=0)
        assert links.heard.tolist() == [6] * 20
        assert not settle_ties(links, 20)


class TestRanks:
    """How many of those heard are nearer."""

    @given(swarm=swarms(), reach=st.sampled_from([0.0, 1.0, 30.0, 1e9]))
    @settings(max_examples=200)
    def test_are_places_in_the_sorted_list_of_those_heard(self, swarm, reach):
        x, y = map(np.ascontiguousarray, swarm[:2])
        agents = len(x)
        links = new_links(agents, agents, ranked=True)
        measure_distances(links, x, y, x, y, 0, agents)
        links.reach[:] = reach
        rank_heard(links, agents)
        for i in range(agents):
            square = links.square[:agents, i]
            order = [j for j in np.lexsort((np.arange(agents), square)) if square[j] <= reach]
            assert links.rank[order, i].tolist() == list(range(len(order)))
            assert (np.delete(links.rank[:agents, i], order) == agents).all()


class TestDistances:
    """Squares, and infinity to oneself and in the padding row."""

    @pytest.mark.parametrize("agents", [2, 3, 8, 9])
    def test_are_squares(self, agents):
        x, y = np.random.default_rng(1).uniform(-10, 10, (2, agents))
        links = new_links(agents, agents)
        measure_distances(links, x, y, x, y, 0, agents)
        expected = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2
        np.fill_diagonal(expected, np.inf)
        assert links.square[:agents].tolist() == expected.tolist()
        assert (links.square[agents:] == np.inf).all()
        assert links.square.shape[0] % 2 == 0
