"""What a record keeps, as a scene and frames."""

import math

import numpy as np
import pytest

from frames import decode, same_number
from scenarios import scenario
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.viewer.recorded import recorded_frames, recorded_scene

STEPS = 2000


@pytest.fixture(scope="module")
def record():
    return simulate(scenario(changes={"steps": STEPS}), every=1)


def frames(record, *indices, run=0):
    return [decode(each) for each in recorded_frames(record, run, np.array(indices))]


class TestRecordedFrames:
    def test_they_are_the_state_that_was_kept(self, record):
        kept = record.trajectories[0]
        (frame,) = frames(record, 700)
        assert (frame.step, frame.run, frame.epoch) == (700, 0, 0)
        for name in ("x", "y", "vx", "vy"):
            assert getattr(frame, name) == [float(np.float32(each)) for each in getattr(kept, name)[700]]
        assert frame.on_target == list(kept.on_target[700])
        assert frame.repulsion == [float(np.float32(each)) for each in kept.memory["repulsion"][700]]
        assert frame.degree == [20] * 50

    def test_time_on_target_is_that_of_the_steps_before(self, record):
        """At the ends of the timeline's windows, which are 2 steps long here."""
        watched = record.trajectories[0].on_target.any(axis=1)
        for step in (2, 500, 1500, 1998):
            (frame,) = frames(record, step)
            assert same_number(frame.time_on_target, watched[:step].mean())
            assert same_number(frame.recent, watched[max(0, step - 1000) : step].mean())

    def test_xi_is_that_of_the_steps_before(self, record):
        """At the ends of the 20 batches, where a record knows the sums."""
        for step in (100, 1000, 1900):
            (frame,) = frames(record, step)
            run = Simulation(scenario(changes={"steps": STEPS}))
            run.advance(step)
            assert same_number(frame.xi, evaluate("xi", run.tally, facts_of(run.scenario))[0])

    def test_between_batches_it_lies_between(self, record):
        before, between, after = (frame.xi for frame in frames(record, 300, 350, 400))
        assert min(before, after) < between < max(before, after)

    def test_xi_of_one_frame_is_its_fluctuation_over_the_mean_top_speed(self, record):
        kept, (frame,) = record.trajectories[0], frames(record, 700)
        velocity = np.stack([kept.vx[700], kept.vy[700]])
        fluctuation = np.hypot(*(velocity - velocity.mean(axis=1, keepdims=True))).mean()
        assert same_number(frame.xi_now, fluctuation / ((15 * 2.6 + 35 * 1.0) / 50))

    def test_phi_counts_everybody(self, record):
        (frame,) = frames(record, 700)
        assert sum(frame.phi) == 50
        assert frame.engaged == sum(frame.on_target)

    def test_before_the_first_step_there_is_no_mean(self, record):
        (frame,) = frames(record, 0)
        assert math.isnan(frame.time_on_target)
        assert math.isnan(frame.xi)

    def test_the_lost_are_not_there(self):
        lost = simulate(scenario(changes={"steps": 40, "losses": [{"step": 20, "count": 10}]}), every=1)
        before, after = frames(lost, 19, 20)
        assert (sum(before.alive), sum(after.alive)) == (50, 40)
        assert (sum(before.phi), sum(after.phi)) == (50, 40)

    def test_a_dived_target_has_no_phi(self):
        diving = {"kind": "walk", "radius": 1.0, "speed": 1.0, "surface_time": 1e-9, "dive_time": 1e9}
        (frame,) = frames(simulate(scenario(changes={"steps": 10, "targets": [diving]}), every=1), 5)
        assert frame.present == [False]
        assert all(math.isnan(each) for each in frame.phi)

    def test_fleets_may_hear_differently_many(self):
        heard = simulate(scenario(changes={"steps": 5, "fleets.0.neighbors": "all"}), every=1)
        assert frames(heard, 0)[0].degree == [49] * 15 + [20] * 35

    def test_a_strategy_that_hears_all_hears_all(self):
        heard = simulate(scenario(changes={"steps": 5, "strategy": {"name": "global-pso"}}), every=1)
        assert frames(heard, 0)[0].degree == [49] * 50


class TestRecordedScene:
    def test_its_metrics_are_the_records_with_their_intervals(self, record):
        told = {metric["name"]: metric for metric in recorded_scene(record, 0)["metrics"]}
        value = record.estimate("time_on_target")
        assert told["time_on_target"] == {
            "name": "time_on_target",
            "label": "time on target",
            "unit": "share",
            "sentence": record.metrics["time_on_target"].sentence,
            "least": 0.0,
            "most": 1.0,
            "mean": value.mean,
            "low": value.ci95[0],
            "high": value.ci95[1],
        }

    def test_its_history_is_that_of_the_batches(self, record):
        history = recorded_scene(record, 0)["history"]
        assert history["step"] == list(range(0, STEPS, STEPS // 20))
        watched = record.trajectories[0].on_target.any(axis=1).reshape(20, -1)
        assert history["values"]["time_on_target"] == pytest.approx(list(watched.mean(axis=1)))
        assert len(history["values"]["xi"]) == 20

    def test_what_can_be_charted_is_what_a_table_lists_and_varies(self, record):
        told = recorded_scene(record, 0)
        names = [each["name"] for each in told["series"]]
        assert names[:3] == ["time_on_target", "xi", "engaged"]
        assert set(names) == {name for name in record.listed() if not record.metrics[name].once}
        assert list(told["history"]["values"]) == names
