"""A sweep computes what is missing, loses nothing, mixes nothing."""

import errno
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from types import SimpleNamespace

import pytest

import shoal
from commands import wait_until
from shoal.core.errors import RecordError, ScenarioError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.cells import make_cells
from shoal.experiments.design import Design, grid
from shoal.experiments.executors import in_threads
from shoal.experiments.results import aggregate, read_rows, seal
from shoal.experiments.rows import failed_row
from shoal.experiments.store import Store, _differences
from shoal.experiments.sweep import Progress, Stop, store_all, sweep

DESIGN = Design("oceans2020", tuple(grid({"neighbors": [10, 30], "fast": [0, 15]})), 2)
SHORT = {"steps": 300}
CELL = make_cells(DESIGN, SHORT)[0]


def stripped(rows):
    return [{name: value for name, value in row.items() if name not in ("started", "seconds")} for row in rows]


class TestSweep:
    def test_every_cell_has_every_run(self, tmp_path):
        rows = sweep(DESIGN, tmp_path, changes=SHORT)
        assert [(row["neighbors"], row["fast"], row["run"]) for row in rows] == [
            (k, fast, run) for k in (10, 30) for fast in (0, 15) for run in (0, 1)
        ]
        assert {row["status"] for row in rows} == {"done"}

    def test_a_second_call_computes_nothing(self, tmp_path):
        first = sweep(DESIGN, tmp_path, changes=SHORT)

        def refuse(tasks):
            assert list(tasks) == []
            return iter(())

        assert sweep(DESIGN, tmp_path, changes=SHORT, executor=refuse) == first

    def test_more_runs_and_values_are_added_to_what_is_there(self, tmp_path):
        few = sweep(DESIGN, tmp_path / "grown", changes=SHORT)
        more = Design("oceans2020", tuple(grid({"neighbors": [10, 20, 30], "fast": [0, 15]})), 3)
        grown = sweep(more, tmp_path / "grown", changes=SHORT)
        assert [row for row in grown if row["neighbors"] != 20 and row["run"] < 2] == few
        assert grown == sweep(more, tmp_path / "fresh", changes=SHORT)

    def test_what_is_compiled_before_the_first_run_does_not_count_in_the_time_left(self):
        progress = Progress(total=8, before=0, begun=time.monotonic() - 3600.0)
        done = CELL, 0, failed_row("of no interest") | {"seconds": 2.0}
        store_all(iter([done]), SimpleNamespace(add=lambda rows: None), progress, None)
        assert progress.rate == pytest.approx(0.5, rel=0.1)

    def test_run_r_of_every_cell_shares_its_chance(self, tmp_path):
        rows = sweep(DESIGN, tmp_path, changes=SHORT)
        assert {row["seed"] for row in rows} == {1}

    def test_independent_cells_have_seeds_of_their_own(self, tmp_path):
        rows = sweep(DESIGN, tmp_path, changes=SHORT, independent=True)
        assert len({row["seed"] for row in rows}) == 4

    def test_threads_do_not_change_the_table(self, tmp_path):
        one = sweep(DESIGN, tmp_path / "one", changes=SHORT, executor=in_threads(1))
        assert one == sweep(DESIGN, tmp_path / "three", changes=SHORT, executor=in_threads(3))

    def test_a_point_that_cannot_run_stops_the_sweep_before_it_begins(self, tmp_path):
        with pytest.raises(ScenarioError, match="neighbors=50"):
            sweep(Design("oceans2020", ({"neighbors": 3}, {"neighbors": 50}), 2), tmp_path / "new", changes=SHORT)
        assert not (tmp_path / "new").exists()


class TestStopRule:
    def test_replicates_are_added_until_the_interval_is_narrow_or_the_most_is_reached(self, tmp_path):
        design = Design("oceans2020", ({"neighbors": 20}, {"neighbors": 49}), 2)
        rows = sweep(design, tmp_path, changes={"steps": 2000}, until=Stop(width=0.05, most=9))
        for group in aggregate(rows, ["neighbors"]):
            width = group["time_on_target_high"] - group["time_on_target_low"]
            assert width <= 0.05 or group["runs"] == 9
            assert group["runs"] > 2


class TestFailures:
    STRATEGY = """
from typing import NamedTuple
import shoal
class Params(NamedTuple):
    spare: float = 0.0
@shoal.strategy("broken-{name}", params=Params)
def decide(me, heard, memory, params, draw):
    return heard.no_such_field, 0.0
"""

    def test_a_failed_run_is_a_row_with_its_error(self, tmp_path):
        file = tmp_path / "broken.py"
        file.write_text(self.STRATEGY.replace("{name}", "a"))
        rows = sweep(
            Design("oceans2020", ({"strategy": str(file)}, {"strategy": "knn-pso"}), 1), tmp_path / "s", changes=SHORT
        )
        status = {row["status"]: row for row in rows}
        assert set(status) == {"done", "failed"}
        assert "no_such_field" in status["failed"]["error"]

    def test_failed_runs_are_left_alone_unless_asked_for(self, tmp_path):
        file = tmp_path / "broken.py"
        file.write_text(self.STRATEGY.replace("{name}", "b"))
        design = Design("oceans2020", ({"strategy": str(file)},), 1)
        sweep(design, tmp_path / "s", changes=SHORT)
        asked = []

        def listen(tasks):
            asked.append(len(list(tasks)))
            return iter(())

        sweep(design, tmp_path / "s", changes=SHORT, executor=listen)
        sweep(design, tmp_path / "s", changes=SHORT, executor=listen, retry_failed=True)
        assert asked == [0, 1]


class TestStore:
    def test_another_scenario_is_refused_with_the_difference(self, tmp_path):
        sweep(DESIGN, tmp_path, changes=SHORT)
        with pytest.raises(RecordError, match=r"scenario\.steps: 300 then, 400 now"):
            sweep(DESIGN, tmp_path, changes={"steps": 400})

    def test_another_results_version_is_refused(self, tmp_path, monkeypatch):
        sweep(DESIGN, tmp_path, changes=SHORT)
        monkeypatch.setattr("shoal.experiments.sweep.RESULTS_VERSION", 99)
        with pytest.raises(RecordError, match=f"holds numbers of results version {RESULTS_VERSION}, which"):
            sweep(DESIGN, tmp_path, changes=SHORT)

    def test_a_second_writer_is_kept_out_with_a_clear_message(self, tmp_path):
        identity = {
            "scenario": {},
            "fields": [],
            "changes": {},
            "independent": False,
            "results_version": RESULTS_VERSION,
            "metrics": [],
        }
        with Store(tmp_path, identity):
            with pytest.raises(RecordError, match=f"is being written by process {os.getpid()}"):
                Store(tmp_path, identity).__enter__()
            assert read_rows(tmp_path) == ([], [])
        with Store(tmp_path, identity):
            pass
        assert [each.name for each in tmp_path.iterdir()] == ["runs.sqlite"]

    def test_a_file_system_without_locks_is_named_as_such(self, tmp_path, monkeypatch):
        def refuse(held, how):
            raise OSError(errno.ENOLCK, "No locks available")

        monkeypatch.setattr("fcntl.flock", refuse)
        with pytest.raises(
            RecordError, match=r"does not lock files \(No locks available\)\n  fix: use a folder on a loc"
        ):
            sweep(DESIGN, tmp_path / "new", changes=SHORT)
        assert not (tmp_path / "new").exists()

    def test_a_lock_of_another_program_is_not_taken_for_a_sweep(self, tmp_path, monkeypatch):
        sweep(DESIGN, tmp_path, changes=SHORT)
        monkeypatch.setattr("shoal.experiments.store._PATIENCE", 0.1)
        other = sqlite3.connect(tmp_path / "runs.sqlite", isolation_level=None)
        other.execute("PRAGMA journal_mode=DELETE")
        other.execute("BEGIN EXCLUSIVE")
        with pytest.raises(RecordError, match="is locked, though no sweep writes it"):
            sweep(DESIGN, tmp_path, changes=SHORT)
        other.close()

    def test_a_folder_of_other_things_is_refused_and_kept(self, tmp_path):
        (tmp_path / "results.csv").write_text("mine")
        with pytest.raises(RecordError, match="is not empty, and holds no sweep"):
            sweep(DESIGN, tmp_path, changes=SHORT)
        assert [each.name for each in tmp_path.iterdir()] == ["results.csv"]

    def test_a_database_of_something_else_is_refused_and_kept(self, tmp_path):
        database = sqlite3.connect(tmp_path / "runs.sqlite")
        database.execute("CREATE TABLE runs (distance)")
        database.close()
        before = (tmp_path / "runs.sqlite").read_bytes()
        with pytest.raises(RecordError, match="has not the tables of a sweep"):
            sweep(DESIGN, tmp_path, changes=SHORT)
        assert (tmp_path / "runs.sqlite").read_bytes() == before

    def test_it_is_plain_sqlite(self, tmp_path):
        sweep(DESIGN, tmp_path, changes=SHORT)
        database = sqlite3.connect(tmp_path / "runs.sqlite")
        assert database.execute(
            "SELECT count(*) FROM runs JOIN timing USING (run_id) WHERE seconds > 0"
        ).fetchone() == (8,)
        database.close()

    def test_a_folder_without_a_sweep_is_told_so(self, tmp_path):
        with pytest.raises(RecordError, match="holds no sweep"):
            read_rows(tmp_path)

    def test_results_load_as_a_data_frame(self, tmp_path):
        pytest.importorskip("pandas", reason="load_results needs pandas: pip install '.[sweep]'")
        sweep(DESIGN, tmp_path, changes=SHORT)
        frame = shoal.load_results(tmp_path)
        assert len(frame) == 8
        assert frame.groupby("fast").time_on_target.count().to_dict() == {0: 4, 15: 4}


SWEEP = [
    sys.executable,
    "-m",
    "shoal",
    "sweep",
    "oceans2020",
    "--vary",
    "neighbors=5:44:3",
    "--runs",
    "6",
    "--steps",
    "3000",
]


class TestKilled:
    """kill -9 of the whole process group at random moments: nothing finished is lost, nothing is there twice."""

    def test_resumed_after_every_kill_the_table_is_bit_identical(self, tmp_path):
        subprocess.run([*SWEEP, "--out", str(tmp_path / "whole")], check=True, capture_output=True)
        chance = random.Random(7)
        kills = 0
        while not (tmp_path / "killed" / "results.csv").exists():
            process = subprocess.Popen(
                [*SWEEP, "--out", str(tmp_path / "killed")],
                start_new_session=True,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            before = self.finished(tmp_path / "killed")
            wait = chance.uniform(0.6, 2.0) if kills < 8 else 60.0
            try:
                process.wait(wait)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()
                kills += 1
            assert before <= self.finished(tmp_path / "killed")
        assert kills > 0
        whole, killed = (tmp_path / name / "results.csv" for name in ("whole", "killed"))
        assert whole.read_bytes() == killed.read_bytes()

    @staticmethod
    def finished(folder):
        if not (folder / "runs.sqlite").exists():
            return set()
        database = sqlite3.connect(folder / "runs.sqlite")
        try:
            return {run_id for (run_id,) in database.execute("SELECT run_id FROM runs")}
        except sqlite3.OperationalError:  # killed before its tables were made
            return set()
        finally:
            database.close()

    def test_ctrl_c_keeps_what_is_done_and_tells_how_to_go_on(self, tmp_path):
        process = subprocess.Popen(
            [*SWEEP[:-1], "100000", "--out", str(tmp_path / "s")],
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        wait_until(process, (tmp_path / "s" / "runs.sqlite").exists)
        os.killpg(process.pid, signal.SIGINT)
        _, said = process.communicate(timeout=100)
        assert process.returncode == 130
        assert "the same command continues from there" in said
        assert "Traceback" not in said


class TestDask:
    @pytest.mark.slow
    def test_a_worker_killed_in_the_middle_changes_nothing(self, tmp_path):
        distributed = pytest.importorskip("distributed", reason="Dask is absent: pip install '.[cluster]'")
        from shoal.experiments.executors import on_dask

        design = Design("oceans2020", tuple(grid({"neighbors": list(range(5, 25))})), 2)
        long = {"steps": 20000}
        with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
            victim = next(iter(cluster.workers.values())).pid
            killed = []

            def kill_once(progress):
                if progress.done == 5 and not killed:
                    killed.append(victim)
                    os.kill(victim, signal.SIGKILL)

            rows = sweep(
                design,
                tmp_path / "dask",
                changes=long,
                executor=on_dask(cluster.scheduler_address),
                report=kill_once,
            )
        assert killed
        here = sweep(design, tmp_path / "here", changes=long)
        assert seal(tmp_path / "dask", rows).read_bytes() == seal(tmp_path / "here", here).read_bytes()


class TestIdentity:
    """What another version of Shoal added, and does not say anything, makes no other sweep."""

    @pytest.mark.parametrize(
        ("then", "now", "differ"),
        [
            ({"a": 1}, {"a": 1, "new": []}, False),
            ({"a": 1}, {"a": 1, "new": None}, False),
            ({"a": {"gone": {}}}, {"a": {}}, False),
            ({"a": 1}, {"a": 1, "new": 0.0}, True),
            ({"a": 0}, {"a": None}, True),
            ({"a": []}, {"a": [1]}, True),
        ],
    )
    def test_of_two_scenarios(self, then, now, differ):
        assert bool(_differences("scenario", then, now)) is differ
