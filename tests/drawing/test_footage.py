"""Specification of footage: the run as it is, and what is counted on it agrees with the engine."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.drawing.film_charts import phi_of_frames
from shoal.drawing.footage import footage, present
from shoal.record.frames import watching
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation

SENSORS = {"fleets.0.sensor_radius": 1.0}


class TestFootage:
    def test_its_frames_are_those_of_the_run(self):
        whole = simulate(scenario(changes={"steps": 60}), every=1)
        part = footage(scenario(), 20, start=40)
        assert part.trajectories[0].step.tolist() == list(range(40, 60))
        assert np.array_equal(part.trajectories[0].x, whole.trajectories[0].x[40:])

    def test_progress_ends_at_the_last_step(self):
        told = []
        footage(scenario(), 30, progress=lambda done, total: told.append((done, total)))
        assert told[-1] == (30, 30)

    def test_more_steps_than_the_scenario_has(self):
        with pytest.raises(ScenarioError, match="are more than the 100000"):
            footage(scenario(), 10, start=99_995)


class TestPresent:
    """The state of a simulation, as the record of its run has it."""

    def test_it_is_the_frame_that_a_record_would_keep(self):
        record = simulate(scenario(changes={"steps": 60}), every=1)
        simulation = Simulation(scenario(changes={"steps": 60}))
        simulation.advance(45)
        now = present(simulation).trajectories[0]
        for name, values in record.trajectories[0].arrays().items():
            assert np.array_equal(now.arrays()[name][0], values[45]), name

    def test_the_simulation_stays_as_it_is(self):
        one, other = Simulation(scenario()), Simulation(scenario())
        one.advance(30)
        other.advance(30)
        present(one)
        one.advance(30)
        other.advance(30)
        assert all(np.array_equal(one.state()[name], other.state()[name]) for name in one.state())

    def test_a_simulation_at_its_end_has_a_present_too(self):
        simulation = Simulation(scenario(changes={"steps": 20}))
        simulation.advance(20)
        assert present(simulation).trajectories[0].step.tolist() == [20]


class TestWatching:
    """Who is on target, counted on frames, is who the engine counted."""

    @pytest.mark.parametrize("changes", [{}, SENSORS], ids=["discs of the target", "sensors"])
    def test_time_on_target_and_engaged_agree_with_the_tally(self, changes):
        record = footage(scenario(changes=changes), 400)
        engaged, there = watching(record, 0)
        assert (engaged > 0).sum() / there.sum() == record.estimate("time_on_target").mean
        assert engaged.mean() == pytest.approx(record.estimate("engaged").mean)

    def test_a_false_alarm_far_from_every_target_is_nobody_on_target(self):
        record = footage(scenario(changes={"fleets.0.false_alarm_probability": 1.0, "targets.0.radius": 0.0}), 20)
        assert record.trajectories[0].on_target[:, :15].all()
        assert not watching(record, 0)[0].any()


class TestPhi:
    """Who heads where, frame by frame, as the engine's histogram has it."""

    def test_all_agents_are_in_one_bin_each(self):
        record = footage(scenario(), 20)
        assert phi_of_frames(record, 0, np.arange(20)).sum(axis=2).tolist() == [[15, 35]] * 20

    def test_one_agent_that_runs_to_a_still_target_is_in_the_last_bin(self, make_record):
        record = make_record(counts=(1,))
        frames = record.trajectories[0]
        frames.vx[...] = -frames.x + frames.target_x
        frames.vy[...] = -frames.y + frames.target_y
        assert (phi_of_frames(record, 0, np.arange(5))[:, 0, -1] == 1).all()

    def test_no_target_no_histogram(self, make_record):
        record = make_record()
        record.trajectories[0].target_present[...] = False
        assert not phi_of_frames(record, 0, np.arange(5)).any()
