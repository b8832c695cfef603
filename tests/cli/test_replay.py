"""shoal replay: a record, or a scenario, as one file."""

import base64
import re

import pytest

from frames import decode_all
from scenarios import scenario
from shoal.cli.main import run_command
from shoal.run.simulate import simulate


def replay(*tokens):
    return run_command(["replay", *(str(token) for token in tokens)])


def steps_in(file):
    frames = re.search(r'id="frames">([^<]*)<', file.read_text()).group(1)
    return [frame.step for frame in decode_all(base64.b64decode(frames))]


@pytest.fixture
def record(tmp_path):
    simulate(scenario(changes={"steps": 1000}), out=tmp_path / "r")
    return tmp_path / "r"


class TestReplay:
    def test_a_record_becomes_a_page(self, capsys, record, tmp_path):
        assert replay(record, "--out", tmp_path / "run.html") == 0
        steps = steps_in(tmp_path / "run.html")
        assert steps[:3] == [0, 2, 4]
        assert steps[-300:] == list(range(700, 1000))
        assert "run.html" in capsys.readouterr().err

    def test_only_the_end(self, record, tmp_path):
        assert replay(record, "--out", tmp_path / "run.html", "--part", "end", "--frames", 100) == 0
        assert steps_in(tmp_path / "run.html") == list(range(900, 1000))

    def test_a_scenario_is_run_first(self, tmp_path):
        from shoal.scenario.load import to_toml

        file = tmp_path / "mine.toml"
        file.write_text(to_toml(scenario(changes={"steps": 500})))
        assert replay(file, "--out", tmp_path / "run.html", "--frames", 100) == 0
        assert steps_in(tmp_path / "run.html") == list(range(0, 500, 5))

    @pytest.mark.parametrize(
        ("source", "options", "words"),
        [
            ("nothere", [], "no preset and no file"),
            (".", [], "is not a record"),
            ("oceans2020", ["--frames", 0], "ask for 1 or more"),
            ("oceans2020", ["--part", "middle"], "middle"),
        ],
    )
    def test_bad_input_is_one_message_and_no_file(self, capsys, tmp_path, monkeypatch, source, options, words):
        monkeypatch.chdir(tmp_path)
        assert replay(source, "--out", "run.html", *options) == 2
        assert words in capsys.readouterr().err
        assert not list(tmp_path.iterdir())

    def test_a_damaged_record_is_one_message(self, capsys, record, tmp_path):
        (record / "tallies.npz").write_bytes(b"")
        assert replay(record, "--out", tmp_path / "run.html") == 2
        assert "is damaged" in capsys.readouterr().err

    def test_a_file_that_cannot_be_written_is_one_message(self, capsys, record, tmp_path):
        assert replay(record, "--out", tmp_path / "nowhere" / "run.html") == 2
        assert "cannot be written" in capsys.readouterr().err
