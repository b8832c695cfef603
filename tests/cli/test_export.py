"""shoal export: the tracks of a record in a file."""

from pathlib import Path

import pytest

from commands import shoal

pytest.importorskip("pyproj")

RECORD = Path(__file__).parents[1] / "data" / "results-v2" / "every"  # nowhere on Earth, at no time
WHERE = ("--origin", "-1.3,50.8")
WHEN = ("--start", "2015-11-16T06:00:00Z")


class TestExport:
    @pytest.mark.parametrize("origin", [WHERE, ("--origin=-1.3,50.8",)])
    def test_says_what_was_written(self, capsys, tmp_path, origin):
        file = tmp_path / "run.gpx"
        code, out, err = shoal(capsys, "export", RECORD, "--out", file, *origin, *WHEN)
        assert (code, out) == (0, "")
        told = "7 buoys and targets at 8 times, 2015-11-16T06:00:00Z to 2015-11-16T06:00:00.700000Z"
        assert f"gpx: {file}, {told}" in err
        assert file.read_text().count("<trkpt") == 7 * 8

    def test_takes_a_format_and_every_nth_step(self, capsys, tmp_path):
        file = tmp_path / "run.txt"
        code, _, err = shoal(capsys, "export", RECORD, "--out", file, "--to", "csv", "--every", 3, *WHERE, *WHEN)
        assert code == 0, err
        assert len(file.read_text().splitlines()) == 1 + 7 * 3  # steps 0, 3, 6

    @pytest.mark.parametrize(
        ("tokens", "words"),
        [
            ([*WHEN], "tiny: has no place on Earth"),
            ([*WHERE], "tiny: says not when it takes place"),
            ([*WHEN, "--origin", "50.8"], "50.8 is not a place on Earth"),
            ([*WHERE, "--start", "2015-11-16"], "has no time zone"),
            ([*WHERE, *WHEN, "--run", "1"], "run 1: keeps no frames"),
            ([*WHERE, *WHEN, "--every", "0"], "every: is 0"),
            ([*WHERE, *WHEN, "--to", "shape"], "shape"),
        ],
    )
    def test_bad_input_is_one_message_and_no_file(self, capsys, tmp_path, tokens, words):
        code, _, err = shoal(capsys, "export", RECORD, "--out", tmp_path / "run.csv", *tokens)
        assert code == 2
        assert words in err
        assert err.count("fix:") == 1
        assert not list(tmp_path.iterdir())

    def test_what_is_no_record_is_one_message(self, capsys, tmp_path):
        code, _, err = shoal(capsys, "export", tmp_path, "--out", tmp_path / "run.csv", *WHERE, *WHEN)
        assert code == 2
        assert "is not a record" in err

    def test_a_file_that_is_there_stays_as_it_is(self, capsys, tmp_path):
        (tmp_path / "run.csv").write_text("mine")
        code, _, err = shoal(capsys, "export", RECORD, "--out", tmp_path / "run.csv", *WHERE, *WHEN)
        assert code == 2
        assert "exists already" in err
        assert (tmp_path / "run.csv").read_text() == "mine"
