"""shoal film: what it writes and says, and what it says of bad input."""

from pathlib import Path

import pytest

from shoal.cli.main import run_command

pytest.importorskip("imageio_ffmpeg", reason="films need imageio-ffmpeg: pip install '.[video]'")
pytest.importorskip("matplotlib", reason="films need matplotlib: pip install '.[video]'")


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def shoal(capsys, *tokens):
    """Run a command; return exit code and stderr."""
    code = run_command([str(token) for token in tokens])
    return code, capsys.readouterr().err


class TestFilm:
    def test_of_a_scenario_it_runs_as_far_as_is_shown(self, capsys):
        code, told = shoal(
            capsys, "film", "oceans2020", "--start", 100, "--steps", 6, "--size", "240x240", "--out", "f.mp4"
        )
        assert code == 0
        assert "steps 100 to 105, 6 frames in 0.2 s (3 times real time), 240 x 240 pixels" in told

    def test_of_a_record_it_shows_what_was_kept(self, capsys):
        shoal(capsys, "run", "oceans2020", "--steps", 40, "--every", 5, "--out", "record")
        code, told = shoal(capsys, "film", "record", "--size", 240, "--fps", 10, "--out", "f.gif")
        assert code == 0
        assert "steps 0 to 35, every 5, 8 frames in 0.8 s (5 times real time)" in told

    def test_seconds_are_the_length_of_the_film(self, capsys):
        _, told = shoal(
            capsys, "film", "oceans2020", "--seconds", 0.5, "--fps", 8, "--every", 3, "--size", 240, "--out", "f.gif"
        )
        assert "steps 0 to 9, every 3, 4 frames in 0.5 s" in told

    def test_a_still_of_a_step(self, capsys):
        code, told = shoal(capsys, "film", "oceans2020", "--step", 33, "--out", "s.png")
        assert code == 0
        assert "still: s.png, step 33, 720 x" in told

    def test_fields_are_set_as_for_a_run(self, capsys):
        code, _ = shoal(
            capsys, "film", "oceans2020", "--steps", 2, "--seed", 3, "--set", "fleets.BoB-1.sensor_radius=1",
            "--sensors", "--links", "--halos", "--panels", "--no-trails", "--size", 300, "--out", "f.mp4",
        )  # fmt: skip
        assert code == 0


BAD = [
    (["film", "oceans2020"], "--out"),
    (["film", "nope", "--out", "f.mp4"], "no preset and no file"),
    (["film", "oceans2020", "--out", "f.avi"], "does not end in .mp4, .gif or .png"),
    (["film", "oceans2020", "--out", "f.mp4", "--size", "big"], "--size big: is not a size"),
    (["film", "oceans2020", "--out", "f.mp4", "--size", "10x10"], "has a side of 10 pixels"),
    (["film", "oceans2020", "--out", "f.mp4", "--fps", "500"], "choose 1 to 60 frames"),
    (["film", "oceans2020", "--out", "f.mp4", "--steps", "0"], "--steps: is 0"),
    (["film", "oceans2020", "--out", "f.mp4", "--seconds", "-1"], "--seconds: is -1"),
    (["film", "oceans2020", "--out", "f.mp4", "--seconds", "1", "--steps", "9"], "give --seconds or --steps"),
    (["film", "oceans2020", "--out", "f.mp4", "--step", "9"], "--step: shows one step"),
    (["film", "oceans2020", "--out", "f.mp4", "--start", "99990", "--steps", "20"], "are more than the 100000"),
    (["film", "oceans2020", "--out", "f.mp4", "--sensors", "--steps", "2"], "sensor discs: have radius 0"),
    (
        ["film", "oceans2020", "--out", "f.mp4", "--links", "--set", "fleets.BoB-0.count=600"],
        "are kept of up to 512 agents",
    ),
    (["film", "full", "--out", "f.mp4"], "is not a record"),
    (["film", "full", "--out", "f.mp4", "--seed", "3"], "--seed: changes a scenario"),
]


@pytest.mark.parametrize(("tokens", "says"), BAD, ids=[" ".join(tokens[1:]) for tokens, _ in BAD])
def test_bad_input_gives_one_clear_error_and_leaves_nothing(capsys, tokens, says):
    Path("full").mkdir()
    code, told = shoal(capsys, *tokens)
    assert code == 2
    assert says in told
    assert told.count("shoal: ") == 1
    assert "fix:" in told
    assert [each.name for each in Path().iterdir()] == ["full"]
