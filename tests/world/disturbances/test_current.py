"""A uniform current: everything that floats drifts alike, and velocities stay those through the water."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.run.carry_over import carry_over
from shoal.run.simulation import Simulation

ROOM = {"area.width": 1e4, "area.height": 1e4, "steps": 100}
WALK = {"kind": "walk", "radius": 1.0, "speed": 2.0}


def paths(current=None, changes=None, steps=100):
    """Places of agents and targets at the start of each step, complex (K, N) and (K, T), and the simulation."""
    disturbances = {"disturbances": [{"kind": "current", **current}]} if current else {}
    simulation = Simulation(scenario(changes={**ROOM, "targets": [WALK], **disturbances, **(changes or {})}))
    frames = simulation.advance(steps, every=1)
    return frames.x + 1j * frames.y, frames.target_x + 1j * frames.target_y, simulation, frames


class TestDrift:
    def test_all_are_displaced_alike_and_nobody_notices(self):
        """All that a swarm does depends on differences of places, so it does the same in another place."""
        far = {f"fleets.{fleet}.start": "center" for fleet in range(2)}  # from all walls
        agents, targets, _, still = paths(changes=far)
        drifted, carried, _, frames = paths({"east": 0.7, "north": -0.3}, far)
        away = (0.7 - 0.3j) * 0.1 * np.arange(100)[:, None]
        assert drifted == pytest.approx(agents + away, abs=1e-6)
        assert carried == pytest.approx(targets + away, abs=1e-6)
        assert frames.vx == pytest.approx(still.vx, abs=1e-6)

    def test_a_fleet_alone_and_no_target(self):
        agents, targets, _, _ = paths(changes={"strategy": "lattice"})
        drifted, carried, _, _ = paths({"east": 0.7, "fleet": "BoB-0"}, {"strategy": "lattice"}, steps=2)
        assert (drifted[1] - agents[1])[15:] == pytest.approx(0.07, abs=1e-9)
        assert (drifted[1] - agents[1])[:15] == pytest.approx(0.0, abs=1e-9)
        assert carried.tobytes() == targets[:2].tobytes()

    def test_while_it_lasts(self):
        _, targets, _, _ = paths()
        _, carried, _, _ = paths({"east": 1.0, "since": 2.0, "until": 3.0})
        away = np.clip(0.1 * np.arange(100) - 2.0, 0.0, 1.0)
        assert (carried - targets)[:, 0] == pytest.approx(away, abs=1e-9)

    def test_what_is_moored_or_recorded_stays(self):
        still = {"kind": "still", "radius": 1.0, "x": 3.0, "y": -4.0}
        _, carried, _, _ = paths({"east": 1.0}, {"targets": [still]})
        assert set(carried[:, 0].tolist()) == {3.0 - 4.0j}

    def test_walls_stop_it(self):
        changes = {"area.width": 20.0, "area.height": 20.0}
        drifted, carried, simulation, _ = paths({"east": 8.0}, changes, steps=200)
        assert np.abs(drifted.real).max() <= simulation.world.clamp_x
        assert np.abs(carried.real).max() <= 10.0
        assert drifted.real[-1].min() > 0.0

    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    def test_two_add_up(self, order):
        changes = {"motion.update_order": order}
        both = [{"kind": "current", "east": 0.5}, {"kind": "current", "east": 0.2, "north": 0.1}]
        one, _, _, _ = paths({"east": 0.7, "north": 0.1}, changes)
        two, _, _, _ = paths(None, {**changes, "disturbances": both})
        assert one == pytest.approx(two, abs=1e-6)


class TestGusts:
    def water(self, **gust):
        _, targets, _, _ = paths()
        _, carried, _, _ = paths({"gust_time": 1.0, **gust})
        return np.diff((carried - targets)[:, 0]) / 0.1

    def test_last_as_long_as_they_say_and_differ(self):
        flow = self.water(gust=0.5)
        assert max(np.abs(flow[at : at + 9] - flow[at]).max() for at in range(0, 90, 10)) < 1e-6
        assert len(set(np.round(flow[4::10], 6))) == 10

    def test_have_the_spread_that_they_say_about_the_mean(self):
        _, targets, _, _ = paths(steps=4000, changes={"steps": 4000, "area.width": 1e6, "area.height": 1e6})
        gusty = {"gust": 0.5, "gust_time": 0.1, "east": 2.0}
        _, carried, _, _ = paths(gusty, {"steps": 4000, "area.width": 1e6, "area.height": 1e6}, steps=4000)
        flow = np.diff((carried - targets)[:, 0]) / 0.1
        assert flow.mean() == pytest.approx(2.0, abs=0.04)
        assert (flow.real.std(), flow.imag.std()) == pytest.approx((0.5, 0.5), rel=0.05)


class TestSteps:
    def test_time_is_counted_in_steps_whatever_floats_say(self):
        """3 * 0.3 is less than 0.9."""
        table = {"time_step": 0.3, "targets": [WALK], **ROOM, "disturbances": [{"kind": "current", "east": 1.0}]}
        always = Simulation(scenario(changes=table)).advance(6, every=1)
        late = {**table, "disturbances": [{"kind": "current", "east": 1.0, "since": 0.9}]}
        begun = Simulation(scenario(changes=late)).advance(6, every=1)
        behind = always.target_x[:, 0] - begun.target_x[:, 0]
        assert behind == pytest.approx([0.0, 0.3, 0.6, 0.9, 0.9, 0.9], abs=1e-9)


class TestEdge:
    def test_a_target_that_is_pressed_against_the_edge_keeps_heading_inside(self):
        line = {"kind": "line", "radius": 1.0, "speed": 1.0}
        simulation = Simulation(
            scenario(changes={"targets": [line], "disturbances": [{"kind": "current", "east": 2.0}], "steps": 400})
        )
        simulation.advance(300)
        headings = []
        for _ in range(50):
            simulation.advance(1)
            headings.append(simulation.targets["heading_x"][0])
        assert max(headings) < 0.0  # west, against the current, which presses it to the eastern edge


class TestLiveEdit:
    def test_a_current_that_is_taken_away_carries_nothing_any_more(self):
        still = [{"kind": "line", "radius": 1.0, "speed": 0.0}]
        flowing = {"targets": still, "disturbances": [{"kind": "current", "east": 0.5}], **ROOM}
        old = Simulation(scenario(changes=flowing))
        old.advance(20)
        calm = carry_over(old, scenario(changes={"targets": still, **ROOM}))
        place = calm.targets["x"][0]
        calm.advance(5)
        assert calm.targets["x"][0] == place

    def test_another_current_begins_with_the_coming_step(self):
        still = [{"kind": "line", "radius": 1.0, "speed": 0.0}]
        old = Simulation(scenario(changes={"targets": still, **ROOM}))
        other = {"targets": still, "disturbances": [{"kind": "current", "east": 0.5}], **ROOM}
        for steps in (0, 20):
            old.advance(steps)
            new = carry_over(old, scenario(changes=other))
            place = new.targets["x"][0]
            new.advance(5)
            assert new.targets["x"][0] - place == pytest.approx(5 * 0.05)
