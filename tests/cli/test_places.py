"""Where results go: checked before the first step, by every verb; nothing that Shoal did not make is lost for them."""

import os
import shutil
from pathlib import Path

import pytest

from shoal.cli.main import run_command
from shoal.run.simulation import Simulation

DATA = Path(__file__).parents[1] / "data"
TINY, RECORD, SWEEP = "tiny.toml", "record", "sweep"

FILES = {  # verb, with the option that names a file
    "run": (("run", TINY, "--figure"), ".png"),
    "run with a record": (("run", TINY, "--out", "new", "--figure"), ".svg"),
    "show": (("show", RECORD, "--figure"), ".pdf"),
    "replay of a record": (("replay", RECORD, "--out"), ".html"),
    "replay of a scenario": (("replay", TINY, "--out"), ".html"),
    "still": (("film", TINY, "--out"), ".png"),
    "gif": (("film", RECORD, "--fps", "5", "--out"), ".gif"),
    "mp4": (("film", RECORD, "--fps", "5", "--out"), ".mp4"),
    "plot": (("plot", SWEEP, "--out"), ".png"),
    "results": (("results", SWEEP, "--parquet"), ".parquet"),
    "compare": (("compare", "knn-pso", "--scenario", TINY, "--runs", "2", "--figure"), ".png"),
}
FOLDERS = {
    "run": ("run", TINY, "--out"),
    "watch": ("watch", TINY, "--no-browser", "--out"),
    "sweep": ("sweep", TINY, "--vary", "neighbors=1", "--runs", "1", "--out"),
    "compare": ("compare", "knn-pso", "--scenario", TINY, "--runs", "2", "--out"),
    "compare --suite": ("compare", "knn-pso", "--suite", "arena", "--runs", "1", "--steps", "5", "--out"),
    "reproduce": ("reproduce", "oceans2020", "--quick", "--out"),
}


@pytest.fixture(autouse=True)
def _own_folder(tmp_path, monkeypatch):
    """A folder with a scenario, a record and a sweep, as it was found."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(DATA / TINY, TINY)
    newest = max(DATA.glob("results-v*"))
    for name in (RECORD, SWEEP):
        shutil.copytree(newest / name, name)


@pytest.fixture
def no_step(monkeypatch):
    """Whatever is refused is refused before this."""

    def run(*_, **__):
        raise AssertionError("it ran")

    monkeypatch.setattr(Simulation, "__init__", run)


def everything():
    return {file: file.read_bytes() for file in Path().rglob("*") if file.is_file()}


def shoal(capsys, *tokens):
    """(exit code, stdout, stderr)."""
    code = run_command([str(token) for token in tokens])
    return code, *capsys.readouterr()


def refused(capsys, *tokens):
    """The one sentence, after nothing has happened."""
    before = everything()
    code, out, err = shoal(capsys, *tokens)
    assert (code, out) == (2, ""), err
    assert "Traceback" not in err
    assert len(err.splitlines()) == 2, err
    assert everything() == before
    return err


@pytest.mark.parametrize("verb", FILES)
class TestFiles:
    def test_a_place_where_none_can_be(self, verb, capsys, no_step):
        command, suffix = FILES[verb]
        Path("folder" + suffix).mkdir()
        Path("link" + suffix).symlink_to("folder" + suffix)
        for place in ("nowhere/x", "folder", "link", "/proc/x", TINY + "/x", "x" * 300):
            assert "cannot be written: " in refused(capsys, *command, place + suffix)

    def test_no_name_at_all(self, verb, capsys, no_step):
        for place in ("", ".", "/", ".."):
            refused(capsys, *FILES[verb][0], place)

    def test_a_file_of_the_users_is_kept_and_the_same_command_again_replaces_ours(self, verb, capsys, request):
        command, suffix = FILES[verb]
        Path("mine" + suffix).write_bytes(b"years of work" * 100)
        with request.getfixturevalue("monkeypatch").context() as patched:
            patched.setattr(Simulation, "__init__", None)
            assert "was not made by Shoal" in refused(capsys, *command, "mine" + suffix)
        for _ in range(2):
            code, _, err = shoal(capsys, *command, "ours" + suffix)
            assert code == 0, err
            shutil.rmtree("new", ignore_errors=True)
        assert Path("mine" + suffix).read_bytes() == b"years of work" * 100
        assert Path("ours" + suffix).stat().st_size > 100


@pytest.mark.parametrize("verb", FOLDERS)
class TestFolders:
    def test_a_place_where_none_can_be(self, verb, capsys, no_step):
        for place in (TINY, f"{TINY}/x", "/proc/x", "/dev/null", "x" * 300, "/", "."):
            refused(capsys, *FOLDERS[verb], place)

    def test_a_folder_of_other_things_is_kept(self, verb, capsys, no_step):
        Path("mine").mkdir()
        for name in ("results.csv", "report.html", "mine.partial", ".lock"):
            Path("mine", name).write_text("years of work")
        refused(capsys, *FOLDERS[verb], "mine")


@pytest.mark.parametrize("verb", ["run", "sweep", "compare"])
@pytest.mark.parametrize("place", ["new", "on/the/way", "empty", "link", "dangling", "a folder of ü"])
def test_places_that_work(verb, place, capsys):
    Path("empty").mkdir()
    Path("link").symlink_to("empty")
    Path("dangling").symlink_to("target")
    code, _, err = shoal(capsys, *FOLDERS[verb], place)
    assert code == 0, err
    made = {"run": ["record.json", "roster.npz", "run-0000", "tallies.npz"]}.get(verb, ["results.csv", "runs.sqlite"])
    assert sorted(os.listdir(place)) == made
    assert not [each for each in Path().rglob("*") if "partial" in each.name or "lock" in each.name]


def test_a_users_folder_called_partial_is_left_alone(capsys):
    Path("keep.partial").mkdir()
    Path("keep.partial/thesis.txt").write_text("precious")
    assert shoal(capsys, "run", TINY, "--out", "keep")[0] == 0
    assert Path("keep.partial/thesis.txt").read_text() == "precious"


def test_the_table_is_printed_before_a_figure_can_fail(capsys, monkeypatch):
    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("matplotlib.figure.Figure.savefig", fail)
    code, out, err = shoal(capsys, "run", TINY, "--figure", "x.png")
    assert code == 2
    assert "time on target" in out
    assert "No space left on device" in err


def test_a_figure_goes_into_the_folder_of_the_record(capsys):
    assert shoal(capsys, "run", TINY, "--out", "r", "--figure", "r/x.png")[0] == 0
    assert "x.png" in os.listdir("r")
    assert shoal(capsys, "show", "r")[0] == 0


def test_a_figure_and_a_record_of_one_name_are_refused(capsys, no_step):
    refused(capsys, "run", TINY, "--out", "x.png", "--figure", "x.png")


def test_failed_runs_are_not_passed_over_in_silence(capsys):
    Path("bad.py").write_text(
        "from typing import NamedTuple\nimport shoal\nclass P(NamedTuple):\n    spare: float = 0.0\n"
        '@shoal.strategy("always-fails", params=P)\ndef decide(me, heard, memory, params, draw):\n'
        "    return heard.no_such_field, 0.0\n"
    )
    assert shoal(capsys, *FOLDERS["sweep"][:2], "--vary", "strategy=bad.py", "--runs", "2", "--out", "s")[0] == 0
    code, out, err = shoal(capsys, "results", "s")
    assert (code, out) == (0, "")
    assert "all 2 runs failed and gave no numbers; the first: " in err
    assert "--retry-failed" in err
