"""The frames kept to go back to."""

import numpy as np

from shoal.viewer.ring import Kept, Ring


def kept(step, size=10):
    return Kept(step, ("scene",), (bytes(size),))


def ring(*steps, room=10_000):
    filled = Ring(room)
    for step in steps:
        filled.add(kept(step))
    return filled


class TestRing:
    def test_a_step_between_two_frames_shows_the_earlier(self):
        assert ring(0, 10, 20).at(19).step == 10
        assert ring(0, 10, 20).at(20).step == 20

    def test_a_step_before_all_shows_the_oldest(self):
        assert ring(50, 60).at(3).step == 50

    def test_a_frame_beside_another_ends_at_the_ends(self):
        frames = ring(0, 10, 20)
        assert [frames.beside(10, n).step for n in (-5, -1, 0, 1, 5)] == [0, 0, 10, 20, 20]

    def test_the_oldest_make_room(self):
        frames = ring(*range(100), room=50)
        assert (frames.oldest.step, frames.newest.step, len(frames)) == (95, 99, 5)

    def test_one_frame_is_kept_however_large(self):
        frames = ring(1, room=3)
        assert len(frames) == 1

    def test_a_few_frames_are_spread_over_the_steps_of_all(self):
        crowded = ring(*range(100), *range(100, 1000, 50))  # slow at first
        spread = [each.step for each in crowded.spread(11)]
        assert (spread[0], spread[-1]) == (0, 950)
        assert np.abs(np.array(spread) - np.linspace(0, 950, 11)).max() < 50
        assert [each.step for each in ring(3, 4).spread(11)] == [3, 4]

    def test_a_frame_of_the_same_step_replaces_the_newest(self):
        frames = ring(0, 10)
        frames.add(kept(10, size=7))
        assert (len(frames), len(frames.newest.frames[0])) == (2, 7)
