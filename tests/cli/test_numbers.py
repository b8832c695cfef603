"""Integer numbers are not rounded."""

import pytest

from shoal.cli.main import BAD_INPUT, run_command


@pytest.mark.parametrize(
    ("command", "option"),
    [
        (["run", "oceans2020"], "--seed"),
        (["run", "oceans2020"], "--runs"),
        (["run", "oceans2020"], "--fast"),
        (["sweep", "oceans2020"], "--max-runs"),
        (["compare", "knn-pso"], "--steps"),
        (["film", "oceans2020", "--out", "x.mp4"], "--every"),
        (["watch"], "--port"),
        (["replay", "oceans2020", "--out", "x.html"], "--frames"),
    ],
)
def test_a_broken_number_is_refused(command, option, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_command([*command, option, "1.5"]) == BAD_INPUT
    assert f"Invalid value for {option}: '1.5' is not a whole number" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())
