"""Specification of the snapshot: everything that is there once, in its place, and nothing that is not."""

from dataclasses import replace

import numpy as np
import pytest

from shoal.core.errors import RecordError
from shoal.drawing.arena import round_length
from shoal.drawing.arena_drawing import Parts
from shoal.drawing.snapshot import draw_snapshot
from shoal.drawing.trails import consecutive

TRACK = {"kind": "track", "radius": 1.0, "file": "track.csv", "id": None}


def with_frames(record, **changes):
    return replace(record, trajectories={0: replace(record.trajectories[0], **changes)})


class TestAgents:
    """One mark per buoy, told apart by fleet, by speed and by being on target."""

    def test_every_buoy_of_a_fleet_is_drawn_where_it_was(self, axes, make_record, marks):
        record = make_record(counts=(3, 2))
        draw_snapshot(axes, record)
        fast, slow = (np.asarray(marks(axes, f"fleet-{fleet}")[0].get_offsets()) for fleet in (0, 1))
        assert np.concatenate([fast, slow])[:, 0] == pytest.approx(record.trajectories[0].x[-1])

    def test_the_faster_fleet_is_bigger(self, axes, make_record, marks):
        draw_snapshot(axes, make_record())
        fast, slow = (marks(axes, f"fleet-{fleet}")[0].get_sizes()[0] for fleet in (0, 1))
        assert fast > slow

    def test_a_buoy_on_target_is_bigger_and_has_a_thicker_rim(self, axes, make_record, marks):
        record = make_record()
        on_target = np.zeros((40, 5), bool)
        on_target[-1, 0] = True
        draw_snapshot(axes, with_frames(record, on_target=on_target))
        fast = marks(axes, "fleet-0")[0]
        assert fast.get_sizes()[0] > fast.get_sizes()[1]
        assert fast.get_linewidths()[0] > fast.get_linewidths()[1]

    def test_links_are_drawn_when_asked_for(self, axes, make_record, marks):
        links = np.zeros((40, 5, 1), np.uint8)
        links[-1, 0], links[-1, 1], links[-1, 4] = 0b00110, 0b00001, 0b00001  # 0 hears 1 and 2; 1 and 4 hear 0
        draw_snapshot(axes, with_frames(make_record(counts=(3, 2)), links=links), parts=Parts(links=True))
        assert len(marks(axes, "links")[0].get_segments()) == 3  # a line where both hear each other, too

    def test_links_that_were_not_kept_are_not_made_up(self, axes, make_record):
        with pytest.raises(RecordError, match="keep no links"):
            draw_snapshot(
                axes, with_frames(make_record(), links=np.zeros((40, 5, 0), np.uint8)), parts=Parts(links=True)
            )

    def test_no_links_otherwise(self, axes, make_record, marks):
        draw_snapshot(axes, make_record())
        assert not marks(axes, "links")


class TestTargets:
    """A disc of the target's size, its trail behind it."""

    def test_each_target_is_a_disc_of_its_radius(self, axes, make_record, marks):
        targets = [{"kind": "waypoint", "radius": radius, "speed": 1.0} for radius in (1.0, 0.5)]
        draw_snapshot(axes, make_record(targets=targets))
        assert [disc.get_radius() for disc in marks(axes, "target-disc")] == [1.0, 0.5]

    def test_an_absent_target_is_not_drawn(self, axes, make_record, marks):
        record = with_frames(make_record(), target_present=np.zeros((40, 1), bool))
        draw_snapshot(axes, record)
        assert not marks(axes, "target-disc")
        assert "absent" in axes.get_title("left")

    def test_the_trail_has_a_segment_per_step(self, axes, make_record, marks):
        draw_snapshot(axes, make_record(), trail=10)
        assert len(marks(axes, "target-trail")[0].get_segments()) == 10

    def test_the_trail_breaks_where_the_target_was_absent(self, axes, make_record, marks):
        present = np.ones((40, 1), bool)
        present[-5] = False
        draw_snapshot(axes, with_frames(make_record(), target_present=present), trail=10)
        assert len(marks(axes, "target-trail")[0].get_segments()) == 8

    def test_the_trail_begins_after_a_jump_between_frames(self, axes, make_record, marks):
        step = np.arange(40) + np.where(np.arange(40) >= 37, 100, 0)
        draw_snapshot(axes, with_frames(make_record(), step=step), trail=10)
        assert len(marks(axes, "target-trail")[0].get_segments()) == 2

    def test_a_recorded_target_shows_its_whole_path_with_its_ends_and_a_scale(self, axes, make_record, marks):
        draw_snapshot(axes, make_record(targets=[TRACK]))
        (path,) = marks(axes, "target-path")
        assert path.get_xydata().shape == (40, 2)
        assert [marks(axes, f"path-{end}")[0].get_ydata()[0] for end in ("start", "end")] == [-5.0, 5.0]
        assert marks(axes, "scale-bar")

    def test_a_track_that_leaves_the_arena_stays_in_view(self, axes, make_record):
        record = make_record(targets=[TRACK])
        draw_snapshot(axes, with_frames(record, target_x=np.full((40, 1), 15.0)))
        assert axes.get_xlim()[1] > 16.0

    def test_a_track_that_is_never_there_leaves_no_path(self, axes, make_record, marks):
        record = with_frames(make_record(targets=[TRACK]), target_present=np.zeros((40, 1), bool))
        draw_snapshot(axes, record)
        assert not marks(axes, "target-path")


class TestArena:
    """Equal scales, in units that read well."""

    def test_a_small_arena_is_in_meters_without_a_scale_bar(self, axes, make_record, marks):
        draw_snapshot(axes, make_record())
        assert axes.get_xlabel() == "east [m]"
        assert axes.get_aspect() == 1.0
        assert not marks(axes, "scale-bar")

    def test_over_two_kilometers_it_is_in_kilometers_with_a_scale_bar(self, axes, make_record, marks):
        draw_snapshot(axes, make_record(area=(9000.0, 9000.0, 700.0)))
        assert axes.get_xlabel() == "east [km]"
        assert axes.xaxis.get_major_formatter()(2000.0, None) == "2"
        left, right = marks(axes, "scale-bar")[0].get_xdata()
        assert right - left == pytest.approx(2000.0)

    def test_a_scale_bar_is_the_longest_round_length_within_its_limit(self):
        assert [round_length(limit) for limit in (10.0, 9.9, 2340.0, 0.4)] == pytest.approx([10, 5, 2000, 0.2])


class TestErrors:
    """What cannot be drawn is said."""

    def test_a_run_without_a_trajectory(self, axes, make_record):
        with pytest.raises(RecordError, match=r"run 1: kept no trajectory; runs that did: 0"):
            draw_snapshot(axes, make_record(), run=1)

    def test_a_frame_that_is_not_there(self, axes, make_record):
        with pytest.raises(RecordError, match="is not one of the 40 frames"):
            draw_snapshot(axes, make_record(), frame=40)


class TestConsecutive:
    """The frames that lead step by step to one of them."""

    def test_a_whole_window(self):
        assert consecutive(np.arange(10), 9, 3) == slice(6, 10)

    def test_no_further_back_than_the_first_frame(self):
        assert consecutive(np.arange(3), 2, 9) == slice(0, 3)

    def test_after_the_last_jump(self):
        assert consecutive(np.array([0, 5, 10, 11, 12]), 4, 9) == slice(2, 5)

    def test_frames_far_apart_leave_one(self):
        assert consecutive(np.arange(0, 50, 10), 4, 9) == slice(4, 5)
