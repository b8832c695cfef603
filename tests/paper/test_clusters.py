"""Clusters of fast buoys: what counts as one, and when it is over."""

from types import SimpleNamespace

import numpy as np
import pytest

from shoal.paper.clusters import Episode, closeness, episodes, watch_clusters


class TestCloseness:
    def frames(self, x, y):
        return SimpleNamespace(x=np.array([x], float), y=np.array([y], float))

    def test_agents_spread_like_the_swarm_have_one(self):
        ring = self.frames([1, 0, -1, 0], [0, 1, 0, -1])
        assert closeness(ring, slice(0, 4)) == pytest.approx([1.0])

    def test_agents_in_one_place_have_zero(self):
        assert closeness(self.frames([3, 3, -1, 5], [0, 0, 2, 2]), slice(0, 2)) == pytest.approx([0.0])

    def test_it_does_not_depend_on_the_size_of_the_swarm(self):
        x, y = np.random.default_rng(1).normal(size=(2, 50))
        small, large = (closeness(self.frames(scale * x, scale * y), slice(0, 15)) for scale in (1, 7))
        assert small == pytest.approx(large)


class TestEpisodes:
    def test_one_begins_below_a_bound_and_ends_above_another(self):
        near = np.array([1.0, 0.7, 0.55, 0.8, 0.5, 0.95, 1.0])
        assert episodes(near, run=3, every=5) == [Episode(3, 10, 15, dispersed=True)]

    def test_one_that_lasts_to_the_end_has_not_dispersed(self):
        assert episodes(np.array([0.5, 0.7]), every=1) == [Episode(0, 0, 2, dispersed=False)]

    def test_a_swarm_that_is_always_mixed_has_none(self):
        assert episodes(np.full(9, 0.97)) == []


def test_the_papers_swarm_is_watched_run_by_run():
    found = watch_clusters(steps=300, runs=2, target_speeds=(3.0,))
    assert all(each.run in (0, 1) and 0 <= each.begin < 300 for each in found)
