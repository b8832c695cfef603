"""Where a run starts: draws that nothing but seed, run and agent decide."""

import numpy as np
import pytest

import replay
from replay import START_STEP, TARGET_STREAM, split, target_box, uniform
from scenarios import fleets, scenario
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.load import load

PLACEMENT = 2**20


def started(changes=None, run=0):
    return Simulation(scenario("oceans2020", {"area.width": 30.0, **(changes or {})}), run)


def start_key(simulation):
    return split(split(split(simulation.scenario.seed, 0), simulation.run), START_STEP)


class TestAgents:
    """Uniform inside the wall, or over a tenth of its sides; over the whole arena only where asked for."""

    @pytest.mark.parametrize(("seed", "run"), [(1, 0), (1, 5), (2**64 - 1, 3)])
    def test_start_where_their_draws_say(self, seed, run):
        simulation = started({"seed": seed}, run)
        keys = [split(split(start_key(simulation), i), PLACEMENT) for i in range(50)]
        expected = np.array([[uniform(key, 0), uniform(key, 1)] for key in keys])
        np.testing.assert_allclose(simulation.swarm.x[:50], 13.5 * (2 * expected[:, 0] - 1), rtol=0, atol=1e-14)
        np.testing.assert_allclose(simulation.swarm.y[:50], 8.5 * (2 * expected[:, 1] - 1), rtol=0, atol=1e-14)

    def test_at_rest(self):
        simulation = started()
        assert not np.any([simulation.swarm.vx, simulation.swarm.vy])

    def test_with_the_repulsion_of_the_scenario(self):
        simulation = started({"strategy.repulsion_start": 0.7})
        assert set(simulation.memories.memory["repulsion"][:50].tolist()) == {0.7}

    @pytest.mark.parametrize(
        ("start", "low", "high"),
        [
            ("uniform", (-13.5, -8.5), (13.5, 8.5)),
            ("center", (-1.35, -0.85), (1.35, 0.85)),
            ("corner", (-13.5, -8.5), (-10.8, -6.8)),
            ("arena", (-15, -10), (15, 10)),
        ],
    )
    def test_fill_their_place(self, start, low, high):
        many = fleets((2000, 1.0))
        many[0]["start"] = start
        swarm = started({"fleets": many}).swarm
        for values, least, most in ((swarm.x[:2000], low[0], high[0]), (swarm.y[:2000], low[1], high[1])):
            width = most - least
            assert least <= values.min() < least + 0.01 * width
            assert most - 0.01 * width < values.max() <= most
            assert values.mean() == pytest.approx((least + most) / 2, abs=0.03 * width)

    def test_each_fleet_has_its_own_place(self):
        makes = fleets((10, 2.6), (40, 1.0))
        makes[0]["start"] = "corner"
        swarm = started({"fleets": makes}).swarm
        assert (swarm.x[:10] <= -10.8).all()
        assert (swarm.x[10:50] > -10.8).mean() > 0.8


class TestTheWall:
    """An agent that starts outside it is put inside, and no metric takes that for motion."""

    @pytest.mark.parametrize("start", ["uniform", "center", "corner", "arena"])
    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    def test_nobody_is_ever_faster_than_its_top_speed(self, start, order):
        changes = {f"fleets.{fleet}.start": start for fleet in (0, 1)}
        frames = started({**changes, "motion.update_order": order, "area.agent_margin": 4.0}).advance(30, every=1)
        top = np.repeat([2.6, 1.0], [15, 35])
        assert (np.hypot(frames.vx, frames.vy) <= top * (1 + 1e-12)).all()
        moved = np.hypot(np.diff(frames.x, axis=0), np.diff(frames.y, axis=0)) / 0.1
        jumps = (moved > top * (1 + 1e-9)).any(axis=1)
        assert jumps.tolist() == [start == "arena", *[False] * 28]

    def test_who_is_only_put_inside_stands_still(self):
        simulation = started({"fleets.0.start": "arena", "fleets.1.start": "arena", "area.agent_margin": 9.0})
        outside = (np.abs(simulation.swarm.x[:50]) > 7.0) & (np.abs(simulation.swarm.y[:50]) > 2.0)
        assert outside.sum() > 5
        simulation.advance(1)
        assert np.abs(simulation.swarm.x[:50]).max() <= 6.0
        assert np.abs(simulation.swarm.y[:50]).max() <= 1.0
        assert not np.any([simulation.swarm.vx[:50][outside], simulation.swarm.vy[:50][outside]])
        assert simulation.tally.distance.sum(axis=0)[outside].sum() == 0.0
        assert simulation.tally.stationary.sum() >= outside.sum()

    @pytest.mark.parametrize("preset", ["oceans2020", "aamas2020"])
    def test_power_is_no_more_than_all_at_top_speed_take(self, preset):
        record = simulate(load(preset).model_copy(update={"steps": 20}), runs=3)
        for fleet in record.scenario.fleets:
            assert record.fleet_estimate("power")[fleet.name].mean <= fleet.max_speed**3


class TestWaypointTarget:
    """Starts and turns by draws of its own."""

    def test_starts_in_its_box_and_heads_for_its_waypoint(self):
        simulation = started()
        target, box = simulation.targets[0], target_box(simulation.scenario)
        key = split(start_key(simulation), TARGET_STREAM)
        place = (2 * np.array([uniform(key, 0), uniform(key, 1)]) - 1) * box
        below = split(key, 2)
        waypoint = (2 * np.array([uniform(below, 0), uniform(below, 1)]) - 1) * box
        heading = (waypoint - place) / np.hypot(*(waypoint - place))
        assert (target["x"], target["y"]) == pytest.approx(tuple(place), abs=1e-14)
        assert (target["waypoint_x"], target["waypoint_y"]) == pytest.approx(tuple(waypoint), abs=1e-14)
        assert (target["heading_x"], target["heading_y"]) == pytest.approx(tuple(heading), abs=1e-14)

    def test_two_targets_have_draws_of_their_own(self):
        one = {"kind": "waypoint", "radius": 1.0, "speed": 3.0, "waypoint_reach": 1.0}
        targets = started({"targets": [one, one]}).targets
        assert targets["x"][0] != targets["x"][1]
        assert targets["waypoint_x"][0] != targets["waypoint_x"][1]


class TestDraws:
    """Of agents in a step: who is asked, not in which order, decides."""

    def test_are_uniform_over_agents_and_steps(self):
        chosen = scenario()
        r = np.stack([replay.draws(chosen, 0, number) for number in range(200)])
        assert r.mean() == pytest.approx(0.5, abs=0.01)
        assert r.var() == pytest.approx(1 / 12, abs=0.003)
        assert np.abs(np.corrcoef(r[:-1].ravel(), r[1:].ravel())[0, 1]) < 0.03
        assert np.abs(np.corrcoef(r[:, :-1].ravel(), r[:, 1:].ravel())[0, 1]) < 0.03
