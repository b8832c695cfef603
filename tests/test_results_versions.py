"""Records and stores of every results version open, for ever; see tests/data/README.md."""

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from shoal.cli.main import run_command
from shoal.core.errors import RecordError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.results import aggregate, read_rows
from shoal.metrics.summary import METRICS
from shoal.record.files import open_record, save_record
from shoal.run.simulate import simulate
from shoal.scenario.load import load

DATA = Path(__file__).parent / "data"
VERSIONS = sorted(int(each.name.removeprefix("results-v")) for each in DATA.glob("results-v*"))


@pytest.fixture(params=VERSIONS)
def version(request):
    return request.param


@pytest.fixture
def kept(version, tmp_path):
    """Copies: SQLite writes beside what it reads."""
    return shutil.copytree(DATA / f"results-v{version}", tmp_path / "kept")


def shoal(capsys, *tokens):
    """(exit code, stdout, stderr)."""
    code = run_command([str(token) for token in tokens])
    return code, *capsys.readouterr()


def test_every_version_is_kept():
    assert list(range(1, RESULTS_VERSION + 1)) == VERSIONS, "run tests/data/make_results.py, see README.md there"


def test_a_change_that_moves_a_number_says_so():
    """By another RESULTS_VERSION, a line in the changelog, and records of it beside these; see tests/data/README.md."""
    kept = open_record(DATA / f"results-v{RESULTS_VERSION}" / "record")
    today = simulate(load(str(DATA / "tiny.toml")), runs=2)
    for before, now in zip(kept.tallies, today.tallies, strict=True):
        for name in before._fields:
            np.testing.assert_allclose(getattr(now, name), getattr(before, name), rtol=1e-9, atol=1e-9, err_msg=name)
    for name, values in kept.trajectories[0].arrays().items():
        np.testing.assert_allclose(today.trajectories[0].arrays()[name], values, rtol=1e-9, atol=1e-9, err_msg=name)


@pytest.mark.parametrize("name", ["record", "every"])
class TestRecords:
    def test_the_numbers_are_those_that_were_written(self, kept, version, name):
        record = open_record(kept / name)
        assert record.provenance["results_version"] == version
        written = json.loads((kept / name / "record.json").read_text())["summary"]
        for metric in METRICS.keys() & written.keys():
            now = [None if np.isnan(value) else value for value in record.estimate(metric).runs]
            assert now == written[metric]["runs"]
        assert [step.step.tolist() for step in record.trajectories.values()] == [list(range(8))]

    def test_it_is_shown_drawn_and_played_and_the_version_is_told(self, kept, version, name, capsys, tmp_path):
        for command in (
            ("show", kept / name, "--figure", tmp_path / "f.png"),
            ("film", kept / name, "--out", tmp_path / "s.png"),
            ("replay", kept / name, "--out", tmp_path / "p.html"),
        ):
            code, _, err = shoal(capsys, *command)
            assert code == 0, err
            assert (f"are of results version {version}; this Shoal" in err) == (version < RESULTS_VERSION)

    def test_it_can_be_saved_again_and_stays_of_its_version(self, kept, version, name, tmp_path):
        before = open_record(kept / name)
        save_record(before, tmp_path / "copy")
        after = open_record(tmp_path / "copy")
        assert after.provenance["results_version"] == version
        assert after.summary() == before.summary()


class TestFormat2:
    """A record of the format before, whose frames say less: what it does not hold is derived, or said to be missing."""

    @pytest.fixture
    def older(self, tmp_path):
        return shutil.copytree(DATA / "format-2" / "record", tmp_path / "older")

    def test_what_can_be_derived_is_what_the_engine_says_today(self, older):
        kept = open_record(older)
        today = simulate(load(kept.scenario), runs=2, every=1)  # with the lengths of its strategy, which it spells out
        frames, now = kept.trajectories[0], today.trajectories[0]
        for name in ("x", "engaged", "neighbors"):
            np.testing.assert_allclose(getattr(frames, name), getattr(now, name), rtol=1e-9, err_msg=name)
        for name, values in today.roster._asdict().items():
            assert np.array_equal(getattr(kept.roster, name), values), name

    def test_links_are_not_made_up(self, older, capsys, tmp_path):
        code, _, err = shoal(capsys, "film", older, "--out", tmp_path / "s.png", "--links")
        assert code == 2
        assert "keep no links: an older Shoal wrote them" in err
        assert shoal(capsys, "replay", older, "--out", tmp_path / "p.html")[0] == 0
        assert '"has_links":false' in (tmp_path / "p.html").read_text()

    def test_it_can_be_saved_again_in_the_format_of_today(self, older, tmp_path):
        before = open_record(older)
        save_record(before, tmp_path / "copy")
        after = open_record(tmp_path / "copy")
        assert json.loads((tmp_path / "copy" / "record.json").read_text())["format"] == 3
        for name, values in before.trajectories[0].arrays().items():
            assert np.array_equal(after.trajectories[0].arrays()[name], values), name

    def test_its_scenario_is_a_scenario(self, older):
        scenario = open_record(older).scenario
        assert (scenario.name, scenario.agents, scenario.network.neighbors) == ("tiny", 5, 2)
        today = load(str(DATA / "tiny.toml"))
        for part in (
            "area",
            "network",
            "motion",
            "targets",
            "steps",
            "seed",
        ):  # lengths of a strategy follow since then
            assert getattr(scenario, part) == getattr(today, part)


@pytest.mark.parametrize("name", ["sweep", "compare"])
class TestStores:
    def test_the_numbers_are_those_that_were_written(self, kept, version, name):
        fields, rows = read_rows(kept / name)
        with (kept / name / "results.csv").open(newline="") as stream:
            written = list(csv.DictReader(stream))
        assert len(rows) == len(written) == {"sweep": 8, "compare": 6}[name]
        for row, told in zip(rows, written, strict=True):
            assert row["results_version"] == version
            for column in [*fields, *METRICS.keys() & told.keys()]:
                assert ("" if row[column] is None else str(row[column])) == told[column]
        assert sum(group["runs"] for group in aggregate(rows, fields)) == len(rows)

    def test_it_is_shown_and_the_version_is_told(self, kept, version, name, capsys, tmp_path):
        code, out, err = shoal(capsys, "results", kept / name)
        assert code == 0
        assert "knn-pso" in out
        assert (f"are of results version {version}; this Shoal" in err) == (version < RESULTS_VERSION)

    def test_an_older_one_is_not_resumed(self, kept, version, name):
        from shoal.experiments.store import Store

        if version == RESULTS_VERSION:
            pytest.skip("of today")
        before = (kept / name / "runs.sqlite").read_bytes()
        identity = {"results_version": RESULTS_VERSION}
        with pytest.raises(RecordError, match=f"holds numbers of results version {version}, which this Shoal"):
            Store(kept / name, identity).__enter__()
        assert (kept / name / "runs.sqlite").read_bytes() == before


def test_a_sweep_of_today_goes_on_whatever_metrics_it_knew(kept, version, capsys):
    """Its store has a list of metrics in its identity, as all once had."""
    if version < RESULTS_VERSION:
        pytest.skip("older")
    command = ("sweep", DATA / "tiny.toml", "--vary", "neighbors=2,3", "--vary", "strategy=knn-pso,lattice")
    before = read_rows(kept / "sweep")[1]
    code, _, err = shoal(capsys, *command, "--runs", 3, "--out", kept / "sweep", "--jobs", 1)
    assert code == 0, err
    after = read_rows(kept / "sweep")[1]
    assert [row for row in after if row["run"] < 2] == before
    assert len(after) == 12


def test_an_older_sweep_is_drawn(kept, capsys, tmp_path):
    code, _, err = shoal(capsys, "plot", kept / "sweep", "--out", tmp_path / "p.png")
    assert code == 0, err
    assert (tmp_path / "p.png").stat().st_size > 1000
