"""Specification of reading a recorded track: options, gaps, digest, real files."""

import os
import sys

import numpy as np
import pytest

from shoal.core.errors import MissingExtraError
from shoal.tracks.read import read_track
from track_files import CURRENTS, DRIFTERS, MAB_AIS, SOLENT, csv_file, eastward, real, refusal, write

FERRY, SHIP = "mmsi=235069877", "mmsi=247007000"
DRIFTER, GLITCHING_VESSEL = "drifter_id=8213480", "mmsi=338415278"


class TestOptions:
    @pytest.mark.parametrize("max_speed", [0.0, -1.0, float("nan")])
    def test_max_speed_is_positive(self, tmp_path, max_speed):
        assert refusal(eastward(tmp_path, [0, 0]), max_speed=max_speed)[0] == "max_speed"

    @pytest.mark.parametrize("max_gap", [0.0, -1.0, float("nan")])
    def test_max_gap_is_positive(self, tmp_path, max_gap):
        assert refusal(eastward(tmp_path, [0, 0]), max_gap=max_gap)[0] == "max_gap"

    @pytest.mark.parametrize("origin", [(0.0, 91.0), (-181.0, 0.0), (float("nan"), 0.0)])
    def test_origin_lies_on_earth(self, tmp_path, origin):
        assert refusal(eastward(tmp_path, [0, 0]), origin=origin)[0] == "origin"


class TestMaxGap:
    def test_it_is_five_minutes_at_least(self, tmp_path):
        assert read_track(eastward(tmp_path, [0, 0, 0])).max_gap == 300.0

    def test_it_is_five_median_intervals_if_that_is_longer(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0", "600,0,0", "1200,0,0", "90000,0,0")
        assert read_track(path).max_gap == 3000.0

    def test_it_can_be_chosen(self, tmp_path):
        assert read_track(eastward(tmp_path, [0, 0]), max_gap=7).max_gap == 7.0

    def test_longer_silences_are_noted(self, tmp_path):
        path = csv_file(tmp_path, "0,0,0", "60,0,0", "120,0,0", "1120,0,0", "2120,0,0")
        (note,) = read_track(path, max_gap=900.0).notes[1:]
        assert "longer than 900 s" in note
        assert "absent: 2, 2000 s in all" in note


class TestDigest:
    """The same path has the same digest, another path or gap another one."""

    def test_it_depends_on_the_numbers_not_on_the_file(self, tmp_path):
        first = write(tmp_path, "a.csv", "time,lat,lon", "0,0,0", "60,0,0.001")
        second = write(tmp_path, "b.csv", "x,longitude,latitude,time", ",0,0,0", ",0.0010,0,60")
        assert read_track(first).digest == read_track(second).digest

    def test_a_moved_fix_another_time_or_gap_changes_it(self, tmp_path):
        digests = {
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.001")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.002")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "61,0,0.001")).digest,
            read_track(csv_file(tmp_path, "0,0,0", "60,0,0.001"), max_gap=400.0).digest,
        }
        assert len(digests) == 4
        assert {len(digest) for digest in digests} == {64}


class TestMemory:
    """A file is read once, unless it changes."""

    def test_it_is_not_read_again_for_another_max_speed(self, tmp_path, monkeypatch):
        path = eastward(tmp_path, [0.0, 0.001, 0.002])
        os.utime(path, (1_600_000_000, 1_600_000_000))
        first = read_track(path)
        monkeypatch.setattr("shoal.tracks.read.read_table", None)
        assert read_track(path, max_speed=80.0).digest == first.digest

    @pytest.mark.parametrize("when", [1_600_000_000, None])
    def test_a_file_that_changed_is_read_again(self, tmp_path, when):
        digests = []
        for lon in (0.002, 0.003):
            path = eastward(tmp_path, [0.0, 0.001, lon])
            if when:
                os.utime(path, (when + lon * 1000, when + lon * 1000))
            digests.append(read_track(path).digest)
        assert digests[0] != digests[1]


class TestMissingExtra:
    """An absent optional library is one sentence with its cure."""

    def test_projecting_needs_pyproj(self, tmp_path, monkeypatch):
        path = eastward(tmp_path, [0.0, 0.001])
        monkeypatch.setitem(sys.modules, "pyproj", None)
        with pytest.raises(MissingExtraError, match=r"shoal\[maritime\]"):
            read_track(path)

    def test_netcdf_needs_netcdf4(self, tmp_path, monkeypatch):
        monkeypatch.setitem(sys.modules, "netCDF4", None)
        with pytest.raises(MissingExtraError, match=r"shoal\[xarray\]"):
            read_track(write(tmp_path, "track.nc", "anything"))


class TestRealData:
    """Solent AIS, Coast Guard drifters and a vessel with a GPS glitch."""

    def test_a_fast_ferry_crosses_the_solent_and_comes_back(self):
        track = read_track(real(SOLENT), track_id=FERRY)
        assert len(track.time) == 1104
        assert track.notes == ("Fixes dropped for repeating the time of the one before: 1.",)
        harbor, far_side = track.y > 3000.0, track.y < -3000.0
        there = int(np.argmax(far_side))
        assert harbor[:there].any()
        assert harbor[there:].any()

    def test_a_ship_passes_the_whole_solent_without_a_loss(self):
        track = read_track(real(SOLENT), track_id=SHIP)
        assert len(track.time) == 192
        assert np.ptp(track.x) == pytest.approx(18.1e3, rel=0.01)
        assert np.ptp(track.y) == pytest.approx(10.7e3, rel=0.01)
        assert track.notes == ()

    @pytest.mark.parametrize(("vessel", "top_speed"), [(SHIP, 7.0), (FERRY, 24.0)])
    def test_no_step_is_faster_than_the_vessel(self, vessel, top_speed):
        track = read_track(real(SOLENT), track_id=vessel)
        speed = np.hypot(np.diff(track.x), np.diff(track.y)) / np.diff(track.time)
        assert speed.max() < top_speed

    def test_the_solent_file_asks_which_vessel(self):
        _, problem, fix = refusal(real(SOLENT))
        assert "holds 91 tracks, told apart by mmsi" in problem
        assert "--track-id mmsi=" in fix

    def test_a_drifter_drifts_for_weeks_and_falls_silent_at_times(self):
        track = read_track(real(DRIFTERS), track_id=DRIFTER)
        assert len(track.time) == 965
        assert track.time[-1] > 26 * 86400
        assert track.max_gap == 9000.0
        speed = np.hypot(np.diff(track.x), np.diff(track.y)) / np.diff(track.time)
        assert speed.max() < 1.5
        assert "Silences longer than 9000 s" in track.notes[-1]

    def test_a_segment_of_all_drifters_is_not_one_track(self):
        problem = refusal(real(DRIFTERS), track_id="segment=0")[1]
        assert problem.startswith("segment=0 holds 7 tracks, told apart by drifter_id")

    def test_a_gps_glitch_is_dropped_and_the_fix_after_it_kept(self):
        track = read_track(real(MAB_AIS), track_id=GLITCHING_VESSEL)
        assert len(track.time) == 8
        assert np.hypot(track.x, track.y).max() < 50.0
        (note,) = [note for note in track.notes if "speed above" in note]
        assert "them: 2, at 2022-01-03T00:18:40Z, 2022-01-03T00:20:38Z." in note

    def test_a_grid_of_currents_is_not_a_track(self):
        pytest.importorskip("netCDF4")
        assert "is it a grid?" in refusal(real(CURRENTS))[1]
