"""Links by lists are links by distances: in random worlds, with ties, piles, agents far off, silent and deaf ones."""

import os

import numpy as np
import pytest

from shoal.compiler.kernel import kernel
from shoal.core.agents import new_swarm
from shoal.core.draws import split, uniform
from shoal.world.lists import LANES, Reception, heard_of, is_listed, list_nearest, new_lists
from shoal.world.neighbors import Links, linked, new_links


def by_sorting(x, y, own_x, own_y, wanted, silent, range_square, true=None, kind=np.float64):
    """Whom each agent hears: of those that it can, the k nearest, ties to the lower index."""
    agents = len(x)
    x, y, own_x, own_y = (each.astype(kind) for each in (x, y, own_x, own_y))
    square = (own_x[:, None] - x) ** 2 + (own_y[:, None] - y) ** 2
    far = square if true is None else (true[0] - true[0][:, None]) ** 2 + (true[1] - true[1][:, None]) ** 2
    square[silent[None, :] | (far > range_square) | np.eye(agents, dtype=bool)] = np.inf
    order = np.argsort(square, axis=1, kind="stable")
    able = np.isfinite(square).sum(axis=1)
    return [sorted(order[i, : min(wanted[i], able[i])].tolist()) for i in range(agents)]


WORLDS = int(os.environ.get("SHOAL_TEST_WORLDS", "40"))


class World:
    """Agents at places; `listed` is whom lists say that each hears."""

    def __init__(self, x, y, most, reach=1.0, ranked=False):
        agents = len(x)
        self.agents = agents
        self.swarm = new_swarm([agents], (), exact=False)
        self.swarm.x[:agents], self.swarm.y[:agents] = x, y
        self.swarm.fix_x[:], self.swarm.fix_y[:] = self.swarm.x, self.swarm.y
        self.links = new_links(agents, self.swarm.x.size, ranked, listed=most)
        self.links.reach[:] = reach
        self.links.wanted[:] = most

    def listed(self, reports=None, **reception):
        how = {"range_square": np.inf, "by_truth": False, "single": False, "loss": 0.0, "key": np.uint64(1)} | reception
        list_nearest(self.links, reports or self.swarm, self.swarm, Reception(**how), self.agents)
        return [self.heard_by(i) for i in range(self.agents)]

    def heard_by(self, i):
        lists = self.links.lists
        block, lane = divmod(int(lists.cells.place[i]), LANES)
        kept = slice(lists.begins[block], lists.begins[block + 1])
        return lists.cells.order[lists.near[kept]][lists.hears[kept] >> lane & 1 == 1].tolist()


def random_places(random, agents):
    """Spread, on a line, in heaps, on a lattice full of ties, or all at one place."""
    kind = random.integers(6)
    x, y = random.uniform(-10, 10, (2, agents))
    if kind == 1:
        y[:] = 0.0
    elif kind == 2:
        x, y = x * 10.0 ** random.integers(-6, 5), y * 10.0 ** random.integers(-6, 5)
    elif kind == 3:
        x, y = np.round(x / 4), np.round(y / 4)
    elif kind == 4:
        x[:], y[:] = x[0], y[0]
    elif kind == 5:
        near = random.random(agents) < 0.8
        x[near], y[near] = x[0] + 1e-3 * x[near], y[0] + 1e-3 * y[near]
    return x, y


def test_random_worlds():
    """Eight steps of each of some worlds; ten thousand were tried once, with another seed."""
    random = np.random.default_rng(WORLDS)
    for _ in range(WORLDS):
        agents = int(random.integers(2, 150))
        k = int(random.integers(1, min(agents, 40)))
        world = World(*random_places(random, agents), k, reach=10.0 ** random.uniform(-8, 8))
        for _ in range(8):  # one after the other, as in a run: the reach is carried over
            swarm, links = world.swarm, world.links
            links.wanted[:agents] = random.integers(0, k + 1, agents) if random.random() < 0.3 else k
            links.silent[:agents] = random.random(agents) < (0.3 if random.random() < 0.3 else 0.0)
            range_square = 10.0 ** random.uniform(-2, 3) if random.random() < 0.4 else np.inf
            single = bool(random.random() < 0.3)
            listed = world.listed(range_square=range_square, single=single)
            x, y, kind = swarm.x[:agents], swarm.y[:agents], np.float32 if single else np.float64
            assert listed == by_sorting(x, y, x, y, links.wanted, links.silent[:agents], range_square, kind=kind)
            assert links.heard[:agents].tolist() == [len(each) for each in listed]
            swarm.x[:agents] += random.uniform(-1, 1, agents)
            swarm.fix_x[:] = swarm.x


def test_range_is_judged_where_agents_are():
    random = np.random.default_rng(4)
    for _ in range(60):
        agents = int(random.integers(20, 200))
        x, y = random.uniform(-10, 10, (2, agents))
        world = World(x, y, 6)
        world.swarm.fix_x[:agents] += random.normal(0, 3, agents)
        world.swarm.fix_y[:agents] += random.normal(0, 3, agents)
        told = world.swarm._replace(x=world.swarm.fix_x, y=world.swarm.fix_y)
        listed = world.listed(told, range_square=9.0, by_truth=True)
        said = world.swarm.fix_x[:agents], world.swarm.fix_y[:agents]
        nobody = np.zeros(agents, bool)
        assert listed == by_sorting(*said, *said, world.links.wanted, nobody, 9.0, true=(x, y))


def test_reports_that_are_old():
    random = np.random.default_rng(5)
    x, y = random.uniform(-10, 10, (2, 90))
    world = World(x, y, 7)
    old = world.swarm._replace(x=world.swarm.x + random.normal(0, 2, world.swarm.x.size))
    listed = world.listed(old)
    nobody = np.zeros(90, bool)
    assert listed == by_sorting(old.x[:90], y, x, y, world.links.wanted, nobody, np.inf)


@kernel
def draw(key, j, i):
    return uniform(split(key, (1 << 33) + j), i)


def test_lost_reports():
    random = np.random.default_rng(6)
    world = World(*random.uniform(-10, 10, (2, 80)), 9)
    whole = world.listed()
    kept = world.listed(loss=0.4, key=np.uint64(77))

    key = np.uint64(77)
    assert kept == [[j for j in heard if draw(key, j, i) >= 0.4] for i, heard in enumerate(whole)]
    assert 0.5 < sum(map(len, kept)) / sum(map(len, whole)) < 0.7


def test_ranks():
    random = np.random.default_rng(7)
    world = World(np.round(random.uniform(-3, 3, 60)), np.round(random.uniform(-3, 3, 60)), 8, ranked=True)
    listed = world.listed()
    x, y = world.swarm.x, world.swarm.y
    lists = world.links.lists
    for i, heard in enumerate(listed):
        nearest = sorted(heard, key=lambda j: ((x[j] - x[i]) ** 2 + (y[j] - y[i]) ** 2, j))
        block, lane = divmod(int(lists.cells.place[i]), LANES)
        kept = [c for c in range(lists.begins[block], lists.begins[block + 1]) if lists.hears[c] >> lane & 1]
        assert [lists.rank[c, lane] for c in kept] == [nearest.index(j) for j in heard]


def test_who_is_linked():
    random = np.random.default_rng(8)
    world = World(*random.uniform(-10, 10, (2, 50)), 5)
    listed = world.listed()
    for i, heard in enumerate(listed):
        assert [j for j in range(50) if linked(world.links, j, i)] == heard
        assert [j for j in range(50) if is_listed(world.links.lists, j, i)] == heard
        assert [heard_of(world.links.lists, i, slot) for slot in range(6)] == [*heard, -1]


def test_somebody_who_is_nowhere_stops_nobody():
    """A strategy may spoil numbers: the run ends with a word at the end of a call, and must get there."""
    random = np.random.default_rng(9)
    for bad in (np.nan, np.inf, -np.inf, 1e308):
        x, y = random.uniform(-10, 10, (2, 40))
        x[3], y[7] = bad, bad
        assert len(World(x, y, 6).listed()) == 40


@pytest.mark.parametrize("agents", [0, 1, 16, 17])
def test_lists_are_padded_to_whole_blocks(agents):
    lists = new_lists(agents, 3, ranked=False)
    assert lists.leads.size == -(-agents // 8) * 8
    assert lists.rank.shape[0] == 0


def test_links_have_either():
    assert new_links(50, 56).lists.leads.size == 0
    assert new_links(50, 56, listed=4).square.size == 0
    assert isinstance(new_links(50, 56, listed=4), Links)
