"""What must hold for any swarm: the model knows no direction, no numbering and no unit but the arena's."""

from typing import get_type_hints

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scenarios import fleets, scenario, small
from shoal.core.units import Unit
from shoal.metrics.summary import METRICS, evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.load import scenario_from
from shoal.strategies import CATALOGUE

ORDERS = ["synchronous", "sequential"]
ONE_WAYPOINT = {"targets.0.waypoint_reach": 1e-6, "targets.0.waypoint_patience": 10**9}  # a new one knows directions
OBLONG = {"area.width": 24.0, "area.height": 16.0}
UPRIGHT = {"area.width": 16.0, "area.height": 24.0}
TURNS_AND_MIRRORS = {
    "a quarter turn": ([[0, -1], [1, 0]], UPRIGHT),
    "a half turn": ([[-1, 0], [0, -1]], OBLONG),
    "three quarters": ([[0, 1], [-1, 0]], UPRIGHT),
    "east for west": ([[-1, 0], [0, 1]], OBLONG),
    "north for south": ([[1, 0], [0, -1]], OBLONG),
    "x for y": ([[0, 1], [1, 0]], UPRIGHT),
}


def met_along_a_run(chosen, steps):
    simulation = Simulation(chosen)
    simulation.advance(steps)
    return simulation


def state_of(simulation):
    """Places, velocities, a_R of the agents and place, heading, waypoint of the target, each (2, N), (1, N) or (2,)."""
    n, swarm, target = simulation.scenario.agents, simulation.swarm, simulation.targets[0]
    return {
        "places": np.stack([swarm.x[:n], swarm.y[:n]]),
        "velocities": np.stack([swarm.vx[:n], swarm.vy[:n]]),
        "repulsion": simulation.memories.memory["repulsion"][None, :n].copy(),
        "target": np.array([target["x"], target["y"]]),
        "heading": np.array([target["heading_x"], target["heading_y"]]),
        "waypoint": np.array([target["waypoint_x"], target["waypoint_y"]]),
    }


def twin(simulation, chosen, state):
    """A simulation of another scenario at the same step, in a given state."""
    other = Simulation(chosen, simulation.run)
    n = chosen.agents
    other.number = simulation.number
    with other.edit() as now:
        swarm, target = now.swarm, now.targets[0]
        swarm.x[:n], swarm.y[:n] = state["places"]
        swarm.vx[:n], swarm.vy[:n] = state["velocities"]
        swarm.memory[:n, other.memory_fields.index("repulsion")] = state["repulsion"][0]
        target["x"], target["y"] = state["target"]
        target["heading_x"], target["heading_y"] = state["heading"]
        target["waypoint_x"], target["waypoint_y"] = state["waypoint"]
        target["waypoint_age"] = simulation.targets[0]["waypoint_age"]
    return other


def assert_same(one, other, tolerance):
    for name, values in one.items():
        np.testing.assert_allclose(values, other[name], rtol=0, atol=tolerance, err_msg=name)


def turned(state, matrix):
    return {part: each if part == "repulsion" else np.array(matrix) @ each for part, each in state.items()}


def renumbered(state, order):
    of_agents = ("places", "velocities", "repulsion")
    return {part: each[:, order] if part in of_agents else each for part, each in state.items()}


def grown(state, factor):
    return {part: each if part == "heading" else factor * each for part, each in state.items()}


class TestDirections:
    """East is a name: the world turned or mirrored runs on turned or mirrored."""

    @pytest.mark.parametrize("order", ORDERS)
    @pytest.mark.parametrize("name", TURNS_AND_MIRRORS)
    @given(steps=st.integers(0, 600), seed=st.integers(0, 1000))
    @settings(max_examples=6)
    def test_none_is_special(self, name, order, steps, seed):
        matrix, area = TURNS_AND_MIRRORS[name]
        common = {"motion.update_order": order, "seed": seed, **ONE_WAYPOINT}
        simulation = met_along_a_run(scenario("oceans2020", {**OBLONG, **common}), steps)
        other = twin(simulation, scenario("oceans2020", {**area, **common}), turned(state_of(simulation), matrix))
        simulation.advance(3)
        other.advance(3)
        assert_same(state_of(other), turned(state_of(simulation), matrix), 1e-9)


class TestNumbering:
    """An agent's number matters to its draws and to ties alone."""

    @given(steps=st.integers(1, 1000), neighbors=st.integers(1, 49), seed=st.integers(0, 2**32))
    @settings(max_examples=25)
    def test_agents_renumbered_move_as_before(self, steps, neighbors, seed):
        chosen = scenario("oceans2020", {"strategy.social": 0.0, "network.neighbors": neighbors, **ONE_WAYPOINT})
        simulation = met_along_a_run(chosen, steps)
        order = np.random.default_rng(seed).permutation(50)
        other = twin(simulation, chosen, renumbered(state_of(simulation), order))
        other._swarm.max_speed[:50] = other.swarm.max_speed[:50][order]
        simulation.advance(1)
        other.advance(1)
        assert_same(state_of(other), renumbered(state_of(simulation), order), 1e-12)
        assert other.swarm.on_target[:50].tolist() == simulation.swarm.on_target[:50][order].tolist()


def scaled(chosen, lengths=1.0, speeds=1.0, times=1.0):
    """The scenario with every length, every speed and every time multiplied, the strategy's own too."""
    factors = {Unit("m"): lengths, Unit("m/s"): speeds, Unit("s"): times}
    table = chosen.model_dump(mode="json")
    hints = get_type_hints(CATALOGUE[chosen.strategy.name].params, include_extras=True)
    marks = {name: getattr(hint, "__metadata__", ()) for name, hint in hints.items()}
    parts = [(chosen, table), (chosen.area, table["area"])]
    parts += zip([*chosen.fleets, *chosen.targets], [*table["fleets"], *table["targets"]], strict=True)
    fields = [(part, name, field.metadata) for model, part in parts for name, field in type(model).model_fields.items()]
    for part, name, marked in [*fields, *((table["strategy"], name, marked) for name, marked in marks.items())]:
        for mark in marked:
            if mark in factors:
                part[name] *= factors[mark]
    return scenario_from(table)


def _of_unit(unit, lengths, times):
    """How a number in this unit scales with all lengths and times."""
    powers = {"m/s": (1, -1), "s": (0, 1), "1/h": (0, -1), "1/s": (0, -1), "B/s": (0, -1)}
    powers |= {"m": (1, 0), "m^2/s": (2, -1), "m^3/s^3": (3, -3)}
    in_length, in_time = powers.get(unit, (0, 0))
    return lengths**in_length * times**in_time


class TestUnits:
    """Meters and seconds are names: all lengths and speeds times one factor change no dimensionless number."""

    @pytest.mark.parametrize("preset", ["oceans2020", "aamas2020"])
    @pytest.mark.parametrize(
        "factors",
        [
            {"lengths": 1024.0, "speeds": 1024.0},
            {"lengths": 0.25, "speeds": 0.25},
            {"times": 8.0, "speeds": 0.125},
            {"lengths": 4.0, "times": 0.5, "speeds": 8.0},
        ],
    )
    def test_a_power_of_two_changes_no_bit(self, preset, factors):
        chosen = scenario(preset, {"steps": 1500, "fleets.0.sensor_radius": 0.25})
        simulations = [met_along_a_run(each, 1500) for each in (chosen, scaled(chosen, **factors))]
        facts = [facts_of(simulation.scenario) for simulation in simulations]
        assert simulations[0].tally.on_target.sum() > 0
        for name in METRICS:
            factor = _of_unit(METRICS[name].unit, factors.get("lengths", 1.0), factors.get("times", 1.0))
            (one, batches), (other, others) = (
                evaluate(name, simulation.tally, fact) for simulation, fact in zip(simulations, facts, strict=True)
            )
            np.testing.assert_array_equal(other, factor * one, name)
            np.testing.assert_array_equal(others, factor * batches, name)
        assert simulations[0].tally.histogram.tolist() == simulations[1].tally.histogram.tolist()
        lengths = factors.get("lengths", 1.0)
        assert (simulations[1].swarm.x[:50] == lengths * simulations[0].swarm.x[:50]).all()

    @given(factor=st.floats(1e-2, 1e5), steps=st.integers(0, 1000), exponent=st.sampled_from([6.0, 3.5]))
    @settings(max_examples=25)
    def test_any_factor_changes_one_step_by_rounding_alone(self, factor, steps, exponent):
        chosen = scenario("oceans2020", {"strategy.repulsion_exponent": exponent})
        simulation = met_along_a_run(chosen, steps)
        larger = scaled(chosen, lengths=factor, speeds=factor)
        other = twin(simulation, larger, grown(state_of(simulation), factor))
        simulation.advance(1)
        other.advance(1)
        assert_same(grown(state_of(other), 1 / factor), state_of(simulation), 1e-10)


class TestAllToAll:
    """With k = N - 1 nobody is chosen: every pair pushes."""

    @given(agents=st.integers(2, 70), steps=st.integers(1, 300), seed=st.integers(0, 100))
    @settings(max_examples=25)
    def test_the_velocity_is_the_sum_over_all_others(self, agents, steps, seed):
        chosen = small(agents, agents - 1, {"strategy.social": 0.0, "strategy.inertia": 0.5, "seed": seed})
        simulation = met_along_a_run(chosen, steps)
        before = state_of(simulation)
        simulation.advance(1)
        x, y = before["places"]
        dx, dy = x[:, None] - x, y[:, None] - y
        distance = np.hypot(dx, dy)
        np.fill_diagonal(distance, np.inf)
        push = (state_of(simulation)["repulsion"].T / np.where(distance > 0, distance, np.inf)) ** 6
        pull = 10.0 * np.stack([(push * dx / distance).sum(axis=1), (push * dy / distance).sum(axis=1)])
        wanted = 0.5 * before["velocities"] + pull
        wanted *= np.minimum(1.0, 1.0 / np.maximum(np.hypot(*wanted), 1e-300))
        there = np.clip(before["places"] + 0.1 * wanted, -8.5, 8.5)
        np.testing.assert_allclose(state_of(simulation)["places"], there, rtol=0, atol=1e-11)


class TestLimits:
    """Nobody outruns the top speed or leaves the arena, and everybody is counted."""

    @given(
        makes=st.lists(st.tuples(st.integers(1, 20), st.floats(0.05, 5.0)), min_size=1, max_size=4),
        order=st.sampled_from(ORDERS),
        changes=st.fixed_dictionaries(
            {
                "strategy.inertia": st.floats(0.0, 3.0),
                "strategy.social": st.floats(0.0, 20.0),
                "strategy.repulsion_exponent": st.sampled_from([0.0, 1.0, 3.0, 6.0, 12.0]),
                "strategy.repulsion_max": st.floats(0.4, 50.0),
                "strategy.delta": st.floats(0.0, 5.0),
                "area.agent_margin": st.floats(0.0, 9.0),
                "targets.0.radius": st.floats(0.0, 20.0),
                "seed": st.integers(0, 2**64 - 1),
            }
        ),
        k=st.floats(0.0, 1.0),
    )
    @settings(max_examples=40)
    def test_hold_for_any_fleets_and_parameters(self, makes, order, changes, k):
        agents = sum(count for count, _ in makes)
        if agents < 2:
            makes, agents = [(2, makes[0][1])], 2
        neighbors = 1 + round(k * (agents - 2))
        changes = {**changes, "motion.update_order": order, "network.neighbors": neighbors, "fleets": fleets(*makes)}
        simulation = met_along_a_run(scenario("oceans2020", changes), 1)  # those who start in the margin are pulled in
        swarm, limit = simulation.swarm, 10.0 - changes["area.agent_margin"]
        top = np.repeat([speed for _, speed in makes], [count for count, _ in makes])
        for _ in range(40):
            simulation.advance(1)
            for x, y in ((swarm.vx, swarm.vy), (swarm.command_x, swarm.command_y)):
                assert (np.hypot(x[:agents], y[:agents]) <= top * (1 + 1e-9) + 1e-12).all()
            assert np.abs([swarm.x[:agents], swarm.y[:agents]]).max() <= limit
        counted = simulation.tally.histogram.sum(axis=(0, 2))
        assert counted.tolist() == [41 * count for count, _ in makes]
        assert (simulation.tally.stationary.sum(axis=0) <= simulation.tally.histogram.sum(axis=0)[:, 5]).all()

    def test_an_arena_so_small_that_all_sit_at_its_walls(self):
        simulation = met_along_a_run(scenario("oceans2020", {"area.agent_margin": 9.999}), 500)
        assert np.abs([simulation.swarm.x[:50], simulation.swarm.y[:50]]).max() <= 0.001 + 1e-12
        assert np.isfinite(simulation.tally.fluctuation).all()
