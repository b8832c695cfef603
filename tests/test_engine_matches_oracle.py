"""The engine is the paper: step by step it agrees with the slow referee in oracle.py, switch by switch.

The draws of each step are replayed into the oracle. Both round differently, and a swarm amplifies that: one step from
a common state agrees to 1e-12 m, 30 steps on their own to 1e-8 m.
"""

import dataclasses

import numpy as np
import pytest

import oracle
from replay import model_of, oracle_step, put_state, state_of
from scenarios import fleets, scenario, small
from shoal.run.simulation import Simulation

PRESETS = ["oceans2020", "aamas2020", "aamas2020-constant"]
SEQUENTIAL = {"motion.update_order": "sequential"}
STATES = 200  # of a preset
STATES_OF_A_VARIANT = 15
APART = 7  # steps between two of them

SIZES = [
    (2, 1), (3, 1), (3, 2), (7, 1), (7, 3), (7, 6), (50, 1), (50, 2), (50, 33), (50, 48), (50, 49),
    (64, 1), (64, 20), (64, 63), (65, 2), (65, 32), (65, 63), (65, 64),
]  # fmt: skip
SWITCHES = {
    "follow the nearest": {"strategy.follow": "nearest"},
    "follow the lowest index": {"strategy.follow": "lowest-index"},
    "a draw per axis": {"strategy.social_draws": "per-axis"},
    "synchronous": {"motion.update_order": "synchronous"},
    "sequential": SEQUENTIAL,
    "speed divided": {"motion.speed_rule": "divide"},
    "no margin": {"area.agent_margin": 0.0},
    "half inertia": {"strategy.inertia": 0.5},
    "full inertia": {"strategy.inertia": 1.0},
    "no social pull": {"strategy.social": 0.0},
    "exponent 4": {"strategy.repulsion_exponent": 4.0},
    "exponent 2.5": {"strategy.repulsion_exponent": 2.5},
    "other steps of a_R": {"strategy.delta": 0.04, "strategy.shrink": 4.25},
    "a_R exactly at its limits": {
        "strategy.repulsion_start": 0.5,
        "strategy.repulsion_max": 0.75,
        "strategy.delta": 0.125,
    },
    "an oblong arena": {"area.width": 26.0, "area.height": 14.0},
    "target at 5 m/s": {"targets.0.speed": 5.0},
    "target at rest": {"targets.0.speed": 0.0},
    "a nervous target": {"targets.0.max_turn": 90.0, "targets.0.waypoint_patience": 9},
    "a large target": {"targets.0.radius": 3.0},
    "sharp sensors": {f"fleets.{i}.sensor_radius": 0.75 for i in range(2)},
    "time-step 0.25 s": {"time_step": 0.25},
    "25 fast, 25 slow": {"fleets": fleets((25, 2.6), (25, 1.0))},
    "slow ones first": {"fleets": fleets((35, 1.0), (15, 2.6))},
    "three fleets": {"fleets": fleets((10, 2.6), (27, 1.0), (13, 0.4))},
}


def flipped(preset, name):
    changes = SWITCHES[name]
    one_fleet = preset != "oceans2020"
    return scenario(preset, {path: value for path, value in changes.items() if not (one_fleet and "fleets.1" in path)})


def assert_same(engine, referee, tolerance):
    for field in dataclasses.fields(engine):
        one, other = getattr(engine, field.name), getattr(referee, field.name)
        np.testing.assert_allclose(one, other, rtol=0, atol=tolerance, err_msg=field.name)


def assert_steps_agree(chosen, states, tolerance=1e-12):
    """One step from each of so many states along a run: what moves, and what the step counts."""
    simulation, model = Simulation(chosen), model_of(chosen)
    for _ in range(states):
        expected, seen = oracle_step(simulation, model, state_of(simulation))
        before = [part.copy() for part in simulation.tally]
        simulation.advance(1)
        assert_same(state_of(simulation), expected, tolerance)
        gained = type(simulation.tally)(*(now - then for now, then in zip(simulation.tally, before, strict=True)))
        assert_counts_agree(gained, [seen], chosen, tolerance / chosen.time_step)
        simulation.advance(APART)


def assert_counts_agree(tally, measures, chosen, tolerance):
    """The engine's sums over these steps, all batches together, are the oracle's."""
    ends = np.cumsum([fleet.count for fleet in chosen.fleets])[:-1]
    fluctuations = sum(seen.fluctuations for seen in measures) / chosen.time_step
    bins = [np.stack([np.bincount(part, minlength=11) for part in np.split(seen.phi_bin, ends)]) for seen in measures]
    still = [[np.count_nonzero(part == 0.0) for part in np.split(seen.phi, ends)] for seen in measures]
    assert tally.steps.sum() == tally.present.sum() == len(measures)
    assert tally.on_target.sum() == sum(seen.f_any for seen in measures)
    assert tally.engaged.sum() == sum(seen.on_target_count for seen in measures)
    assert tally.histogram.sum(axis=0).tolist() == sum(bins).tolist()
    assert tally.stationary.sum(axis=0).tolist() == np.sum(still, axis=0).tolist()
    expected = [part.sum() for part in np.split(fluctuations, ends)]
    np.testing.assert_allclose(tally.fluctuation.sum(axis=0), expected, rtol=1e-12, atol=tolerance * chosen.agents)


class TestOneStep:
    """From the same state, with the same chance, to the same state and the same counts."""

    @pytest.mark.parametrize("preset", PRESETS)
    def test_of_each_preset(self, preset):
        assert_steps_agree(scenario(preset), STATES)

    @pytest.mark.parametrize("name", SWITCHES)
    @pytest.mark.parametrize("preset", PRESETS[:2])
    def test_with_each_switch_flipped(self, preset, name):
        """Without a cap, pushes of 1000 m and more leave a remainder of some meters, and with it their rounding."""
        tolerance = 1e-11 if name == "speed divided" else 1e-12
        assert_steps_agree(flipped(preset, name), STATES_OF_A_VARIANT, tolerance)

    @pytest.mark.parametrize(("agents", "neighbors"), SIZES)
    def test_of_swarms_of_any_size_with_any_number_of_neighbors(self, agents, neighbors):
        assert_steps_agree(small(agents, neighbors), STATES_OF_A_VARIANT)

    @pytest.mark.parametrize(("agents", "neighbors"), SIZES)
    def test_of_any_size_one_after_the_other(self, agents, neighbors):
        assert_steps_agree(small(agents, neighbors, preset="aamas2020"), STATES_OF_A_VARIANT)

    @pytest.mark.parametrize("seed", [0, 1, 2**32, 2**64 - 1])
    def test_with_any_seed(self, seed):
        assert_steps_agree(scenario("oceans2020", {"seed": seed}), STATES_OF_A_VARIANT)

    def test_of_a_later_run(self):
        chosen = scenario()
        simulation = Simulation(chosen, run=1234)
        expected, _ = oracle_step(simulation, model_of(chosen), state_of(simulation))
        simulation.advance(1)
        assert_same(state_of(simulation), expected, 1e-12)


class TestOneStepWithTies:
    """Equal distances and shared places, which a run reaches only in the corners of its arena."""

    @staticmethod
    def assert_agrees(chosen, x, target=(0.3, 0.4)):
        simulation, model = Simulation(chosen), model_of(chosen)
        simulation.advance(1)
        put_state(simulation, dataclasses.replace(state_of(simulation), x=np.array(x, float), target=np.array(target)))
        expected, seen = oracle_step(simulation, model, state_of(simulation))
        simulation.advance(1)
        assert_same(state_of(simulation), expected, 1e-12)
        return seen

    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    @pytest.mark.parametrize("neighbors", [1, 2, 3, 4, 7, 12, 20, 48])
    def test_on_a_square_grid(self, order, neighbors):
        grid = [(i - 3.0, j - 3.0) for i in range(7) for j in range(7)]
        self.assert_agrees(small(49, neighbors, {"motion.update_order": order}), grid)

    @pytest.mark.parametrize("order", ["synchronous", "sequential"])
    @pytest.mark.parametrize("neighbors", [1, 3, 6, 7])
    def test_all_at_one_place(self, order, neighbors):
        seen = self.assert_agrees(small(8, neighbors, {"motion.update_order": order}), np.zeros((8, 2)))
        assert seen.on_target.all()

    @pytest.mark.parametrize("neighbors", [1, 5, 19, 28])
    def test_pairs_at_one_place(self, neighbors):
        spots = np.random.default_rng(5).uniform(-8, 8, (15, 2))
        self.assert_agrees(small(30, neighbors), np.repeat(spots, 2, axis=0))

    @pytest.mark.parametrize("follow", ["nearest", "lowest-index"])
    def test_two_leaders_equally_near(self, follow):
        chosen = small(4, 3, {"strategy.follow": follow, "targets.0.radius": 2.5})
        seen = self.assert_agrees(chosen, [(2.0, 0.0), (-2.0, 0.0), (0.0, 3.0), (0.0, -3.0)], target=(0.0, 0.0))
        assert seen.followed.tolist() == [0, 1, 0, 0]


class TestThirtySteps:
    """On their own, engine and oracle stay together as long as rounding allows."""

    @pytest.mark.parametrize("preset", PRESETS)
    def test_from_states_along_a_run(self, preset):
        chosen = scenario(preset)
        simulation, model = Simulation(chosen), model_of(chosen)
        for _ in range(5):
            expected = state_of(simulation)
            for _ in range(30):
                expected, _ = oracle_step(simulation, model, expected)
                simulation.advance(1)
            assert_same(state_of(simulation), expected, 1e-8)
            simulation.advance(100)


class TestTally:
    """300 steps that the oracle drives: the engine's sums are those of the oracle's measures."""

    STEPS = 300

    @pytest.mark.parametrize(
        ("preset", "makes"),
        [
            ("oceans2020", [(50, 1.0)]),
            ("oceans2020", [(15, 2.6), (35, 1.0)]),
            ("oceans2020", [(10, 2.6), (27, 1.0), (13, 0.4)]),
            ("aamas2020", [(10, 2.6), (27, 1.0), (13, 0.4)]),
        ],
    )
    def test_sums_by_fleet_and_by_batch(self, preset, makes):
        chosen = scenario(preset, {"fleets": fleets(*makes), "steps": self.STEPS})
        simulation, model = Simulation(chosen), model_of(chosen)
        simulation.advance(0)
        measures, state = [], state_of(simulation)
        for _ in range(self.STEPS):
            put_state(simulation, state)
            state, seen = oracle_step(simulation, model, state)
            simulation.advance(1)
            measures.append(seen)
        assert_counts_agree(simulation.tally, measures, chosen, 1e-10)
        batches = simulation.tally.steps.size
        assert batches == 20
        for batch in range(batches):
            of_batch = type(simulation.tally)(*(part[batch : batch + 1] for part in simulation.tally))
            assert_counts_agree(of_batch, measures[batch * 15 : batch * 15 + 15], chosen, 1e-10)

    def test_the_target_is_found_and_lost_in_these_steps(self):
        """Or the sums would prove little."""
        simulation = Simulation(scenario("oceans2020", {"steps": self.STEPS}))
        simulation.advance(self.STEPS)
        assert 0.1 < simulation.tally.on_target.sum() / self.STEPS < 0.9


class TestPresets:
    """The presets are the oracle's: two readings of one paper."""

    @pytest.mark.parametrize(
        ("preset", "model"),
        [
            ("oceans2020", oracle.oceans2020()),
            ("aamas2020", oracle.aamas2020(k=20)),
        ],
    )
    def test_every_switch(self, preset, model):
        ours = model_of(scenario(preset))
        for field in dataclasses.fields(model):
            mine, theirs = getattr(ours, field.name), getattr(model, field.name)
            assert mine == pytest.approx(theirs, rel=3e-3) if isinstance(theirs, float) else np.all(mine == theirs)

    def test_a_constant_repulsion_never_changes(self):
        simulation = Simulation(scenario("aamas2020-constant"))
        simulation.advance(500)
        assert simulation.tally.on_target.sum() > 0
        assert set(simulation.memories.memory["repulsion"][:50].tolist()) == {oracle.A_START}
