"""One run from outside: saved and restored, recorded, streamed and interrupted."""

import errno
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scenarios import scenario, small
from shoal.core.errors import RecordError, ScenarioError
from shoal.record.files import open_record
from shoal.run.facts import facts_of
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation, count_frames

SOON = 30.0  # [s] a busy machine may take that long
LONG = 50_000_000  # steps, minutes


def advanced(steps, changes=None, run=0):
    simulation = Simulation(scenario("oceans2020", changes), run)
    simulation.advance(steps)
    return simulation


def refusal(action, *args):
    with pytest.raises(RecordError) as caught:
        action(*args)
    return caught.value.args


class TestCheckpoint:
    """A saved state belongs to one scenario, seed and run."""

    @pytest.fixture
    def file(self, tmp_path):
        advanced(40).save(tmp_path / "state.npz")
        return tmp_path / "state.npz"

    @pytest.mark.parametrize(
        ("changes", "run"),
        [({"network.neighbors": 5}, 0), ({"seed": 2}, 0), ({}, 1), ({"steps": 77}, 0), ({"strategy.delta": 0.02}, 0)],
    )
    def test_of_another_one_is_refused(self, file, changes, run):
        other = advanced(3, changes, run)
        before = other.swarm.x.tobytes()
        where, problem, _ = refusal(other.restore, file)
        assert where == str(file)
        assert "was saved by" in problem
        assert (other.number, other.swarm.x.tobytes()) == (3, before)

    def test_of_the_same_under_another_name_is_taken(self, file):
        other = advanced(0, {"name": "other", "description": "words"})
        other.restore(file)
        assert other.number == 40

    def test_is_one_file_and_nothing_else(self, file):
        assert [path.name for path in file.parent.iterdir()] == ["state.npz"]

    def test_replaces_the_one_before(self, file):
        advanced(60).save(file)
        simulation = advanced(0)
        simulation.restore(file)
        assert simulation.number == 60

    def test_a_missing_file_is_named(self, tmp_path):
        assert refusal(advanced(0).restore, tmp_path / "nowhere.npz")[0] == str(tmp_path / "nowhere.npz")

    @pytest.mark.parametrize("size", [0, 999])
    def test_a_file_cut_short_is_refused(self, file, size):
        file.write_bytes(file.read_bytes()[:size])
        assert "is not a saved state" in refusal(advanced(0).restore, file)[1]

    def test_a_file_of_something_else_is_refused(self, file):
        file.write_text("something else")
        assert "is not a saved state" in refusal(advanced(0).restore, file)[1]
        np.savez(file, a=1)
        assert "is not a saved state" in refusal(advanced(0).restore, file)[1]

    def test_a_full_disk_leaves_the_old_one(self, file, monkeypatch):
        def full_disk(stream, **arrays):
            stream.write(b"half of it")
            raise OSError(errno.ENOSPC, "No space left on device")

        before = file.read_bytes()
        monkeypatch.setattr(np, "savez", full_disk)
        assert "No space left" in refusal(advanced(60).save, file)[1]
        assert file.read_bytes() == before
        assert [path.name for path in file.parent.iterdir()] == ["state.npz"]

    def test_a_folder_that_is_not_there_is_named(self, tmp_path):
        assert refusal(advanced(0).save, tmp_path / "nowhere" / "state.npz")[0].endswith("state.npz")


BEYOND = """
from shoal import Simulation
from shoal.scenario.load import read_table, scenario_from
simulation = Simulation(scenario_from({**read_table("oceans2020"), "steps": 20}))
simulation.advance(20)
simulation.advance(30)
assert simulation.number == simulation.tally.steps.sum() == 50, simulation.tally.steps
"""


class TestAdvance:
    """Any number of steps."""

    def test_beyond_the_steps_of_the_scenario_is_counted_too(self):
        """In a process of its own: it may crash."""
        done = subprocess.run([sys.executable, "-c", BEYOND], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr

    def test_by_nothing_changes_nothing(self):
        simulation = advanced(10)
        before = simulation.swarm.x.tobytes()
        simulation.advance(0)
        assert (simulation.number, simulation.swarm.x.tobytes()) == (10, before)


class TestFrames:
    """Which steps are kept."""

    @given(first=st.integers(0, 200), more=st.integers(0, 200), every=st.integers(1, 60), tail=st.integers(0, 500))
    def test_are_counted_before_they_are_filled(self, first, more, every, tail):
        kept = [number for number in range(first, first + more) if number % every == 0 or number >= tail]
        assert count_frames(first, first + more, every, tail) == len(kept)

    def test_none_unless_asked_for(self):
        assert Simulation(scenario()).advance(10) is None

    def test_none_where_no_step_is_due(self):
        simulation = advanced(1)
        assert simulation.advance(10, every=1000) is None

    def test_have_the_shapes_they_promise(self):
        frames = Simulation(scenario("oceans2020", {"targets.0.speed": 1.0})).advance(10, every=2)
        assert {part.shape for part in (frames.x, frames.vy, frames.on_target, frames.memory["repulsion"])} == {(5, 50)}
        assert {part.shape for part in (frames.target_x, frames.target_present)} == {(5, 1)}
        assert (frames.step.dtype, frames.on_target.dtype) == (np.int64, np.bool_)

    def test_on_target_is_that_of_the_same_frame(self):
        frames = Simulation(scenario("oceans2020", {"fleets.0.sensor_radius": 0.5})).advance(300, every=1)
        reach = np.where(np.arange(50) < 15, 1.5, 1.0)
        distance = np.hypot(frames.x - frames.target_x, frames.y - frames.target_y)
        assert (frames.on_target == (distance <= reach)).all()
        assert frames.on_target.any()


class TestStreaming:
    """Frames that go to disk chunk by chunk are those that stay in memory."""

    @pytest.mark.parametrize("every", [None, 1, 7, 10**6])
    def test_the_same_frames(self, tmp_path, every):
        chosen = scenario("oceans2020", {"steps": 8_000})  # several chunks
        kept = simulate(chosen, runs=2, jobs=2, every=every)
        streamed = simulate(chosen, runs=2, jobs=2, every=every, out=tmp_path / "record")
        opened = open_record(tmp_path / "record")
        assert kept.trajectories.keys() == streamed.trajectories.keys() == ({0} if every is None else {0, 1})
        for run, trajectory in kept.trajectories.items():
            for name, values in trajectory.arrays().items():
                assert values.tobytes() == streamed.trajectories[run].arrays()[name].tobytes(), name
                assert values.tobytes() == opened.trajectories[run].arrays()[name].tobytes(), name

    def test_the_overview_has_a_fixed_number_of_frames_and_every_last_step(self):
        record = simulate(scenario("oceans2020", {"steps": 20_000}), runs=2)
        assert list(record.trajectories) == [0]
        steps = record.trajectories[0].step
        assert steps[-300:].tolist() == list(range(19_700, 20_000))
        assert 500 <= steps.size <= 800
        assert set(np.diff(steps[:490]).tolist()) == {40}

    def test_a_run_shorter_than_the_overview_is_kept_whole(self):
        assert simulate(small(3, 1, {"steps": 25})).trajectories[0].step.tolist() == list(range(25))

    def test_the_numbers_do_not_depend_on_it(self, tmp_path):
        chosen = scenario("oceans2020", {"steps": 4_000})
        records = [
            simulate(chosen, every=every, out=out) for every, out in ((None, None), (3, None), (9, tmp_path / "r"))
        ]
        assert len({tuple(record.estimate("xi").runs) for record in records}) == 1


class TestProgress:
    """Told from time to time."""

    @pytest.mark.parametrize("jobs", [1, 2])
    def test_counts_up_to_all_steps_of_all_runs(self, jobs):
        told = []
        simulate(scenario("oceans2020", {"steps": 9_000}), runs=3, jobs=jobs, progress=lambda *now: told.append(now))
        done = [steps for steps, _ in told]
        assert done == sorted(done)
        assert done[-1] == 27_000
        assert {total for _, total in told} == {27_000}
        assert len(told) > 3

    @pytest.mark.parametrize("options", [{"runs": 0}, {"runs": -1}, {"jobs": 0}, {"every": 0}])
    def test_nothing_to_do_is_refused(self, options):
        with pytest.raises(ScenarioError, match="ask for 1 or more"):
            simulate(scenario(), **options)


class TestInterrupt:
    """Ctrl-C is heard within a second, in any thread, and leaves nothing."""

    @staticmethod
    def ending(is_time, **options):
        """Seconds from a KeyboardInterrupt in the progress callback to the end of simulate."""
        raised = []

        def interrupt(done, total):
            if not raised and is_time(done):
                raised.append(time.perf_counter())
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            simulate(scenario("oceans2020", {"steps": LONG}), progress=interrupt, **options)
        return time.perf_counter() - raised[0]

    @pytest.mark.parametrize("every", [None, 100])
    def test_of_one_run(self, tmp_path, every):
        assert self.ending(lambda done: done > 10_000, every=every, out=tmp_path / "record") < SOON
        assert list(tmp_path.iterdir()) == []

    @pytest.mark.parametrize("thread", ["_0", "_1"])
    def test_of_several_runs_in_whichever_thread(self, tmp_path, thread):
        def is_time(done):
            return threading.current_thread().name.endswith(thread)

        assert self.ending(is_time, runs=4, jobs=2, out=tmp_path / "record") < SOON
        assert list(tmp_path.iterdir()) == []


class TestFacts:
    """What metrics are told."""

    def test_are_those_of_the_scenario(self):
        facts = facts_of(scenario("oceans2020", {"area.width": 40.0}))
        assert facts.fleets == ("BoB-1", "BoB-0")
        assert facts.counts == (15, 35)
        assert facts.max_speeds == (2.6, 1.0)
        assert (facts.unit, facts.time_step) == (2.0, 0.1)


def test_its_repr_says_how_far_it_is():
    simulation = Simulation(scenario("oceans2020", {"steps": 50}), run=2)
    simulation.advance(7)
    assert repr(simulation) == "<Simulation of oceans2020, run 2: step 7 of 50>"
