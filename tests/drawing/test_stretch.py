"""Specification of which frames are shown: evenly apart, kept, and said if they are not."""

import numpy as np
import pytest

from shoal.core.errors import RecordError
from shoal.drawing.stretch import frame_of, kept_text, stretch_of

OVERVIEW = np.concatenate([np.arange(0, 700, 10), np.arange(700, 1000)])  # as `shoal run` keeps


def shown(*args):
    """The steps shown, and how far apart."""
    stretch = stretch_of(*args)
    return args[0][stretch.frames].tolist(), stretch.every


class TestStretch:
    def test_without_a_wish_the_last_frames_that_are_evenly_apart(self):
        assert shown(OVERVIEW) == (list(range(700, 1000)), 1)

    def test_all_frames_of_a_record_that_kept_them_evenly(self):
        assert shown(np.arange(0, 100, 7)) == (list(range(0, 100, 7)), 7)

    def test_so_many_steps_are_the_last_ones(self):
        assert shown(OVERVIEW, None, 50) == (list(range(950, 1000)), 1)

    def test_from_a_step_on(self):
        assert shown(OVERVIEW, 980) == (list(range(980, 1000)), 1)

    def test_across_the_overview_as_finely_as_it_was_kept(self):
        assert shown(OVERVIEW, 600) == (list(range(600, 1000, 10)), 10)

    def test_every_so_many_steps(self):
        assert shown(OVERVIEW, 700, 30, 15) == ([700, 715], 15)

    def test_one_frame_is_a_stretch(self):
        assert shown(np.array([5])) == ([5], 1)

    @pytest.mark.parametrize("wish", [(5,), (2000,), (700, 500), (0, 100, 3), (None, 9000)], ids=str)
    def test_what_was_not_kept_is_refused_with_what_was(self, wish):
        with pytest.raises(RecordError, match=r"keeps 0, 10, \.\.\. 700 and 700 to 999"):
            stretch_of(OVERVIEW, *wish)


class TestFrameOf:
    def test_the_index_of_a_step(self):
        assert frame_of(OVERVIEW, 690) == 69

    def test_a_step_between_two_frames_was_not_kept(self):
        with pytest.raises(RecordError, match="step 695: was not kept"):
            frame_of(OVERVIEW, 695)


def test_the_steps_kept_in_few_words():
    assert kept_text(np.arange(10)) == "0 to 9"
    assert kept_text(np.array([4])) == "4"
    assert kept_text(np.arange(0, 50, 5)) == "0, 5, ... 45"
