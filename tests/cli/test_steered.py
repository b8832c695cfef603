"""shoal run of a log of changes: the steered run again, and what its record says."""

import json

import pytest

from shoal.cli.main import run_command
from shoal.run.change_log import ChangeLog, Entry, Logged
from shoal.run.changes import Change
from shoal.scenario.load import read_table, scenario_from


@pytest.fixture
def log(tmp_path):
    table = read_table("oceans2020")
    entries = tuple(Entry(step, Change(do="change", changes={"neighbors": 5 + step})) for step in range(3, 15))
    known = ChangeLog((Logged("oceans2020", table, scenario_from(table).hash),), entries, 20)
    (tmp_path / "log.jsonl").write_text(known.text(), encoding="utf-8")
    return str(tmp_path / "log.jsonl")


class TestSteered:
    def test_run_and_show_say_what_was_changed(self, log, tmp_path, capsys):
        assert run_command(["run", log, "--out", str(tmp_path / "r")]) == 0
        ran = capsys.readouterr().out
        assert run_command(["show", str(tmp_path / "r")]) == 0
        shown = capsys.readouterr().out
        for told in (ran, shown):
            assert "steered: 12 changes on the way, the first at step 3; above is what it began with" in told
            assert "step 3: neighbors = 8" in told
            assert "and 2 more, in changes.jsonl of the record" in told
        assert (tmp_path / "r" / "changes.jsonl").read_text() == (tmp_path / "log.jsonl").read_text()

    def test_json_says_it_too(self, log, capsys):
        assert run_command(["run", log, "--json"]) == 0
        told = json.loads(capsys.readouterr().out)
        assert told["steered"][0] == {"step": 3, "words": "neighbors = 8"}
        assert told["steps"] == 20

    @pytest.mark.parametrize("options", [["-k", "3"], ["--runs", "2"], ["--set", "strategy.delta=1"]])
    def test_it_is_run_as_it_was(self, log, options, capsys):
        assert run_command(["run", log, *options]) == 2
        assert "which is run as it was" in capsys.readouterr().err
