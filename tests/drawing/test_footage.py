"""Specification of footage: the run as it is."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.drawing.footage import current_record, footage, footage_bytes
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation


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

    def test_to_be_drawn_alone_it_is_as_large_as_what_is_drawn(self):
        whole, lean = (footage(scenario(), 30, start=10, lean=lean).trajectories[0] for lean in (False, True))
        for name in ("x", "y", "on_target", "alive", "engaged", "target_x", "links"):
            assert np.array_equal(getattr(lean, name), getattr(whole, name))
        assert not any(lean.vx.strides)
        assert lean.vx.shape == lean.memory["repulsion"].shape == whole.x.shape

    def test_more_frames_than_there_is_memory(self, monkeypatch):
        monkeypatch.setattr("shoal.run.keep._memory", lambda: 10 * footage_bytes(scenario(), lean=False))
        with pytest.raises(ScenarioError, match="keeps 11 frames"):
            footage(scenario(), 11)


class TestPresent:
    """The state of a simulation, as the record of its run has it."""

    def test_it_is_the_frame_that_a_record_would_keep(self):
        record = simulate(scenario(changes={"steps": 60}), every=1)
        simulation = Simulation(scenario(changes={"steps": 60}))
        simulation.advance(45)
        now = current_record(simulation).trajectories[0]
        for name, values in record.trajectories[0].arrays().items():
            assert np.array_equal(now.arrays()[name][0], values[45]), name

    def test_the_simulation_stays_as_it_is(self):
        one, other = Simulation(scenario()), Simulation(scenario())
        one.advance(30)
        other.advance(30)
        current_record(one)
        one.advance(30)
        other.advance(30)
        assert all(np.array_equal(one.state()[name], other.state()[name]) for name in one.state())

    def test_a_simulation_at_its_end_has_a_present_too(self):
        simulation = Simulation(scenario(changes={"steps": 20}))
        simulation.advance(20)
        assert current_record(simulation).trajectories[0].step.tolist() == [20]
