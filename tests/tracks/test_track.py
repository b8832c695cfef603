"""Specification of a track: where its target is at any time."""

import numpy as np

from shoal.tracks.read import read_track
from shoal.tracks.track import Track, position_at
from track_files import eastward


class TestPositionAt:
    """Straight between fixes, absent where nothing was recorded."""

    TRACK = Track(
        time=np.array([0.0, 10.0, 20.0, 100.0, 110.0]),
        x=np.array([0.0, 10.0, 20.0, 100.0, 100.0]),
        y=np.array([0.0, -20.0, 0.0, 0.0, 5.0]),
        origin=(0.0, 0.0),
        start="2020-01-01T00:00:00Z",
        max_gap=50.0,
        notes=(),
        digest="",
    )

    def test_between_two_fixes_it_is_on_the_line(self):
        x, y, present = position_at(self.TRACK, 2.5)
        assert (float(x), float(y), bool(present)) == (2.5, -5.0, True)

    def test_at_every_fix_it_is_there(self):
        x, y, present = position_at(self.TRACK, self.TRACK.time)
        assert x.tolist() == self.TRACK.x.tolist()
        assert y.tolist() == self.TRACK.y.tolist()
        assert present.all()

    def test_before_the_first_and_after_the_last_fix_it_is_absent(self):
        x, y, present = position_at(self.TRACK, [-1.0, 110.0001])
        assert not present.any()
        assert np.isnan([x, y]).all()

    def test_inside_a_long_silence_it_is_absent_and_at_its_ends_present(self):
        present = position_at(self.TRACK, [20.0, 20.0001, 60.0, 99.9999, 100.0])[2]
        assert present.tolist() == [True, False, False, False, True]

    def test_a_silence_of_exactly_max_gap_is_bridged(self, tmp_path):
        track = read_track(eastward(tmp_path, [0.0, 0.001]), max_gap=60.0)
        assert bool(position_at(track, 30.0)[2])
        shorter = read_track(eastward(tmp_path, [0.0, 0.001]), max_gap=59.9)
        assert not bool(position_at(shorter, 30.0)[2])

    def test_no_time_is_no_presence(self):
        assert not bool(position_at(self.TRACK, float("nan"))[2])

    def test_the_answer_has_the_shape_of_the_question(self):
        assert [part.shape for part in position_at(self.TRACK, np.zeros((2, 3)))] == [(2, 3)] * 3
