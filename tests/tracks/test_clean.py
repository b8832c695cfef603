"""Specification of the rule that cleans every track: one bad fix costs one fix."""

from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import TrackError
from shoal.tracks.clean import longest_path
from shoal.tracks.ground import along_the_ground, points
from shoal.tracks.read import read_track
from shoal.tracks.table import Fixes
from track_files import DEGREE, csv_file, eastward, refusal


class TestDuplicates:
    """Of fixes with the same time the first counts."""

    def test_the_first_is_kept_and_the_others_counted(self, tmp_path):
        rows = [f"{60 * i},0,{0.001 * i}" for i in range(8)]
        track = read_track(csv_file(tmp_path, *rows[:4], "180,0,0.0031", "180,0,0.0032", *rows[4:]))
        assert track.time.tolist() == [60.0 * i for i in range(8)]
        assert track.x[3] - track.x[2] == pytest.approx(0.001 * DEGREE, rel=1e-3)
        assert "Fixes dropped for repeating the time of the one before: 2." in track.notes

    def test_of_two_at_one_time_the_one_within_reach_counts(self, tmp_path):
        rows = [f"{60 * i},0,{0.001 * i}" for i in range(8)]
        track = read_track(csv_file(tmp_path, *rows[:4], "240,0,9", *rows[4:]))
        assert len(track.time) == 8

    def test_a_fix_that_is_there_twice_counts_once(self, tmp_path):
        rows = [f"{60 * i},0,{0.001 * i}" for i in range(4)]
        track = read_track(csv_file(tmp_path, *(row for row in rows for _ in range(2))))
        assert len(track.time) == 4


class TestJumps:
    """No target covers more than max_speed between two fixes."""

    def steps(self, folder, *lons, **options):
        return read_track(eastward(folder, lons), **options)

    def jump_notes(self, track):
        return [note for note in track.notes if "speed above" in note]

    def test_a_path_below_max_speed_is_kept_whole(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 0.002)
        assert len(track.time) == 3
        assert self.jump_notes(track) == []

    def test_a_fix_far_off_is_dropped_and_both_sides_stay(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 0.002, 9.0, 0.004, 0.005)
        assert track.time.tolist() == [0.0, 60.0, 120.0, 240.0, 300.0]
        (note,) = self.jump_notes(track)
        assert "40 m/s could reach them: 1, at 2020-09-13T12:29:40Z." in note

    def test_a_wrong_first_or_last_fix_is_dropped(self, tmp_path):
        track = self.steps(tmp_path, 9.0, 0.001, 0.002, 0.003, 9.0)
        assert len(track.time) == 3
        assert track.start == "2020-09-13T12:27:40Z"
        assert track.time[0] == 0.0

    def test_the_longest_run_wins_wherever_it_is(self, tmp_path):
        track = self.steps(tmp_path, 9.0, 9.001, 0.0, 0.001, 0.002, 5.0, 5.001)
        assert np.ptp(track.x) == pytest.approx(0.002 * DEGREE, rel=1e-3)
        assert len(track.time) == 3

    def test_runs_on_the_left_within_reach_of_the_longest_are_kept(self, tmp_path):
        track = self.steps(tmp_path, 0.0, 0.001, 9.0, 0.003, 0.004, 0.005)
        assert len(track.time) == 5

    def test_many_dropped_fixes_show_only_the_first_times(self, tmp_path):
        track = self.steps(tmp_path, *(0.001 * i for i in range(6)), 5.0, 6.0, 7.0, 8.0, 9.0)
        (note,) = self.jump_notes(track)
        assert "them: 5, at" in note
        assert note.count("2020-") == 3
        assert note.endswith(" and 2 more.")

    def test_a_higher_max_speed_lets_more_through(self, tmp_path):
        path = eastward(tmp_path, [0.0, 0.01, 0.03, 0.04])  # 19, 37 and 19 m/s
        assert len(read_track(path).time) == 4
        assert len(read_track(path, max_speed=30.0).time) == 3  # round the fast step

    def test_a_track_of_jumps_only_is_refused(self, tmp_path):
        _, problem, fix = refusal(eastward(tmp_path, [0.0, 5.0, 10.0]))
        assert "1 usable fix" in problem
        assert "max_speed" in fix

    def test_the_speed_is_measured_along_the_earth(self, tmp_path):
        """At 60 degrees north a degree of longitude is half as long."""
        lons = [0.0, 0.03]
        assert len(read_track(eastward(tmp_path, lons, lat=60.0)).time) == 2
        refusal(eastward(tmp_path, lons, lat=0.0))


def fixes(seconds, lat, lon):
    """Fixes as a reader gives them."""
    line = np.arange(len(seconds))
    return Fixes(np.asarray(seconds, float), np.asarray(lat, float), np.asarray(lon, float), line, str, ())


def longest_by_trying(track, max_speed):
    """The length of the longest chain, every pair looked at."""
    where, level = points(track), []
    for i, here in enumerate(where):
        before = [
            level[j]
            for j in range(i)
            if track.unix[i] > track.unix[j]
            and along_the_ground(np.linalg.norm(here - where[j])) <= max_speed * (track.unix[i] - track.unix[j])
        ]
        level.append(1 + max(before, default=0))
    return max(level)


class TestLongestPath:
    """One bad fix costs one fix: as many are kept as can be."""

    @pytest.mark.parametrize("seed", range(20))
    def test_no_chain_is_longer(self, seed):
        chance = np.random.default_rng(seed)
        count = chance.integers(2, 60)
        track = fixes(np.sort(chance.integers(0, 600, count)), *chance.normal(0.0, 0.02, (2, count)))
        kept = longest_path(Path("x.csv"), track, 40.0)
        assert kept.sum() == longest_by_trying(track, 40.0)

    def test_no_step_of_it_is_too_fast(self):
        chance = np.random.default_rng(1)
        track = fixes(np.arange(500) * 10.0, *chance.normal(0.0, 0.02, (2, 500)))
        kept = track.where(longest_path(Path("x.csv"), track, 100.0))
        meters = np.linalg.norm(np.diff(points(kept), axis=0), axis=1)
        assert (meters / np.diff(kept.unix)).max() <= 100.0

    def test_a_stamp_too_early_costs_one_fix(self):
        seconds = np.arange(61) * 1800.0
        seconds[30] -= 1750.0
        kept = longest_path(Path("x.csv"), fixes(seconds, 54.0 + 0.027 * np.arange(61), np.full(61, 10.0)), 40.0)
        assert np.flatnonzero(~kept).tolist() == [30]

    def test_a_hundred_thousand_fixes_lose_only_the_thousand_bad_ones(self):
        lat = 54.0 + 1e-5 * np.arange(100_000)
        bad = np.arange(50, 100_000, 100)
        lat[bad] += 5.0
        kept = longest_path(Path("x.csv"), fixes(np.arange(100_000) * 10.0, lat, np.full(100_000, 10.0)), 40.0)
        assert np.flatnonzero(~kept).tolist() == bad.tolist()

    def test_a_long_file_of_jumps_is_refused(self):
        lat = np.where(np.arange(2000) % 2, 54.0, 55.0)
        with pytest.raises(TrackError, match="100% of its steps are faster than max_speed = 40 m/s"):
            longest_path(Path("x.csv"), fixes(np.arange(2000) * 10.0, lat, np.full(2000, 10.0)), 40.0)


class TestOrder:
    """Lines out of order are sorted; stamps out of order are named."""

    LINES = tuple(f"{1_600_000_000 + 60 * i},0,{0.001 * i:.3f}" for i in range(12))

    def test_lines_out_of_order_are_sorted_by_time(self, tmp_path):
        lines = [*self.LINES[:3], self.LINES[4], self.LINES[3], *self.LINES[5:]]
        track = read_track(csv_file(tmp_path, *lines))
        assert track.time.tolist() == [60.0 * i for i in range(12)]
        assert "Fixes that stood after a later one were sorted by time: 1." in track.notes

    def test_a_file_with_the_newest_first_is_sorted(self, tmp_path):
        assert (
            read_track(csv_file(tmp_path, *self.LINES[::-1])).digest
            == read_track(csv_file(tmp_path, *self.LINES)).digest
        )

    def test_stamps_far_too_early_are_named_to_be_removed_not_sorted(self, tmp_path):
        lines = list(self.LINES)
        lines[7], lines[8] = (line.replace("16000", "15999", 1) for line in lines[7:9])
        where, problem, fix = refusal(csv_file(tmp_path, *lines))
        assert where.endswith("track.csv:9")
        assert "time goes backwards, from 2020-09-13T12:32:40Z to" in problem
        assert fix == "remove the 2 fixes whose times are wrong, at 9, 10; do not sort"

    def test_two_boats_without_a_name_are_not_one(self, tmp_path):
        other = [line.replace(",0,", ",0.5,") for line in self.LINES]
        _, problem, fix = refusal(csv_file(tmp_path, *self.LINES, *other))
        assert "time goes backwards" in problem
        assert "keep one vehicle" in fix


class TestCoarseTimes:
    """Times that lost digits put many fixes at one moment."""

    def test_they_are_refused_with_the_reason(self, tmp_path):
        rows = [f"{1_600_000_000 + 20 * i // 60 * 60},0,{0.001 * i}" for i in range(30)]
        _, problem, fix = refusal(csv_file(tmp_path, *rows))
        assert problem.startswith(
            "20 of 30 fixes lie elsewhere at the time of the one before: the times have lost digits"
        )
        assert "all their digits" in fix

    def test_up_to_a_quarter_may_be_chance(self, tmp_path):
        rows = [f"{60 * (i - (i % 4 == 3))},0,{0.001 * i}" for i in range(40)]
        assert len(read_track(csv_file(tmp_path, *rows)).time) == 30
