"""A running swarm carried over into another scenario: what stays, what begins anew."""

import numpy as np
import pytest

from scenarios import fleets, scenario, small
from shoal.core.errors import ScenarioError
from shoal.run.carry_over import carry_over
from shoal.run.live_edits import move_target, remove_agent
from shoal.run.simulation import Simulation

BODY = ("x", "y", "vx", "vy", "memory", "neighbors", "contact", "leaves", "joins", "alive", "on_target")


def running(changes=None, steps=60):
    simulation = Simulation(scenario(changes=changes))
    simulation.advance(steps)
    return simulation


def agents_of(simulation, names=BODY):
    count = simulation.scenario.agents
    return {name: getattr(simulation.swarm, name)[:count].copy() for name in names}


def same(one, other):
    return all(one[name].tobytes() == other[name].tobytes() for name in one)


class TestTheSameScenario:
    """Transplanted into itself, a run goes on as if nothing had happened, to the last bit."""

    @pytest.mark.parametrize(
        "changes",
        [
            {},
            {"motion.update_order": "sequential"},
            {"network.delay": 3, "network.range": 9.0, "network.loss": 0.1},
            {"network.adaptive": {"fewest": 3, "most": 30, "patience": 2.0}},
            {"network.max_age": 4, "network.loss": 0.5, "network.hops": 2},
            {"losses": [{"step": 50, "count": 9}, {"step": 70, "count": 9}]},
            {"joins": [{"step": 40, "count": 4, "fleet": "BoB-1"}, {"step": 65, "count": 4, "fleet": "BoB-0"}]},
            {"fleets.0.mean_lifetime": 8.0},
            {"targets": [{"kind": "walk", "radius": 1.0, "speed": 3.0, "surface_time": 3.0, "dive_time": 1.0}]},
            {"strategy": {"name": "memory-pso"}},
        ],
        ids=lambda changes: next(iter(changes), "preset"),
    )
    def test_goes_on_the_same(self, changes):
        undisturbed = running(changes)
        moved = carry_over(running(changes), undisturbed.scenario)
        undisturbed.advance(60)
        moved.advance(60)
        assert moved.number == undisturbed.number == 120
        assert same(agents_of(moved), agents_of(undisturbed))
        assert moved.targets.tobytes() == undisturbed.targets.tobytes()

    def test_sums_begin_anew(self):
        moved = carry_over(running(), scenario())
        assert moved.tally.steps.sum() == 0
        moved.advance(5)
        assert moved.tally.steps.sum() == 5

    def test_the_old_run_stays_as_it_was(self):
        old = running()
        before = agents_of(old)
        carry_over(old, scenario()).advance(50)
        assert same(agents_of(old), before)


class TestAChange:
    def test_k_changes_and_nothing_else(self):
        old = running()
        new = carry_over(old, scenario(changes={"network.neighbors": 5}))
        assert set(new.swarm.neighbors[:50]) == {5}
        kept = [name for name in BODY if name != "neighbors"]
        assert same(agents_of(new, kept), agents_of(old, kept))

    def test_it_matters_from_the_next_step_on(self):
        new = carry_over(running(), scenario(changes={"network.neighbors": 5}))
        old = running()
        assert same(agents_of(new, ("x", "y")), agents_of(old, ("x", "y")))
        new.advance(1)
        old.advance(1)
        assert not np.array_equal(new.swarm.vx, old.swarm.vx)

    def test_a_target_keeps_its_way_and_takes_the_new_speed(self):
        old = running()
        new = carry_over(old, scenario(changes={"targets.0.speed": 7.0}))
        for name in ("x", "y", "heading_x", "heading_y", "waypoint_x", "waypoint_y", "waypoint_age"):
            assert new.targets[0][name] == old.targets[0][name]
        assert new.targets[0]["speed"] == 7.0

    def test_a_target_of_another_kind_begins_where_that_kind_begins(self):
        still = {"targets": [{"kind": "still", "radius": 1.0, "x": 4.0}]}
        assert carry_over(running(), scenario(changes=still)).targets[0]["x"] == 4.0

    def test_faster_agents_are_those_of_the_lowest_numbers(self):
        old = running()
        new = carry_over(old, scenario(changes={"fleets.0.count": 20, "fleets.1.count": 30}))
        assert list(new.swarm.max_speed[:50]) == [2.6] * 20 + [1.0] * 30
        assert same(agents_of(new, ("x", "y", "vx", "vy")), agents_of(old, ("x", "y", "vx", "vy")))

    def test_another_strategy_begins_with_its_own_memory(self):
        old = running()
        new = carry_over(old, scenario(changes={"strategy": {"name": "memory-pso"}}))
        afresh = Simulation(new.scenario)
        assert new.swarm.memory[:50].tobytes() == afresh.swarm.memory[:50].tobytes()

    def test_other_parameters_keep_the_memory(self):
        old = running()
        new = carry_over(old, scenario(changes={"strategy.delta": 0.05}))
        assert new.swarm.memory[:50].tobytes() == old.swarm.memory[:50].tobytes()
        assert len(np.unique(old.swarm.memory[:50])) > 1

    def test_fleets_with_strategies_of_their_own_are_told_apart(self):
        mixed = {"fleets.0.strategy": {"name": "random-walk"}}
        old = running()
        new = carry_over(old, scenario(changes=mixed))
        column = new.memory_fields.index("repulsion")
        assert np.array_equal(new.swarm.memory[15:50, column], old.swarm.memory[15:50, 0])
        assert (new.swarm.memory[:15, column] == 0).all()

    @pytest.mark.parametrize("delay", [0, 2, 7])
    def test_with_another_delay_what_is_on_the_air_is_what_is_said_now(self, delay):
        old = running({"network.delay": 4})
        new = carry_over(old, scenario(changes={"network.delay": delay}))
        assert (new.radio.x[:, :50] == old.swarm.x[:50]).all()

    def test_what_was_heard_is_kept_by_those_who_stay_if_the_rule_stays(self):
        old = running({"network.max_age": 4, "network.loss": 0.5})
        stay = np.array([3, 1, 49])
        few = {"network.max_age": 4, "network.loss": 0.5, "fleets": fleets((3, 1.0)), "network.neighbors": 2}
        new = carry_over(old, scenario(changes=few), stay)
        assert (new.radio.heard[:, :3] == old.radio.heard[np.ix_(stay, stay)]).all()
        changed = carry_over(old, scenario(changes={"network.max_age": 5, "network.loss": 0.5}))
        assert (changed.radio.heard == -1).all()
        assert old.radio.heard.max() == 59

    def test_the_same_at_the_same_step_is_the_same_however_it_came_there(self):
        results = []
        for chunks in ([60], [1, 9, 50], [10] * 6):
            simulation = Simulation(scenario())
            for chunk in chunks:
                simulation.advance(chunk)
            changed = carry_over(simulation, scenario(changes={"network.neighbors": 7, "targets.0.speed": 5.0}))
            changed.advance(40)
            results.append(agents_of(changed))
        assert same(results[0], results[1])
        assert same(results[0], results[2])


class TestOrigin:
    def test_agents_take_their_state_with_them(self):
        old = running()
        new = carry_over(old, scenario(changes={"fleets.0.count": 16}), np.insert(np.arange(50), 15, -1))
        assert np.array_equal(np.delete(new.swarm.x[:51], 15), old.swarm.x[:50])
        assert np.array_equal(np.delete(new.swarm.memory[:51], 15, 0), old.swarm.memory[:50])

    def test_a_new_one_is_there_from_now_on(self):
        new = carry_over(running(), scenario(changes={"fleets.0.count": 16}), np.insert(np.arange(50), 15, -1))
        frame = new.advance(1, every=1)
        assert new.swarm.joins[15] == 60
        assert frame.alive.all()

    def test_its_lifetime_begins_now(self):
        lives = {"fleets.0.mean_lifetime": 1e6}
        old = running(lives, steps=1000)
        new = carry_over(old, scenario(changes={**lives, "fleets.0.count": 16}), np.insert(np.arange(50), 15, -1))
        assert new.swarm.leaves[15] > 1000

    def test_by_default_agents_keep_their_numbers_and_others_are_new(self):
        old = Simulation(small(10, 3))
        old.advance(30)
        new = carry_over(old, small(12, 3))
        assert np.array_equal(new.swarm.x[:10], old.swarm.x[:10])
        assert list(new.swarm.joins[:12]) == [0] * 10 + [30] * 2


class TestRemoveAgent:
    def test_it_is_gone_and_keeps_its_number(self):
        simulation = running()
        remove_agent(simulation, 7)
        frame = simulation.advance(20, every=1)
        assert not frame.alive[:, 7].any()
        assert not frame.on_target[:, 7].any()
        assert frame.alive[:, np.arange(50) != 7].all()
        assert (frame.x[:, 7] == frame.x[0, 7]).all()

    def test_nobody_hears_it_any_more(self):
        simulation = running({"network.neighbors": "all"})
        heard = simulation.tally.heard.sum()
        assert heard == 60 * 50 * 49
        remove_agent(simulation, 7)
        simulation.advance(10)
        assert simulation.tally.heard.sum() - heard <= 10 * 49 * 49

    def test_at_that_step_the_others_are_untouched(self):
        simulation = running()
        before = agents_of(simulation)
        remove_agent(simulation, 7)
        others = np.arange(50) != 7
        assert all(agents_of(simulation)[name][others].tobytes() == before[name][others].tobytes() for name in before)

    def test_agents_that_listen_to_nobody_never_notice(self):
        deaf = {"strategy": {"name": "random-walk"}}
        one, other = running(deaf), running(deaf)
        remove_agent(one, 7)
        one.advance(100)
        other.advance(100)
        others = np.arange(50) != 7
        assert one.swarm.x[:50][others].tobytes() == other.swarm.x[:50][others].tobytes()

    def test_it_stays_gone_through_later_changes(self):
        simulation = running()
        remove_agent(simulation, 7)
        changed = carry_over(simulation, scenario(changes={"network.neighbors": 5}))
        assert not changed.advance(10, every=1).alive[:, 7].any()

    def test_two_stay(self):
        simulation = Simulation(small(3, 1))
        remove_agent(simulation, 0)
        with pytest.raises(ScenarioError, match="at least 2"):
            remove_agent(simulation, 1)
        simulation.advance(10)

    @pytest.mark.parametrize("agent", [-1, 50])
    def test_there_is_no_such_agent(self, agent):
        with pytest.raises(ScenarioError, match="from 0 to 49"):
            remove_agent(running(steps=1), agent)

    def test_nobody_goes_twice(self):
        simulation = running(steps=1)
        remove_agent(simulation, 7)
        with pytest.raises(ScenarioError, match="gone already"):
            remove_agent(simulation, 7)


class TestMoveTarget:
    def test_it_goes_on_from_there(self):
        simulation = running()
        move_target(simulation, 0, 3.0, -2.0)
        frame = simulation.advance(2, every=1)
        assert (frame.target_x[0, 0], frame.target_y[0, 0]) == (3.0, -2.0)
        way = np.hypot(frame.target_x[1, 0] - 3.0, frame.target_y[1, 0] + 2.0)
        assert way == pytest.approx(3.0 * 0.1)

    def test_it_stays_in_its_box(self):
        simulation = running()
        move_target(simulation, 0, 1e9, -1e9)
        box = simulation.targets[0]
        assert (box["x"], box["y"]) == (box["half_x"], -box["half_y"])

    def test_a_target_at_rest_stays_in_the_arena(self):
        simulation = running({"targets": [{"kind": "still", "radius": 1.0}]})
        move_target(simulation, 0, 99.0, 4.0)
        assert (simulation.targets[0]["x"], simulation.targets[0]["y"]) == (10.0, 4.0)

    def test_there_is_no_such_target(self):
        with pytest.raises(ScenarioError, match="from 0 to 0"):
            move_target(running(steps=1), 1, 0.0, 0.0)

    def test_a_recorded_target_follows_its_track(self, tmp_path):
        track = tmp_path / "track.csv"
        track.write_text(
            "time,lon,lat\n" + "".join(f"2020-01-01T00:00:{s:02d}Z,{s / 1e6},0\n" for s in range(0, 50, 5))
        )
        recorded = {
            "targets": [{"kind": "track", "file": str(track), "radius": 1.0}],
            "area": {"width": 20.0, "height": 20.0, "origin": [0.0, 0.0]},
        }
        with pytest.raises(ScenarioError, match="follows its recorded track"):
            move_target(running(recorded, steps=1), 0, 0.0, 0.0)


def test_a_team_of_two_makes_is_one_case_of_many():
    """Fleets of any number and size are carried over agent by agent."""
    old = Simulation(scenario(changes={"fleets": fleets((3, 1.0), (4, 2.0), (5, 3.0)), "network.neighbors": 4}))
    old.advance(25)
    new = carry_over(old, scenario(changes={"fleets": fleets((6, 1.0), (6, 3.0)), "network.neighbors": 4}))
    assert np.array_equal(new.swarm.x[:12], old.swarm.x[:12])
