from dataclasses import replace

import numpy as np
import pytest

from shoal.paper.snapshots import fast_agents, find_clustering, find_locked, mean_distance, watch
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

STEPS = 400


@pytest.fixture(scope="module")
def seen():
    return watch(steps=STEPS)


def changed(record: Record, **arrays) -> Record:
    """The record with other arrays in its trajectory."""
    frames = Trajectory.from_arrays(record.trajectories[0].arrays() | arrays)
    return replace(record, trajectories={0: frames})


def flat(record: Record, value: float) -> np.ndarray:
    return np.full_like(record.trajectories[0].x, value)


class TestWatch:
    def test_keeps_every_frame_of_the_paper_s_mixed_swarm(self, seen):
        assert seen.facts.counts == (15, 35)
        assert seen.trajectories[0].step.tolist() == list(range(STEPS))

    def test_is_the_same_run_every_time(self, seen):
        again = watch(steps=STEPS)
        assert np.array_equal(again.trajectories[0].x, seen.trajectories[0].x)


class TestLocked:
    def quiet(self, seen: Record) -> dict:
        """Everybody moves, nobody pushes hardest, agent 49 is always on target."""
        on_target = np.zeros_like(seen.trajectories[0].engaged)
        on_target[:, 49] = True
        return {
            "vx": flat(seen, 1.0),
            "vy": flat(seen, 0.0),
            "engaged": on_target,
            "memory.repulsion": flat(seen, 1.0),
        }

    def test_is_who_stands_still_at_the_strongest_repulsion(self, seen):
        arrays = self.quiet(seen)
        arrays["memory.repulsion"][7, :3] = 1.5
        arrays["vx"][7, 1:4] = 0.0
        found = find_locked(changed(seen, **arrays))
        assert found.frame == 7
        assert np.flatnonzero(found.pushing).tolist() == [0, 1, 2]
        assert np.flatnonzero(found.locked).tolist() == [1, 2]

    def test_still_is_below_a_tenth_of_the_own_top_speed(self, seen):
        arrays = self.quiet(seen)
        arrays["memory.repulsion"][7, [0, 20]] = 1.5  # 2.6 m/s and 1 m/s
        arrays["vx"][7, [0, 20]] = 0.2
        assert np.flatnonzero(find_locked(changed(seen, **arrays)).locked).tolist() == [0]

    def test_the_first_frame_with_the_most_of_them_is_found(self, seen):
        arrays = self.quiet(seen)
        for frame, agents in ((5, 2), (9, 3), (12, 3)):
            arrays["memory.repulsion"][frame, :agents] = 1.5
            arrays["vx"][frame, :agents] = 0.0
        assert find_locked(changed(seen, **arrays)).frame == 9

    def test_frames_with_nobody_on_target_do_not_count(self, seen):
        arrays = self.quiet(seen)
        for frame, agents in ((5, 2), (9, 3)):
            arrays["memory.repulsion"][frame, :agents] = 1.5
            arrays["vx"][frame, :agents] = 0.0
        arrays["engaged"][9] = False
        assert find_locked(changed(seen, **arrays)).frame == 5


class TestClustering:
    def breathing(self, seen: Record, widths: np.ndarray) -> Record:
        """Buoys in a row, as far apart as `widths` says; somebody is on target from frame 10 on."""
        on_target = np.zeros_like(seen.trajectories[0].engaged)
        on_target[10:, 0] = True
        return changed(seen, x=widths[:, np.newaxis] * np.arange(50.0), y=flat(seen, 0.0), engaged=on_target)

    def test_finds_the_closest_frame_on_target_and_the_first_one_apart_again(self, seen):
        widths = np.full(STEPS, 1.0)
        widths[4] = 0.1  # nobody on target
        widths[20:30] = np.linspace(0.5, 0.95, 10)
        widths[30:40] = 1.2
        found = find_clustering(self.breathing(seen, widths))
        assert found.together == 20
        assert found.apart == 30
        assert found.distance[found.apart] > found.median

    def test_buoys_that_stay_together_are_never_apart(self, seen):
        widths = np.full(STEPS, 1.0)
        widths[-5:] = 0.2
        found = find_clustering(self.breathing(seen, widths))
        assert found.together == STEPS - 5
        assert found.apart is None

    def test_only_the_fast_ones_count(self, seen):
        assert fast_agents(seen) == slice(0, 15)

    def test_distance_is_the_mean_over_pairs(self, seen):
        corner = changed(seen, x=flat(seen, 0.0), y=flat(seen, 0.0))
        frames = corner.trajectories[0]
        frames.x[0, 1], frames.y[0, 2] = 3.0, 4.0  # sides 3, 4, 5
        assert mean_distance(frames, slice(0, 3))[0] == pytest.approx(4.0)
        assert mean_distance(frames, slice(0, 1))[0] == 0.0
