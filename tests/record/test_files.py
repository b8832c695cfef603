"""A record on disk is whole or not there."""

import errno
import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import RecordError
from shoal.record import files
from shoal.record.files import RecordFolder, open_record, save_record
from shoal.record.trajectory import TrajectoryWriter
from shoal.run.simulate import simulate

STEPS = 400


@pytest.fixture(scope="module")
def record():
    return simulate(scenario("oceans2020", {"steps": STEPS}), runs=3, every=100)


@pytest.fixture
def saved(record, tmp_path):
    save_record(record, tmp_path / "record")
    return tmp_path / "record"


def full_disk(*args, **options):
    raise OSError(errno.ENOSPC, "No space left on device")


def refusal(action, *args, **options):
    """(where, problem, fix) of the error."""
    with pytest.raises(RecordError) as caught:
        action(*args, **options)
    return caught.value.args


def left_in(folder):
    return sorted(path.name for path in folder.iterdir())


class TestRoundTrip:
    """What is opened is what was saved."""

    def test_every_number(self, record, saved):
        opened = open_record(saved)
        assert opened.facts == record.facts
        assert opened.scenario == record.scenario
        assert opened.provenance == record.provenance
        for one, other in zip(opened.tallies, record.tallies, strict=True):
            for part, expected in zip(one, other, strict=True):
                assert part.dtype == expected.dtype
                assert part.tobytes() == expected.tobytes()
        assert opened.summary() == record.summary()

    def test_every_frame(self, record, saved):
        opened = open_record(saved)
        assert opened.trajectories.keys() == record.trajectories.keys() == {0, 1, 2}
        for run, trajectory in record.trajectories.items():
            for name, values in trajectory.arrays().items():
                other = opened.trajectories[run].arrays()[name]
                assert (other.dtype, other.shape) == (values.dtype, values.shape)
                assert other.tobytes() == values.tobytes()

    def test_frames_stay_on_disk_until_they_are_used(self, saved):
        assert isinstance(open_record(saved).trajectories[0].x, np.memmap)

    def test_the_scenario_in_it_runs_again_to_the_same_numbers(self, record, saved):
        again = simulate(open_record(saved).scenario, runs=3)
        assert again.estimate("xi") == record.estimate("xi")

    def test_record_json_is_plain_json(self, record, saved):
        def refuse(constant):
            raise AssertionError(f"{constant} is not JSON")

        content = json.loads((saved / "record.json").read_text(encoding="utf-8"), parse_constant=refuse)
        assert content["summary"]["time_on_target"]["mean"] == record.estimate("time_on_target").mean

    def test_an_opened_record_can_be_saved_again(self, saved, tmp_path):
        save_record(open_record(saved), tmp_path / "copy")
        assert open_record(tmp_path / "copy").summary() == open_record(saved).summary()

    def test_a_sum_that_it_is_older_than_leaves_its_metrics_unknown_and_no_others(self, record, tmp_path):
        older = [tally._replace(cubes=np.full_like(tally.cubes, np.nan)) for tally in record.tallies]
        save_record(replace(record, tallies=tuple(older)), tmp_path / "older")
        with np.load(tmp_path / "older" / "tallies.npz") as arrays:
            assert "0.distance" in arrays
            assert "0.cubes" not in arrays
        opened = open_record(tmp_path / "older")
        assert np.isnan(opened.estimate("power").mean)
        assert opened.estimate("speed") == record.estimate("speed")
        assert opened.summary()["power"] == {"mean": None, "ci95": None, "runs": [None] * 3}

    def test_folders_on_the_way_are_made(self, record, tmp_path):
        save_record(record, tmp_path / "a" / "b" / "record")
        assert open_record(tmp_path / "a" / "b" / "record").facts == record.facts


class TestExistingFolder:
    """Nothing is overwritten."""

    def test_a_record_is_not_replaced(self, record, saved):
        before = (saved / "record.json").read_bytes()
        where, problem, _ = refusal(save_record, record, saved)
        assert (where, problem) == (str(saved), "exists already")
        assert (saved / "record.json").read_bytes() == before

    def test_nor_any_other_folder_or_file(self, record, tmp_path):
        (tmp_path / "folder").mkdir()
        (tmp_path / "folder" / "thesis.txt").write_text("years of work")
        (tmp_path / "file").write_text("more")
        for name in ("folder", "file"):
            assert refusal(save_record, record, tmp_path / name)[1] == "exists already"
        assert (tmp_path / "folder" / "thesis.txt").read_text() == "years of work"
        assert left_in(tmp_path) == ["file", "folder"]

    def test_an_empty_folder_is_filled(self, record, tmp_path):
        (tmp_path / "record").mkdir()
        save_record(record, tmp_path / "record")
        assert open_record(tmp_path / "record").facts == record.facts

    def test_simulate_asks_before_it_runs(self, saved):
        def too_late(done, total):
            raise AssertionError("it ran")

        refusal(simulate, scenario("oceans2020", {"steps": STEPS}), out=saved, progress=too_late)


class TestFailure:
    """Nothing that looks like a record is left."""

    @pytest.mark.parametrize("name", ["savez", "json"])
    def test_a_full_disk_at_the_end(self, record, tmp_path, monkeypatch, name):
        if name == "savez":
            monkeypatch.setattr(files.np, "savez", full_disk)
        else:
            monkeypatch.setattr(Path, "write_text", full_disk)
        where, problem, _ = refusal(save_record, record, tmp_path / "record")
        assert where == str(tmp_path / "record")
        assert problem == "cannot be written: No space left on device"
        assert left_in(tmp_path) == []

    @pytest.mark.parametrize(("runs", "jobs"), [(1, 1), (3, 1), (3, 2)])
    def test_a_full_disk_in_the_middle_of_a_run(self, tmp_path, monkeypatch, runs, jobs):
        append, calls = TrajectoryWriter.append, []

        def soon_full(self, part):
            calls.append(part)
            if len(calls) > 2:
                full_disk()
            append(self, part)

        monkeypatch.setattr(TrajectoryWriter, "append", soon_full)
        chosen = scenario("oceans2020", {"steps": 30_000})
        assert "No space left" in refusal(simulate, chosen, runs=runs, jobs=jobs, every=10, out=tmp_path / "record")[1]
        assert left_in(tmp_path) == []

    def test_an_error_that_is_not_the_disks(self, tmp_path):
        with pytest.raises(ZeroDivisionError), RecordFolder(tmp_path / "record"):
            raise ZeroDivisionError
        assert left_in(tmp_path) == []

    def test_a_folder_that_cannot_be_made(self, record, tmp_path):
        (tmp_path / "file").touch()
        assert "cannot be written" in refusal(save_record, record, tmp_path / "file" / "record")[1]
        assert left_in(tmp_path) == ["file"]

    def test_what_a_killed_process_left_is_no_obstacle(self, record, tmp_path):
        half = tmp_path / "record" / f".shoal-{'0' * 32}.partial" / "run-0000"
        half.mkdir(parents=True)
        (half / "x.npy").write_bytes(b"half")
        (tmp_path / "record" / ".shoal.lock").write_text("process 1")
        save_record(record, tmp_path / "record")
        assert left_in(tmp_path / "record") == [
            "record.json",
            "roster.npz",
            "run-0000",
            "run-0001",
            "run-0002",
            "tallies.npz",
        ]

    def test_a_folder_of_the_users_called_partial_is_left_alone(self, record, tmp_path):
        (tmp_path / "record.partial").mkdir()
        (tmp_path / "record.partial" / "thesis.txt").write_text("years of work")
        save_record(record, tmp_path / "record")
        assert (tmp_path / "record.partial" / "thesis.txt").read_text() == "years of work"


class TestTwoWriters:
    """Of one name: the first has it, the second is told so before its first step, and nothing is mixed."""

    def test_the_second_is_refused_while_the_first_runs(self, tmp_path):
        def refuse_another(done, total):
            said.append(refusal(simulate, scenario("oceans2020", {"steps": STEPS, "seed": 2}), out=tmp_path / "dup")[1])

        said = []
        first = simulate(
            scenario("oceans2020", {"steps": STEPS}), every=10, out=tmp_path / "dup", progress=refuse_another
        )
        assert said[0].startswith("is being written by process ")
        assert open_record(tmp_path / "dup").provenance["seed"] == 1
        alone = simulate(scenario("oceans2020", {"steps": STEPS}), every=10)
        assert first.tallies[0].on_target.tobytes() == alone.tallies[0].on_target.tobytes()
        assert first.trajectories[0].x.tobytes() == alone.trajectories[0].x.tobytes()
        assert left_in(tmp_path) == ["dup"]
        assert left_in(tmp_path / "dup") == ["record.json", "roster.npz", "run-0000", "tallies.npz"]


def cut(path, size):
    path.write_bytes(path.read_bytes()[:size])


DAMAGES = {
    "record.json cut short": lambda folder: cut(folder / "record.json", 300),
    "record.json empty": lambda folder: cut(folder / "record.json", 0),
    "record.json of something else": lambda folder: (folder / "record.json").write_text('{"a": 1}'),
    "record.json no object": lambda folder: (folder / "record.json").write_text("[1, 2]"),
    "record.json with facts of another shape": lambda folder: (folder / "record.json").write_text('{"facts": [1]}'),
    "record.json in bytes that are not text": lambda folder: (folder / "record.json").write_bytes(b"\xff\xfe\x00"),
    "roster.npz missing": lambda folder: (folder / "roster.npz").unlink(),
    "roster.npz cut short": lambda folder: cut(folder / "roster.npz", 500),
    "tallies.npz missing": lambda folder: (folder / "tallies.npz").unlink(),
    "tallies.npz empty": lambda folder: cut(folder / "tallies.npz", 0),
    "tallies.npz cut short": lambda folder: cut(folder / "tallies.npz", 500),
    "tallies.npz no zip": lambda folder: (folder / "tallies.npz").write_bytes(b"no zip at all"),
    "frames cut short": lambda folder: cut(folder / "run-0001" / "x.npy", 200),
    "frames missing": lambda folder: (folder / "run-0001" / "x.npy").unlink(),
    "frames empty": lambda folder: cut(folder / "run-0001" / "x.npy", 0),
    "frames of none": lambda folder: shutil.rmtree(folder / "run-0001") or (folder / "run-0001").mkdir(),
}


class TestDamage:
    """A damaged record is refused with one error, whatever is wrong."""

    @pytest.mark.parametrize(
        "damage",
        list(DAMAGES),
    )
    def test_is_found_at_the_door(self, saved, damage):
        DAMAGES[damage](saved)
        where, problem, _ = refusal(open_record, saved)
        assert where == str(saved)
        assert problem.startswith("is damaged")

    def test_another_folder_is_no_record(self, tmp_path):
        assert "is not a record" in refusal(open_record, tmp_path)[1]
        assert "is not a record" in refusal(open_record, tmp_path / "nowhere")[1]
