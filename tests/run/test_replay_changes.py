"""A steered run made again as one record: its bits, what its numbers are over, and what it says of itself."""

import json
from itertools import pairwise

import numpy as np
import pytest

from shoal.core.errors import RecordError, ScenarioError
from shoal.record.files import open_record
from shoal.run.change_log import ChangeLog, Entry, Logged, read_log
from shoal.run.changes import Add, Change, Drag, Kill, Restart
from shoal.run.replay_changes import planned, replay_changes
from shoal.run.settings import Settings
from shoal.run.simulate import simulate
from shoal.run.steered import SteeredRun
from shoal.scenario.load import load, read_table

TABLE = read_table("oceans2020")
STEPS = 90


def change(step, **changes):
    return Entry(step, Change(do="change", changes={name.replace("__", "."): each for name, each in changes.items()}))


STEERED = (
    change(10, neighbors=9),
    Entry(15, Restart(do="restart", seed=7)),
    change(0, target_speed=4.5),
    Entry(20, Kill(do="kill", agent=7)),
    Entry(20, Drag(do="drag", x=3.0, y=-2.0)),
    change(40, strategy="lattice"),
    change(70, strategy="knn-pso", strategy__delta=0.03),
)


def log(*entries, steps=STEPS):
    return ChangeLog((Logged("oceans2020", TABLE, Settings.of(TABLE).scenario.hash),), entries, steps)


def states(entries, steps=STEPS):
    """State before each step of the run that was steered so, from its last restart on."""
    run, found = SteeredRun(Settings.of(TABLE)), {}
    for step, steering in entries:
        while run.simulation.number < step:
            found[run.simulation.number] = {name: each.copy() for name, each in run.simulation.state().items()}
            run.advance(1)
        run.steer(steering)
        if isinstance(steering, Restart):
            found = {}
    while run.simulation.number < steps:
        found[run.simulation.number] = {name: each.copy() for name, each in run.simulation.state().items()}
        run.advance(1)
    return found


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    return replay_changes(log(*STEERED), every=1, out=tmp_path_factory.mktemp("steered") / "record")


class TestBits:
    def test_every_frame_is_the_state_of_the_steered_run(self, record):
        known, kept = states(STEERED), record.trajectories[0]
        assert kept.step.tolist() == list(range(STEPS)) == list(known)
        for name in ("x", "y", "vx", "vy", "neighbors"):
            assert np.array_equal(getattr(kept, name), [each[f"swarm.{name}"][:50] for each in known.values()])
        assert np.array_equal(kept.target_x[:, 0], [each["targets.x"][0] for each in known.values()])
        assert kept.neighbors[0, 0] == 9
        assert (kept.alive[19, 7], kept.alive[20, 7]) == (True, False)

    def test_an_unchanged_run_is_the_one_that_simulate_makes(self):
        again, plain = replay_changes(log(), every=1), simulate(load(TABLE, steps=STEPS), every=1)
        for name, values in plain.trajectories[0].arrays().items():
            assert again.trajectories[0].arrays()[name].tobytes() == values.tobytes()
        for one, other in zip(again.tallies[0], plain.tallies[0], strict=True):
            assert one.tobytes() == other.tobytes()
        assert (again.steered, again.provenance["scenario_hash"]) == ((), plain.provenance["scenario_hash"])


class TestNumbers:
    def test_they_are_over_all_steps_whatever_the_swarm_was_set_to(self, record):
        kept = record.trajectories[0]
        assert record.tallies[0].steps.sum() == STEPS
        assert record.estimate("time_on_target").mean == pytest.approx(kept.engaged.any(axis=1).mean())
        assert record.estimate("engaged").mean == pytest.approx(kept.engaged.sum(axis=1).mean())

    def test_each_batch_is_that_of_its_steps(self, record):
        batches = record.trajectories[0].engaged.sum(axis=1)
        edges = np.cumsum([0, *record.tallies[0].batch_steps]).astype(int)
        means = [batches[begin:end].mean() for begin, end in pairwise(edges)]
        assert record.of_batches("engaged", 0) == pytest.approx(means)

    def test_memory_that_a_strategy_has_not_is_0(self, record):
        stations = record.trajectories[0].memory["station_x"]
        assert not stations[:40].any()
        assert stations[41:70].any()


class TestWords:
    def test_the_record_on_disk_says_that_it_was_steered_and_how(self, record, tmp_path):
        assert [step for step, _ in record.steered] == [0, 20, 20, 40, 70]
        assert record.steered[1] == (20, "buoy 7 removed")
        assert record.steered[-1] == (70, "strategy = knn-pso, strategy.delta = 0.03")
        assert "steered: 5 changes" in repr(record)
        assert record.scenario.seed == 7

    def test_it_is_not_taken_for_a_run_of_its_scenario(self, record):
        assert record.provenance["scenario_hash"] != simulate(load(TABLE, steps=2)).provenance["scenario_hash"]
        assert "-steered-" in record.provenance["scenario_hash"]

    def test_the_log_lies_beside_it_and_is_guarded(self, tmp_path):
        folder = tmp_path / "record"
        replay_changes(log(change(3, neighbors=4), steps=5), out=folder)
        assert read_log(folder / "changes.jsonl").entries == log(change(3, neighbors=4)).entries
        text = (folder / "changes.jsonl").read_text()
        (folder / "changes.jsonl").write_text(text.replace('"neighbors": 4', '"neighbors": 5'))
        with pytest.raises(RecordError, match=r"changes\.jsonl is not what was written"):
            open_record(folder)

    def test_its_summary_is_json(self, record):
        assert json.loads(json.dumps(record.summary()))["steered"][0] == {"step": 0, "words": "target_speed = 4.5"}


class TestRefusals:
    @pytest.mark.parametrize(
        ("entry", "words"),
        [
            (change(5, fast=20), "changes fleets or the size of a report"),
            (change(5, strategy="shared-sighting"), "changes fleets or the size of a report"),
            (Entry(5, Add(do="add", x=0.0, y=0.0)), "changes fleets or the size of a report"),
        ],
    )
    def test_what_one_record_cannot_hold_is_refused_before_the_first_step(self, entry, words, tmp_path):
        with pytest.raises(ScenarioError, match=words):
            replay_changes(log(change(2, neighbors=4), entry), out=tmp_path / "record")
        assert not list(tmp_path.iterdir())

    def test_before_a_restart_fleets_may_change(self):
        settings, entries, _ = planned(log(change(5, fast=20), Entry(9, Restart(do="restart")), change(1, neighbors=3)))
        assert settings.scenario.counts == [20, 30]
        assert entries == (change(1, neighbors=3),)

    @pytest.mark.parametrize(("run", "steps", "words"), [(1, 9, "the log is of 1"), (0, 0, "without a step")])
    def test_a_run_that_is_not_there(self, run, steps, words):
        with pytest.raises(ScenarioError, match=words):
            replay_changes(log(steps=steps), run=run)
