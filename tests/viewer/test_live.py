"""A run that goes on while its scenario changes."""

import math
from pathlib import Path

import numpy as np
import pytest

from frames import decode, same_number
from scenarios import changed
from shoal.core.errors import ScenarioError
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.edit import apply
from shoal.scenario.load import read_table, scenario_from
from shoal.viewer.live import LiveRun

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "my_strategy.py"


def live(changes=None, steps=0):
    run = LiveRun(changed(read_table("oceans2020"), changes or {}))
    run.advance(steps)
    return run


def bits(simulation):
    return {name: part.tobytes() for name, part in simulation.state().items() if not name.startswith("tally.")}


class TestGlance:
    def test_it_changes_no_bit(self):
        watched, unwatched = live(), Simulation(scenario_from(read_table("oceans2020")))
        for _ in range(30):
            watched.frame()
            watched.advance(3)
        unwatched.advance(90)
        assert bits(watched.simulation) == bits(unwatched)
        assert all(
            one.tobytes() == other.tobytes()
            for one, other in zip(watched.simulation.tally, unwatched.tally, strict=True)
        )

    def test_it_sees_what_a_record_keeps(self):
        run = live(steps=37)
        kept = simulate(run.simulation.scenario.model_copy(update={"steps": 38}), every=1).trajectories[0]
        seen = run.simulation.look()
        for name, values in seen.arrays().items():
            assert values[0].tobytes() == kept.arrays()[name][37].tobytes()

    def test_its_xi_is_what_the_coming_step_will_measure(self):
        run = live(steps=37)
        xi, before = decode(run.frame()).xi_now, run.simulation.tally.fluctuation.sum()
        run.advance(1)
        gained = run.simulation.tally.fluctuation.sum() - before
        assert xi == pytest.approx(gained / 50 / 1.48, rel=1e-6)


class TestFrame:
    def test_it_is_the_state_of_now(self):
        run = live(steps=50)
        frame, swarm = decode(run.frame()), run.simulation.swarm
        assert (frame.step, frame.epoch, frame.run) == (50, 0, 0)
        for name in ("x", "y", "vx", "vy"):
            assert getattr(frame, name) == [float(np.float32(each)) for each in getattr(swarm, name)[:50]]
        assert frame.repulsion == [float(np.float32(each)) for each in swarm.memory[:50, 0]]
        assert frame.degree == [20] * 50
        assert frame.target_x == [float(np.float32(run.simulation.targets[0]["x"]))]
        assert all(frame.alive)
        assert frame.present == [True]

    def test_who_is_on_target_is_so_where_the_frame_shows_it(self):
        run = live()
        for _ in range(100):
            frame = decode(run.frame())
            away = np.hypot(np.subtract(frame.x, frame.target_x[0]), np.subtract(frame.y, frame.target_y[0]))
            assert frame.on_target == list(away <= 1.0)
            assert frame.engaged == sum(frame.on_target)
            run.advance(3)

    def test_means_are_those_of_the_metrics(self):
        run = live(steps=700)
        frame, facts = decode(run.frame()), facts_of(run.simulation.scenario)
        for name in ("time_on_target", "xi"):
            assert same_number(getattr(frame, name), evaluate(name, run.simulation.tally, facts)[0])

    def test_before_the_first_step_there_is_no_mean(self):
        frame = decode(live().frame())
        assert math.isnan(frame.time_on_target)
        assert math.isnan(frame.recent)
        assert math.isnan(frame.xi)

    def test_phi_counts_every_agent_and_engaged_those_on_target(self):
        frame = decode(live(steps=200).frame())
        assert sum(frame.phi) == 50
        assert frame.engaged == sum(frame.on_target)

    def test_the_shorter_mean_is_over_1000_steps(self):
        run = live()
        for _ in range(8):
            run.frame()
            run.advance(250)
        kept = simulate(run.simulation.scenario.model_copy(update={"steps": 2000}), every=1).trajectories[0]
        assert same_number(decode(run.frame()).recent, kept.on_target[1000:].any(axis=1).mean())

    def test_a_strategy_without_spacing_has_none(self):
        frame = decode(live({"strategy": {"name": "random-walk"}}).frame())
        assert all(math.isnan(each) for each in frame.repulsion)

    def test_without_a_target_there_is_no_phi(self):
        diving = {"kind": "walk", "radius": 1.0, "speed": 1.0, "surface_time": 1e-9, "dive_time": 1e9}
        frame = decode(live({"targets": [diving]}, steps=5).frame())
        assert frame.present == [False]
        assert all(math.isnan(each) for each in frame.phi)
        assert math.isnan(frame.time_on_target)


class TestChange:
    def test_k_takes_effect(self):
        run = live(steps=20)
        run.change({"neighbors": 5})
        assert decode(run.frame()).degree == [5] * 50
        assert '"neighbors":5' in run.message

    def test_a_change_begins_an_epoch_and_new_means_and_keeps_the_step(self):
        run = live(steps=20)
        run.change({"neighbors": 5})
        frame = decode(run.frame())
        assert (frame.step, frame.epoch) == (20, 1)
        assert math.isnan(frame.xi)
        assert '"epoch":1' in run.message
        assert '"since":20' in run.message

    def test_the_shorter_mean_goes_on_through_a_change(self):
        run = live()
        run.frame()
        run.advance(100)
        before = decode(run.frame()).recent
        run.change({"neighbors": 5})
        assert decode(run.frame()).recent == before

    def test_fast_agents_can_go_and_come_back(self):
        run = live(steps=5)
        run.change({"fast": 0})
        assert [(fleet.name, fleet.count) for fleet in run.simulation.scenario.fleets] == [("BoB-0", 50)]
        run.change({"fast": 20})
        fleets = [(fleet.name, fleet.count) for fleet in run.simulation.scenario.fleets]
        assert fleets == [("BoB-1", 20), ("BoB-0", 30)]

    def test_several_changes_are_one(self):
        run = live(steps=5)
        run.change({"strategy.delta": 0.05, "neighbors": 7, "target_speed": "10 kn", "strategy": "knn-pso"})
        scenario = run.simulation.scenario
        assert (scenario.network.neighbors, scenario.strategy.params["delta"]) == (7, 0.05)
        assert scenario.targets[0].speed == pytest.approx(10 * 1852 / 3600)

    def test_another_strategy_comes_with_its_defaults_and_the_first_comes_back_as_it_was(self):
        run = live({"strategy.delta": 0.03}, steps=5)
        run.change({"strategy": "random-walk"})
        assert run.simulation.scenario.strategy.name == "random-walk"
        run.change({"strategy": "knn-pso"})
        assert run.simulation.scenario.strategy.params["delta"] == 0.03

    @pytest.mark.parametrize(
        ("changes", "words"),
        [
            ({"neighbors": 50}, "at most 49"),
            ({"neighbors": 0}, "greater than or equal to 1|greater than 0"),
            ({"neighbors": True}, "valid integer|neighbors"),
            ({"target_speed": -1}, "greater than or equal to 0"),
            ({"fast": 51}, "from 0 to 50"),
            ({"strategy": "nobody"}, "no strategy is called"),
            ({"strategy": "evil.py"}, "no strategy is called"),
            ({"strategy": "/etc/passwd"}, "no strategy is called"),
            ({"strategy.file": "evil.py"}, "cannot be changed"),
            ({"strategy.source": "0"}, "cannot be changed"),
            ({"strategy.name": "lattice"}, "cannot be changed"),
            ({"strategy.dleta": 1.0}, "did you mean 'delta'"),
            ({"steps": 5}, "cannot be changed"),
            ({"targets.0.file": "/etc/passwd"}, "cannot be changed"),
            ({"area.width": 1e9}, "cannot be changed"),
        ],
    )
    def test_what_a_scenario_refuses_changes_nothing(self, changes, words):
        run = live(steps=5)
        before, message = bits(run.simulation), run.message
        with pytest.raises(ScenarioError, match=words):
            run.change(changes)
        assert bits(run.simulation) == before
        assert run.message == message

    def test_the_same_changes_at_the_same_steps_give_the_same_bits(self):
        results = []
        for chunk in (1, 5, 40):
            run = live()
            for number in range(0, 200, chunk):
                if number == 40:
                    run.change({"neighbors": 9, "fast": 30})
                if number == 80:
                    run.kill(3)
                    run.drag(0, 1.0, 2.0)
                if number == 120:
                    run.add(0, -1.0, 3.0)
                run.frame()
                run.advance(chunk)
            results.append(bits(run.simulation))
        assert results[0] == results[1] == results[2]


class TestAStrategyOfTheUsers:
    @pytest.fixture
    def run(self):
        return LiveRun(apply(read_table("oceans2020"), {"strategy": str(EXAMPLE)}))

    def test_the_page_is_told_what_it_is_and_not_where_it_lies(self, run):
        assert '"name":"wander"' in run.message
        assert '"turn_chance":0.02' in run.message
        assert "my_strategy" not in run.message

    def test_it_comes_back_by_its_name_after_another(self, run):
        run.change({"strategy": "knn-pso"})
        run.change({"strategy": "wander", "strategy.turn_chance": 0.5})
        assert run.simulation.scenario.strategy.params["turn_chance"] == 0.5


class TestKillAndAdd:
    def test_the_killed_keeps_its_number(self):
        run = live(steps=20)
        run.kill(7)
        frame = decode(run.frame())
        assert [number for number, alive in enumerate(frame.alive) if not alive] == [7]
        assert sum(frame.phi) == 49

    def test_the_new_one_is_the_last_of_its_fleet(self):
        run = live(steps=20)
        before = decode(run.frame())
        run.add(0, 1.5, -2.5)
        frame = decode(run.frame())
        assert (frame.x[15], frame.y[15]) == (1.5, -2.5)
        assert frame.x[:15] + frame.x[16:] == before.x
        assert all(frame.alive)

    def test_it_joins_the_fleet_that_the_page_sees(self):
        run = live(steps=5)
        run.change({"fast": 0})
        run.add(0, 0.0, 0.0)
        assert [(fleet.name, fleet.count) for fleet in run.simulation.scenario.fleets] == [("BoB-0", 51)]
        run.change({"fast": 1})
        assert [fleet.count for fleet in run.simulation.scenario.fleets] == [1, 50]

    @pytest.mark.parametrize(("fleet", "x"), [(2, 0.0), (-1, 0.0), (0, 8.6)])
    def test_there_is_no_such_place(self, fleet, x):
        run = live(steps=5)
        with pytest.raises(ScenarioError):
            run.add(fleet, x, 0.0)
        assert run.simulation.scenario.agents == 50


class TestDrag:
    def test_the_target_is_there_and_means_go_on(self):
        run = live(steps=20)
        run.drag(0, 3.0, 4.0)
        frame = decode(run.frame())
        assert (frame.target_x, frame.target_y, frame.epoch) == ([3.0], [4.0], 0)
        assert not math.isnan(frame.xi)


class TestRestart:
    def test_from_step_0_with_the_settings_of_now_and_all_agents(self):
        run = live(steps=20)
        run.change({"neighbors": 9})
        run.kill(7)
        run.restart()
        frame = decode(run.frame())
        assert (frame.step, frame.degree, all(frame.alive)) == (0, [9] * 50, True)
        assert frame.epoch == 3

    def test_another_seed_is_another_start(self):
        run = live()
        first = decode(run.frame()).x
        run.restart(seed=5)
        assert decode(run.frame()).x != first
        run.restart(seed=1)
        assert decode(run.frame()).x == first
