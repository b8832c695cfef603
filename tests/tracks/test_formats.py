"""Specification of which files are read."""

import pytest

from shoal.tracks.read import read_track
from track_files import csv_file, refusal, write


class TestBadFile:
    """Refused before any line is read."""

    def test_a_missing_file_is_named_with_its_nearest_neighbor(self, tmp_path):
        csv_file(tmp_path, "0,0,0")
        where, problem, fix = refusal(tmp_path / "trakc.csv")
        assert where.endswith("trakc.csv")
        assert problem == "no such file"
        assert "track.csv" in fix

    def test_a_missing_folder_is_a_missing_file(self, tmp_path):
        assert refusal(tmp_path / "nowhere" / "track.csv")[1] == "no such file"

    @pytest.mark.parametrize("name", ["track.csv", "track.gpx", "track.nc"])
    def test_an_empty_file_is_said_to_be_empty(self, tmp_path, name):
        (tmp_path / name).touch()
        assert refusal(tmp_path / name)[1] == "is empty"

    @pytest.mark.parametrize("name", ["track.shp", "track", "track.csv.gz"])
    def test_another_format_is_answered_with_those_supported(self, tmp_path, name):
        assert ".csv, .tsv" in refusal(tmp_path / name)[1]

    def test_a_suffix_counts_in_any_case(self, tmp_path):
        path = write(tmp_path, "TRACK.CSV", "time,lat,lon", "0,0,0", "60,0,0")
        assert len(read_track(path).time) == 2

    @pytest.mark.parametrize(
        ("name", "advice"),
        [("a.kmz", "unzip"), ("a.xlsx", "save the sheet as CSV"), ("a.alog", "aloggrep"), ("a.fit", "gpsbabel")],
    )
    def test_how_to_convert_a_format_that_is_not_read(self, tmp_path, name, advice):
        assert advice in refusal(tmp_path / name)[2]

    def test_a_file_that_is_not_netcdf_is_refused(self, tmp_path):
        pytest.importorskip("netCDF4")
        assert "cannot be read" in refusal(write(tmp_path, "track.nc", "time,lat,lon"))[1]

    def test_a_line_without_end_is_no_csv(self, tmp_path):
        where, problem, _ = refusal(write(tmp_path, "track.csv", "x" * 200_000))
        assert where.endswith("track.csv:1")
        assert "is not CSV" in problem

    def test_a_header_alone_holds_no_fixes(self, tmp_path):
        assert refusal(csv_file(tmp_path))[1] == "holds no fixes"

    def test_a_path_may_be_text_and_its_error_repeats_it(self, tmp_path):
        path = str(tmp_path / "track.csv")
        assert refusal(path)[0] == path
