"""The log of changes: what is read is what was written, and what is no log is refused in one sentence."""

import json

import pytest

from shoal.core.errors import ScenarioError
from shoal.core.version import RESULTS_VERSION
from shoal.run.change_log import ChangeLog, Entry, Logged, log_of, read_log, since_restart
from shoal.run.changes import Add, Change, Drag, Kill, Restart
from shoal.run.settings import Settings
from shoal.scenario.load import read_table

TABLE = read_table("oceans2020")
ENTRIES = (
    Entry(3, Change(do="change", changes={"neighbors": 9, "strategy.delta": 0.1 + 0.2})),
    Entry(8, Restart(do="restart", seed=2**64 - 1)),
    Entry(0, Kill(do="kill", agent=4)),
    Entry(5, Add(do="add", fleet=1, x=-1.5, y=2.0)),
    Entry(5, Drag(do="drag", x=1e-17, y=3.0)),
)


def log(entries=ENTRIES, step=9):
    return ChangeLog((Logged("oceans2020", TABLE, Settings.of(TABLE).scenario.hash),), tuple(entries), step)


def lines(text):
    return text.splitlines()


class TestText:
    def test_what_is_read_is_what_was_written(self, tmp_path):
        (tmp_path / "log.jsonl").write_text(log().text(), encoding="utf-8")
        assert read_log(tmp_path / "log.jsonl") == log()

    def test_a_line_is_a_change(self):
        first = json.loads(lines(log().text())[1])
        assert first == {"step": 3, "do": "change", "run": 0, "changes": {"neighbors": 9, "strategy.delta": 0.1 + 0.2}}

    def test_its_scenario_is_the_one_that_was_run(self):
        assert log_of(log().text()).settings(0).scenario == Settings.of(TABLE).scenario

    def test_another_scenario_of_this_name_is_refused(self):
        head, *rest = lines(log().text())
        other = {**json.loads(head)}
        other["runs"][0]["scenario"]["network"]["neighbors"] = 4
        with pytest.raises(ScenarioError, match="the log is of"):
            log_of("\n".join([json.dumps(other), *rest])).settings(0)

    def test_of_another_results_version_it_says_so(self):
        assert log().note is None
        assert f"this is {RESULTS_VERSION}" in log()._replace(results_version=1).note


class TestSteps:
    def test_what_counts_begins_at_the_last_restart(self):
        assert since_restart(ENTRIES) == 2
        assert since_restart(ENTRIES[:1]) == 0

    @pytest.mark.parametrize(("entries", "step", "last"), [(ENTRIES, 9, 9), (ENTRIES, 2, 5), (ENTRIES[:2], 1, 1)])
    def test_it_ends_where_it_was_written_or_with_its_last_change(self, entries, step, last):
        assert log(entries, step).last == last


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: "", "log:1: is not a line"),
        (lambda text: "[scenario]", "log:1: is not a line"),
        (lambda text: '{"format": 3}', "is not a log of changes"),
        (lambda text: text.replace('"shoal_changes": 1', '"shoal_changes": 99'), "is a log of format 99"),
        (lambda text: text.replace('"results_version"', '"results"'), "log:1: does not say what was run"),
        (lambda text: text.replace('"step": 3', '"step": -3'), "log:2: step is -3"),
        (lambda text: text.replace('"step": 3', '"step": true'), "log:2: step is True"),
        (lambda text: text + '{"step": 4, "do": "kill", "agent": 1}\n', "log:7: step is 4"),
        (lambda text: text.replace('"do": "kill"', '"do": "bless"'), "log:4"),
        (lambda text: text.replace('"agent": 4', '"agent": "all"'), "log:4 kill.agent"),
        (lambda text: text.replace('"do": "kill", "run": 0', '"do": "kill", "run": 1'), "a run that the log does not"),
        (lambda text: text + "{" * 5000, "log:7: is not a line"),
    ],
)
def test_what_is_no_log_is_refused(change, words):
    with pytest.raises(ScenarioError) as error:
        log_of(change(log().text()))
    assert words in str(error.value)
    assert "fix: " in str(error.value)


@pytest.mark.parametrize("content", [None, b"\xff\xfe\x00"])
def test_a_file_that_is_not_there_or_no_text_is_refused(tmp_path, content):
    file = tmp_path / "log.jsonl"
    if content:
        file.write_bytes(content)
    with pytest.raises(ScenarioError, match=r"log\.jsonl"):
        read_log(file)
