"""The oracle as a whole is right: what it measures, orders of update, symmetries, presets, runs."""

import dataclasses
import math

import numpy as np
import pytest

import oracle
from oracle import A_START, PHI_CENTERS, Model, aamas2020, aamas2020_constant, oceans2020, run, step
from oracle_states import PUSHED, STILL, advance, assert_same, model, spread, state


class TestFluctuations:
    """|v_i - mean v| at the start of the step."""

    def test_by_hand(self):
        start = state([(0, 0), (50, 0), (0, 50)], v=[(3, 0), (0, 3), (0, 0)])
        _, seen = advance(model(n=3), start)
        assert seen.fluctuations == pytest.approx((math.sqrt(5), math.sqrt(5), math.sqrt(2)))

    def test_agents_in_formation_do_not_fluctuate(self):
        start = state([(0, 0), (50, 0), (0, 50)], v=[(3, 1)] * 3)
        _, seen = advance(model(n=3), start)
        assert seen.fluctuations == pytest.approx((0, 0, 0), abs=1e-15)


class TestPhi:
    """Cosine between heading and bearing, after the move, target before its own."""

    def phi(self, v, x=(0.0, 0.0), target=(3.0, 0.0), **switches):
        start = state(
            [x, (900, 900)],
            v=[v, (0, 0)],
            a=0.0,
            target=target,
            heading=(0.0, 1.0),
            waypoint=(3.0, 90.0),
        )
        return advance(model(**{"rho": 0.0, **STILL, **switches}), start)[1].phi[0]

    def test_toward_away_and_across(self):
        assert self.phi((1, 0), max_speed=1.0) == 1.0
        assert self.phi((-1, 0), max_speed=1.0) == -1.0
        assert self.phi((0, 1), x=(3, 0), max_speed=1.0) == -1.0

    def test_the_bearing_is_taken_after_the_agents_move_and_before_the_targets(self):
        """The agent arrives at (0, 4) while the target is at (3, 0); then the target goes on to (3, 50)."""
        assert self.phi((0, 4), max_speed=10.0, target_speed=50.0) == pytest.approx(-4 / 5)

    def test_it_never_leaves_the_interval(self):
        _, seen = advance(oceans2020(), spread(oceans2020()), r=0.5)
        assert (np.abs(seen.phi) <= 1.0).all()

    def test_slower_than_a_tenth_of_the_top_speed_is_stationary(self):
        assert self.phi((0.1249, 0), max_speed=1.25) == 0.0

    def test_exactly_a_tenth_is_not(self):
        tenth = 0.1 * 1.25
        assert self.phi((tenth, 0), max_speed=1.25) == 1.0

    def test_a_tenth_is_of_ones_own_top_speed(self):
        x, v = [(0, 0), (0, 900)], [(0.2, 0), (0.2, 0)]
        start = state(x, v, a=0.0, target=(900.0, 0.0))
        _, seen = advance(model(max_speed=[1.0, 2.6], **STILL), start)
        assert seen.phi.tolist() == [1.0, 0.0]

    def test_at_the_target_there_is_no_bearing(self):
        with np.errstate(all="raise"):
            assert self.phi((3, 0)) == 0.0

    def test_an_agent_that_cannot_move_is_stationary(self):
        with np.errstate(all="raise"):
            assert self.phi((1, 0), max_speed=0.0) == 0.0

    def test_the_heading_is_the_one_before_the_clamp(self):
        """An agent pressing on the east wall heads north-east, though it slides north."""
        phi = self.phi((1, 1), x=(8.5, 0), target=(8.5, 9), clamp_x=8.5, max_speed=2.0)
        assert phi == pytest.approx(math.sqrt(0.5))

    def test_stationary_is_judged_after_the_clamp(self):
        """An agent pressing on the east wall with all its might stands still; one that slides along it does not."""
        assert self.phi((1, 0), x=(8.5, 0), target=(0, 0), clamp_x=8.5, max_speed=2.0) == 0.0
        sliding = self.phi((1, 1), x=(8.5, 0), target=(0, 1), clamp_x=8.5, max_speed=2.0)
        assert sliding == pytest.approx(-math.sqrt(0.5))

    def test_stationary_is_judged_after_the_cap(self):
        assert self.phi((1, 0), max_speed=0.1) == 1.0

    def test_the_bins_are_centered_and_the_outer_ones_half_as_wide(self):
        assert oracle.bin_of(PHI_CENTERS).tolist() == list(range(11))
        for edge, lower in [(-0.9, 0), (-0.7, 1), (-0.1, 4), (0.1, 5), (0.7, 8), (0.9, 9)]:
            assert oracle.bin_of(np.array([edge - 1e-9, edge + 1e-9])).tolist() == [lower, lower + 1]

    def test_a_value_on_an_edge_belongs_to_the_upper_bin(self):
        assert oracle.bin_of(np.array([-0.9, -0.5, -0.1, 0.1, 0.5, 0.9])).tolist() == [1, 3, 5, 6, 8, 10]

    def test_the_stationary_are_in_the_middle_bin(self):
        _, seen = advance(model(**STILL), state([(0, 0), (900, 0)], a=0.0))
        assert seen.phi_bin.tolist() == [5, 5]


class TestUpdateOrder:
    """Synchronous: everybody reads the state at t. Sequential: later agents see the moved ones."""

    def test_synchronous_by_hand(self):
        new, _ = advance(model(n=3, k=1, **STILL), state(**PUSHED))
        assert new.v[0].tolist() == [1 - 1 / 64, 0.0]
        assert new.v[1].tolist() == [1 / 64, 0.0]

    def test_sequential_by_hand(self):
        new, _ = advance(model(n=3, k=1, update="sequential", **STILL), state(**PUSHED))
        assert new.v[0].tolist() == [1 - 1 / 64, 0.0]
        assert new.v[1, 0] == pytest.approx((1 + 1 / 64) ** -6)  # agent 0 now stands at 1 - 1/64

    def test_sequential_neighbors_are_those_of_the_moved_swarm(self):
        x, v = [(0, 0), (10, 0), (14, 0)], [(9, 0), (0, 0), (0, 0)]
        still = {"n": 3, "k": 1, "a_up": 0.0}
        assert advance(model(**still), state(x, v, a=0.0))[1].neighbors.tolist() == [[1], [2], [1]]
        moved = model(update="sequential", **still)
        assert advance(moved, state(x, v, a=0.0))[1].neighbors.tolist() == [[1], [0], [1]]

    def test_sequential_followers_run_to_where_the_followed_is_now(self):
        x, v = [(0, 0), (8, 0)], [(0, 2), (0, 0)]
        both = state(x, v, a=0.0, target=(0, 0))
        assert advance(model(**STILL), both, r=0.5)[0].v[1].tolist() == [-2.0, 0.0]
        assert advance(model(update="sequential", **STILL), both, r=0.5)[0].v[1].tolist() == [-2.0, 0.5]

    def test_the_first_agent_cannot_tell_the_difference(self):
        one, other = aamas2020(k=10), dataclasses.replace(aamas2020(k=10), update="synchronous")
        start = spread(one)
        a, b = advance(one, start, r=0.5)[0], advance(other, start, r=0.5)[0]
        assert a.x[0].tolist() == b.x[0].tolist()
        assert np.abs(a.x - b.x).max() > 1e-3

    def test_sequential_is_one_synchronous_step_per_agent(self):
        """Agent i moves as in a synchronous step after the earlier ones moved, but with the old detection."""
        preset = aamas2020(k=7)
        start = spread(preset)
        r = np.random.default_rng(0).random(50)
        on_target = preset.on_target(start.x, start.target)

        class Blind(Model):
            def on_target(self, x, target):
                return on_target

        expected, blind = start.copy(), Blind(**{**vars(preset), "update": "synchronous"})
        for i in range(50):
            moved, _ = advance(blind, expected, r=r)
            expected.x[i], expected.v[i], expected.a[i] = moved.x[i], moved.v[i], moved.a[i]
        new, _ = advance(preset, start, r=r)
        np.testing.assert_allclose(new.x, expected.x, rtol=0, atol=1e-14)
        np.testing.assert_allclose(new.a, expected.a, rtol=0, atol=0)


class TestSymmetries:
    """The model knows no direction but the arena's; a synchronous one knows no order of agents."""

    presets = pytest.mark.parametrize(
        "preset",
        [oceans2020(), aamas2020(k=19), dataclasses.replace(oceans2020(), speed_rule="divide")],
    )

    @staticmethod
    def mapped(state, matrix, shift=(0.0, 0.0)):
        matrix, shift = np.array(matrix, dtype=float), np.array(shift)
        points = {name: getattr(state, name) @ matrix.T + shift for name in ("x", "target", "waypoint")}
        return dataclasses.replace(
            state.copy(),
            **points,
            v=state.v @ matrix.T,
            heading=state.heading @ matrix.T,
        )

    @presets
    @pytest.mark.parametrize("matrix", [[[0, -1], [1, 0]], [[-1, 0], [0, 1]], [[0, 1], [1, 0]]])
    def test_quarter_turns_and_mirrors(self, preset, matrix):
        start = spread(preset)
        r = np.random.default_rng(0).random(50)
        new, seen = advance(preset, start, r=r)
        mapped, seen_mapped = advance(preset, self.mapped(start, matrix), r=r)
        assert_same(self.mapped(new, matrix), mapped, atol=1e-12)
        assert_same(seen, seen_mapped, atol=1e-12)

    def test_any_turn_and_shift_where_there_are_no_walls(self):
        preset = dataclasses.replace(oceans2020(), clamp_x=1e6, clamp_y=1e6)
        start = spread(oceans2020())
        r = np.random.default_rng(0).random(50)
        cos, sin = math.cos(0.7), math.sin(0.7)
        motion = ([[cos, -sin], [sin, cos]], (3.0, -5.0))
        new, seen = advance(preset, start, r=r)
        moved, seen_moved = advance(preset, self.mapped(start, *motion), r=r)
        np.testing.assert_allclose(self.mapped(new, *motion).x, moved.x, rtol=0, atol=1e-9)
        np.testing.assert_allclose(self.mapped(new, *motion).target, moved.target, rtol=0, atol=1e-9)
        np.testing.assert_allclose(seen.phi, seen_moved.phi, rtol=0, atol=1e-9)
        assert (seen.neighbors == seen_moved.neighbors).all()

    def test_renumbering_a_synchronous_swarm(self):
        preset = oceans2020()
        start = spread(preset)
        r = np.random.default_rng(0).random(50)
        order = np.random.default_rng(1).permutation(50)
        renumbered = dataclasses.replace(start.copy(), x=start.x[order], v=start.v[order], a=start.a[order])
        new, seen = advance(preset, start, r=r)
        other, seen_other = advance(
            dataclasses.replace(preset, max_speed=preset.max_speed[order]),
            renumbered,
            r=r[order],
        )
        np.testing.assert_allclose(new.x[order], other.x, rtol=0, atol=1e-14)
        np.testing.assert_allclose(seen.phi[order], seen_other.phi, rtol=0, atol=1e-12)
        assert (seen.neighbors[order] == order[seen_other.neighbors]).all()

    def test_two_free_agents_keep_their_center(self):
        now = state([(-0.5, 0.2), (0.5, -0.3)], a=0.8)
        for _ in range(20):
            now, _ = advance(model(omega=0.9), now)
        assert now.x.sum(axis=0) == pytest.approx((0.0, -0.1))


class TestStep:
    """One step as a function."""

    def test_it_leaves_its_input_alone(self):
        preset = oceans2020()
        start = spread(preset)
        before = start.copy()
        start.steps_on_waypoint = before.steps_on_waypoint = 199  # so that even the waypoint changes
        advance(preset, start, r=0.5)
        assert_same(start, before)

    def test_a_copy_shares_nothing(self):
        start = spread(oceans2020())
        copy = start.copy()
        assert_same(start, copy)
        for field in dataclasses.fields(start):
            if field.name != "steps_on_waypoint":
                assert not np.shares_memory(getattr(start, field.name), getattr(copy, field.name))

    @pytest.mark.parametrize(
        "wrong",
        [{"k": 50}, {"k": 0}, {"update": "random"}, {"follow": "best"}, {"speed_rule": "none"}],
    )
    def test_a_model_that_means_nothing_is_refused(self, wrong):
        with pytest.raises(AssertionError):
            dataclasses.replace(oceans2020(), **wrong)


class TestPresets:
    """The table of presets."""

    def test_oceans2020(self):
        preset = oceans2020(fast=15, k=18, target_speed=0.5)
        assert (preset.n, preset.k, preset.target_speed) == (50, 18, 0.5)
        assert (preset.max_speed == 0.26).sum() == 15
        assert (preset.max_speed == 0.10).sum() == 35
        assert (preset.omega, preset.c, preset.d, preset.a_up, preset.a_down) == (1.0, 0.5, 6.0, 0.01, 0.01)
        assert (preset.update, preset.follow, preset.speed_rule) == ("synchronous", "nearest", "cap")

    def test_aamas2020(self):
        preset = aamas2020(k=19)
        assert (preset.max_speed == 0.10).all()
        assert (preset.n, preset.k, preset.target_speed, preset.omega, preset.c) == (50, 19, 0.2, 0.5, 0.5)
        assert (preset.a_up, preset.a_down) == pytest.approx((0.02507, 0.05013), abs=5e-6)
        assert (preset.a_min, preset.a_max) == (0.375, 1.5)
        assert (preset.update, preset.follow) == ("sequential", "lowest-index")

    def test_aamas2020_constant_differs_in_the_repulsion_alone(self):
        constant = dataclasses.replace(aamas2020(k=19), a_up=0.0, a_down=0.0)
        for field in dataclasses.fields(Model):
            assert np.all(getattr(aamas2020_constant(k=19), field.name) == getattr(constant, field.name))
        assert (spread(constant).a == A_START).all()

    def test_the_start(self):
        assert pytest.approx(0.5013, abs=5e-5) == A_START
        start = oracle.random_start(oceans2020(), np.random.default_rng(0))
        assert not start.v.any()
        assert (start.a == A_START).all()
        assert np.abs(start.x).max() <= 10.0
        assert np.abs([start.target, start.waypoint]).max() <= 8.0
        assert np.hypot(*start.heading) == pytest.approx(1.0)


class TestRun:
    """Averages over steps."""

    def test_they_are_those_of_its_steps(self):
        preset = oceans2020(k=5)
        rng = np.random.default_rng(3)
        now = start = oracle.random_start(preset, rng)
        averages = run(preset, start, 20, np.random.default_rng(4))
        rng = np.random.default_rng(4)
        seen = []
        for _ in range(20):
            now, measures = step(preset, now, rng.random(50), oracle.random_waypoint(preset, rng))
            seen.append(measures)
        assert_same(averages.state, now)
        assert averages.time_on_target == np.mean([one.f_any for one in seen])
        assert averages.response == pytest.approx(np.mean([one.fluctuations.sum() for one in seen]))
        assert averages.phi_histogram[5] == pytest.approx(np.mean([(one.phi_bin == 5).sum() for one in seen]))

    def test_xi_is_the_response_per_agent_and_mean_top_speed(self):
        averages = run(oceans2020(fast=15), spread(oceans2020(fast=15)), 5, np.random.default_rng(0))
        assert averages.xi_raw == pytest.approx(averages.response / 50)
        assert averages.xi == pytest.approx(averages.xi_raw / 0.148)

    def test_the_histogram_sums_to_the_number_of_agents(self):
        averages = run(aamas2020(k=10), spread(aamas2020(k=10)), 20, np.random.default_rng(0))
        assert averages.phi_histogram.sum() == pytest.approx(50)

    def test_per_axis_draws(self):
        preset = dataclasses.replace(oceans2020(), per_axis_r=True)
        averages = run(preset, spread(oceans2020()), 5, np.random.default_rng(0))
        assert np.isfinite(averages.state.x).all()

    def test_the_same_seed_gives_the_same_bits(self):
        start = spread(oceans2020())
        one, other = (run(oceans2020(), start, 50, np.random.default_rng(7)) for _ in range(2))
        assert_same(one.state, other.state)
        assert one.response == other.response

    def test_the_mixed_swarm_finds_its_target(self):
        preset = oceans2020()
        rng = np.random.default_rng(0)
        averages = run(preset, oracle.random_start(preset, rng), 1500, rng)
        assert 0.5 < averages.time_on_target < 1.0
