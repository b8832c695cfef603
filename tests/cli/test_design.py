"""shoal design: the front, the page for who buys, and what it says of bad input."""

import json
import re
from pathlib import Path

import pytest

from commands import shoal
from shoal.cli.main import BAD_INPUT

FLEETS = ("design", "oceans2020", "--fleet", "BoB-1=0:30@3", "--fleet", "BoB-0=0:45@1")
SHORT = ("--vary", "neighbors=4:40", "--steps", 100, "--trials", 14, "--runs", 2, "--final-runs", 3)


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_the_front_a_figure_a_page_and_the_same_again_without_a_run(capsys):
    words = (*FLEETS, *SHORT, "--out", "kept")
    code, out, _ = shoal(capsys, *words, "--figure", "f.svg", "--report", "r.html")
    assert code == 0
    assert re.search(r"^ *80 +15 +35 +20 .*present", out, flags=re.MULTILINE)
    assert "times the area (hypervolume)" in out
    assert Path("f.svg").read_text(encoding="utf-8").startswith("<?xml")
    page = Path("r.html").read_text(encoding="utf-8")
    assert re.findall(r'(?:src|href)="(?!data:)', page) == []
    assert "url(" not in page
    assert "<script" not in page
    again = shoal(capsys, *words, "--json")
    found = json.loads(again[1])
    assert again[2].count("runs/s") == 0
    assert all(each["cost"] == 3 * each["BoB-1"] + each["BoB-0"] for each in found["fleets"])
    assert all(each["neighbors"] < each["BoB-1"] + each["BoB-0"] for each in found["fleets"])
    assert [each["cost"] for each in found["fleets"]] == sorted(each["cost"] for each in found["fleets"])


def test_of_the_bay_at_its_own_costs(capsys):
    pytest.importorskip("shapely", reason="land needs the extra maritime")
    words = ("--steps", 20, "--trials", 3, "--runs", 1, "--final-runs", 2, "--json")
    code, out, _ = shoal(capsys, "design", "bay", "--fleet", "fast=0:12", "--fleet", "slow=0:24@9000", *words)
    assert code == 0
    assert all(each["cost"] == 30000 * each["fast"] + 9000 * each["slow"] for each in json.loads(out)["fleets"])


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("design", "oceans2020"), "--fleet: is missing"),
        (("design", "oceans2020", "--fleet", "Bob-1=0:30@3"), "did you mean 'BoB-1'"),
        (("design", "oceans2020", "--fleet", "BoB-1=0:30@3"), "fleet BoB-0: has no cost"),
        (("design", "oceans2020", "--fleet", "BoB-1=30:0@3"), "30 to 0 agents"),
        ((*FLEETS, "--maximize", "time"), "is not a metric"),
        ((*FLEETS, "--maximize", "cost"), "lower is better"),
        ((*FLEETS, "--minimize", "time_on_target"), "higher is better"),
        ((*FLEETS, "--vary", "fast=3:5"), "twice"),
        ((*FLEETS, "--vary", "neighbors=4:4"), "one value only"),
        ((*FLEETS, "--report", "nowhere/r.html"), "there is no folder nowhere"),
    ],
)
def test_bad_input_is_one_message_and_nothing_is_written(words, told, capsys):
    code, out, err = shoal(capsys, *words)
    assert (code, out) == (BAD_INPUT, "")
    assert told in err
    assert err.count("fix:") == 1
    assert not list(Path().iterdir())
