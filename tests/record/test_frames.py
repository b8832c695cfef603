"""One reading of a fact: what frames show is what the engine knew."""

import numpy as np
import pytest

from frames import decode
from scenarios import scenario
from shoal.record.frames import degrees_of, watching
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.choices import degree_text, headline
from shoal.viewer.recorded import recorded_frames


@pytest.fixture(scope="module")
def seeing_things():
    """A run whose sensors imagine targets, with every frame."""
    alarms = {f"fleets.{fleet}.false_alarm_probability": 0.3 for fleet in (0, 1)}
    return simulate(scenario("oceans2020", {**alarms, "steps": 60}), every=1)


class TestEngaged:
    """False alarms are reported, but nobody is on a target for them."""

    def test_of_the_frames_is_the_metric(self, seeing_things):
        engaged, present = watching(seeing_things, 0)
        assert present.all()
        assert engaged.mean() == pytest.approx(seeing_things.estimate("engaged").mean)
        assert np.asarray(seeing_things.trajectories[0].on_target).sum(axis=1).mean() > 10 * engaged.mean()

    def test_of_the_replay_is_the_metric(self, seeing_things):
        shown = [decode(frame).engaged for frame in recorded_frames(seeing_things, 0, np.arange(60))]
        assert np.mean(shown) == pytest.approx(seeing_things.estimate("engaged").mean, rel=1e-5)


class TestDegree:
    """K of a strategy that is defined for all-to-all communication is N - 1, whatever the network says."""

    @pytest.mark.parametrize("strategy", ["global-pso", "knn-pso"])
    def test_of_the_frames_is_the_engines(self, strategy):
        chosen = scenario("oceans2020", {"strategy": strategy, "steps": 3})
        record = simulate(chosen, every=1)
        assert degrees_of(record).tolist() == Simulation(chosen).swarm.neighbors[:50].tolist()

    def test_is_printed_as_what_it_is(self):
        table = scenario("oceans2020", {"strategy": "global-pso"}).model_dump(mode="json")
        assert degree_text(table) == "all"
        assert "k = all" in headline(table)
        mixed = scenario("oceans2020", {"fleets.0.strategy": "global-pso"}).model_dump(mode="json")
        assert degree_text(mixed) == "all (BoB-1), 20 (BoB-0)"
