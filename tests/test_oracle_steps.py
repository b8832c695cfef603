"""Each step of the oracle is right: closed forms and cases small enough for a hand."""

import dataclasses
import math

import numpy as np
import pytest

from oracle import oceans2020, step
from oracle_states import EAST, LONE, STILL, TURNING, advance, assert_same, model, spread, state


class TestStep1Detection:
    """f_i = -1 if |x_i - target| <= rho."""

    def test_an_agent_at_exactly_rho_is_on_target(self):
        x = [(0.0, 1.0), (0.0, -1.0000001), (0.3, 0.4), (5.0, 0.0)]
        _, seen = advance(model(n=4), state(x, target=(0.0, 0.0)))
        assert seen.on_target.tolist() == [True, False, True, False]
        assert (seen.f_any, seen.on_target_count) == (True, 2)

    def test_nobody_on_target(self):
        _, seen = advance(model(), state([(0, 0), (1, 0)]))
        assert (seen.f_any, seen.on_target_count) == (False, 0)

    def test_rho_is_a_parameter(self):
        _, seen = advance(model(rho=100.0), state([(0, 0), (-1, 0)]))
        assert seen.on_target.tolist() == [True, False]

    def test_detection_precedes_the_move(self):
        leaving = state([(0, 0.5), (9, 9)], v=[(0, 5), (0, 0)], target=(0.0, 0.0))
        new, seen = advance(model(), leaving)
        assert seen.f_any
        assert np.hypot(*new.x[0]) > 1.0

    @pytest.mark.parametrize("update", ["synchronous", "sequential"])
    def test_detection_precedes_everybodys_move(self, update):
        """Agent 0 leaves the target before agent 1 has its turn, and agent 1 follows it all the same."""
        leaving = state([(0, 0), (0, 9)], v=[(50, 0), (0, 0)], target=(0.0, 0.0))
        _, seen = advance(model(update=update), leaving)
        assert seen.followed.tolist() == [0, 0]


class TestStep2Neighbors:
    """The k nearest other agents; ties: lower index first."""

    def test_sorted_by_distance(self):
        _, seen = advance(model(n=4, k=3), state([(0, 0), (3, 0), (1, 0), (7, 0)]))
        assert seen.neighbors.tolist() == [[2, 1, 3], [2, 0, 3], [0, 1, 3], [1, 2, 0]]

    def test_k_cuts_the_list(self):
        _, seen = advance(model(n=4, k=1), state([(0, 0), (3, 0), (1, 0), (7, 0)]))
        assert seen.neighbors.tolist() == [[2], [2], [0], [1]]

    def test_ties_go_to_the_lower_index(self):
        _, seen = advance(model(n=5, k=4), state([(0, 1), (1, 0), (0, -1), (-1, 0), (0, 0)]))
        assert seen.neighbors[4].tolist() == [0, 1, 2, 3]
        assert seen.neighbors[2].tolist() == [4, 1, 3, 0]

    def test_one_never_hears_oneself_not_even_among_agents_at_the_same_place(self):
        _, seen = advance(model(n=3, k=2), state(np.zeros((3, 2))))
        assert seen.neighbors.tolist() == [[1, 2], [0, 2], [0, 1]]

    def test_ties_in_a_large_swarm_too(self):
        _, seen = advance(model(n=50, k=49), state(np.zeros((50, 2))))
        assert all(seen.neighbors[i].tolist() == [j for j in range(50) if j != i] for i in range(50))

    def test_the_graph_is_not_symmetric(self):
        _, seen = advance(model(n=3, k=1), state([(0, 0), (1, 0), (3, 0)]))
        assert seen.neighbors[2].tolist() == [1]
        assert seen.neighbors[1].tolist() == [0]


class TestStep3WhoIsFollowed:
    """x_i if on target, else the position of a neighbor on target, else x_i."""

    x = ((0.0, 0.0), (6.5, 0.0), (5.5, 0.0), (4.0, 0.0))  # target at (6, 0): agents 1 and 2 are on it

    def seen(self, k, **switches):
        return advance(model(n=4, k=k, **switches), state(self.x, target=(6.0, 0.0)))[1]

    def test_the_nearest_neighbor_on_target(self):
        assert self.seen(k=3).followed.tolist() == [2, 1, 2, 2]

    def test_the_lowest_index_on_target(self):
        assert self.seen(k=3, follow="lowest-index").followed.tolist() == [1, 1, 2, 1]

    def test_the_lowest_index_is_taken_among_neighbors_only(self):
        assert self.seen(k=2, follow="lowest-index").followed.tolist() == [2, 1, 2, 1]

    def test_nobody_when_no_neighbor_is_on_target(self):
        assert self.seen(k=1).followed.tolist() == [-1, 1, 2, 2]

    def test_the_nearer_of_two_wins_whatever_its_index(self):
        x = [(0, 0), (0, 3), (0, 2.5)]
        _, seen = advance(model(n=3, k=2), state(x, target=(0.0, 3.0)))
        assert seen.followed[0] == 2

    def test_equally_near_the_lower_index_wins(self):
        x = [(0.5, 2), (-0.5, 2), (0, 0)]
        _, seen = advance(model(n=3, k=2), state(x, target=(0.0, 2.0)))
        assert seen.followed[2] == 0


class TestStep4AdaptiveRepulsion:
    """Algorithm 1 to the letter."""

    def raised(self, a, **switches):
        return advance(model(**switches), state([(0, 0), (9, 0)], a=a))[0].a[0]

    def lowered(self, a, **switches):
        return advance(model(**switches), state([(0, 0), (9, 0)], a=a, target=(0, 0)))[0].a[0]

    def test_exploring_raises_it(self):
        assert self.raised(1.0) == 1.0 + 0.01

    def test_being_on_target_lowers_it(self):
        assert self.lowered(1.0) == 1.0 - 0.01

    def test_a_neighbor_on_target_lowers_it(self):
        new, _ = advance(model(n=3, k=1), state([(0, 0), (2, 0), (5, 0)], target=(0, 0)))
        assert new.a.tolist() == [0.99, 0.99, 1.01]

    def test_just_above_the_minimum_it_goes_one_delta_below(self):
        a = np.nextafter(0.375, 1.0)
        assert self.lowered(a) == a - 0.01 < 0.375

    def test_at_the_minimum_or_below_it_stays(self):
        assert self.lowered(0.375) == 0.375
        assert self.lowered(0.366) == 0.366

    def test_just_below_the_maximum_it_goes_one_delta_above(self):
        a = np.nextafter(1.5, 0.0)
        assert self.raised(a) == a + 0.01 > 1.5

    def test_at_the_maximum_or_above_it_stays(self):
        assert self.raised(1.5) == 1.5
        assert self.raised(1.509) == 1.509

    def test_out_of_range_it_still_moves_back(self):
        assert self.raised(0.366) == 0.366 + 0.01
        assert self.lowered(1.509) == 1.509 - 0.01

    def test_up_and_down_are_separate(self):
        assert self.raised(1.0, a_up=0.25, a_down=0.125) == 1.25
        assert self.lowered(1.0, a_up=0.25, a_down=0.125) == 0.875

    def test_the_push_of_the_same_step_uses_the_new_strength(self):
        new, _ = advance(model(a_up=0.25), state([(0, 0), (1.25, 0)], a=1.0))
        assert new.v.tolist() == [[-1.0, 0.0], [1.0, 0.0]]


class TestStep5Velocity:
    """omega v_i + c r (Nbest - x_i) + sum of (a_R / r_ij)^d (x_i - x_j) / r_ij."""

    def test_inertia(self):
        start = state([(0, 0), (1e9, 0)], v=[(1, 2), (0, 0)])
        new, _ = advance(model(omega=0.5, **STILL), start)
        assert new.v[0] == pytest.approx((0.5, 1.0))

    def test_the_pull_is_c_r_times_the_way_to_the_followed(self):
        start = state([(0, 0), (8, 4)], a=0.0, target=(8, 4))
        new, _ = advance(model(c=0.5, **STILL), start, r=[0.25, 0.75])
        assert new.v.tolist() == [[1.0, 0.5], [0.0, 0.0]]

    def test_both_axes_share_a_draw_unless_told_otherwise(self):
        start = state([(0, 0), (8, 4)], a=0.0, target=(8, 4))
        new, _ = advance(model(per_axis_r=True, **STILL), start, r=[(0.25, 0.5), (1, 1)])
        assert new.v[0].tolist() == [1.0, 1.0]

    def test_equal_draws_for_both_axes_are_a_shared_draw(self):
        start = spread(oceans2020(k=5))
        r = np.random.default_rng(1).random(50)
        one = step(oceans2020(k=5), start, r, np.zeros(2))[0]
        two = step(
            dataclasses.replace(oceans2020(k=5), per_axis_r=True),
            start,
            np.stack([r, r], 1),
            np.zeros(2),
        )[0]
        assert_same(one, two)

    @pytest.mark.parametrize("r", [np.zeros((2, 2)), np.zeros(3), 0.0])
    def test_draws_of_another_shape_are_refused(self, r):
        with pytest.raises(AssertionError):
            step(model(), state([(0, 0), (1, 0)]), r, np.zeros(2))

    def test_at_spacing_a_the_push_is_one_unit_per_step(self):
        new, _ = advance(model(**STILL), state([(0, 0), (0, 1.5)], a=1.5))
        assert new.v.tolist() == [[0.0, -1.0], [0.0, 1.0]]

    def test_at_twice_the_spacing_it_is_a_64th(self):
        new, _ = advance(model(**STILL), state([(0, 0), (2, 0)], a=1.0))
        assert new.v.tolist() == [[-1 / 64, 0.0], [1 / 64, 0.0]]

    def test_the_exponent_is_a_parameter(self):
        new, _ = advance(model(d=2.0, **STILL), state([(0, 0), (2, 0)], a=1.0))
        assert new.v[0].tolist() == [-0.25, 0.0]

    def test_each_agent_pushes_itself_away_with_its_own_strength(self):
        new, _ = advance(model(**STILL), state([(0, 0), (1, 0)], a=[1.0, 2.0]))
        assert new.v.tolist() == [[-1.0, 0.0], [64.0, 0.0]]

    def test_pushes_add_up(self):
        new, _ = advance(model(n=3, k=2, **STILL), state([(0, 0), (1, 0), (0, 2)], a=1.0))
        assert new.v[0] == pytest.approx((-1.0, -1 / 64))

    def test_only_neighbors_push(self):
        new, _ = advance(model(n=3, k=1, **STILL), state([(0, 0), (1, 0), (0, 2)], a=1.0))
        assert new.v[0].tolist() == [-1.0, 0.0]

    def test_inside_a_ring_nothing_pushes(self):
        angles = np.arange(6) * math.pi / 3
        ring = np.vstack([[(0, 0)], np.stack([np.cos(angles), np.sin(angles)], 1)])
        new, _ = advance(model(n=7, k=6), state(ring, a=0.5))
        assert new.v[0] == pytest.approx((0.0, 0.0), abs=1e-15)

    def test_a_neighbor_at_the_same_place_gives_no_push(self):
        with np.errstate(all="raise"):
            new, _ = advance(model(n=3, k=2, **STILL), state([(0, 0), (0, 0), (1, 0)], a=1.0))
        assert new.v.tolist() == [[-1.0, 0.0], [-1.0, 0.0], [2.0, 0.0]]

    def test_a_whole_swarm_at_the_same_place_stays_there(self):
        with np.errstate(all="raise"):
            new, seen = advance(model(n=4, k=3), state(np.zeros((4, 2)), target=(0, 0)), r=0.5)
        assert not new.x.any()
        assert not seen.phi.any()


class TestStep6SpeedRule:
    """Cap by default; "v <- v / vmax" as printed by request."""

    def test_too_fast_is_scaled_to_the_top_speed(self):
        new, _ = advance(model(max_speed=2.5), state(**LONE))
        assert new.v[0] == pytest.approx((1.5, 2.0))

    def test_slow_enough_is_left_alone(self):
        new, _ = advance(model(max_speed=2.5), state(**LONE))
        assert new.v[1].tolist() == [0.3, 0.4]

    def test_exactly_the_top_speed_is_left_alone(self):
        new, _ = advance(model(max_speed=5.0), state(**LONE))
        assert new.v[0].tolist() == [3.0, 4.0]

    def test_each_agent_has_its_own_top_speed(self):
        new, _ = advance(model(max_speed=[5.0, 0.25]), state(**LONE))
        assert new.v[0].tolist() == [3.0, 4.0]
        assert new.v[1] == pytest.approx((0.15, 0.2))

    def test_dividing_never_limits_bob_0_and_slows_bob_1(self):
        new, _ = advance(model(max_speed=[0.10, 0.26], speed_rule="divide"), state(**LONE))
        assert new.v[0] == pytest.approx((3.0, 4.0))
        assert new.v[1] == pytest.approx((0.3 / 2.6, 0.4 / 2.6))

    def test_nobody_exceeds_its_top_speed_in_a_run(self):
        preset = oceans2020()
        now = spread(preset, steps=1)
        rng = np.random.default_rng(0)
        for _ in range(100):
            before = now.x
            now, _ = advance(preset, now, r=rng.random(50), new_waypoint=rng.uniform(-8, 8, 2))
            assert (np.hypot(*now.v.T) <= preset.max_speed * (1 + 1e-12)).all()
            assert now.x - before == pytest.approx(now.v, abs=1e-14)


class TestStep7MoveAndClamp:
    """x <- x + v, clamped; where the clamp acted v is the displacement really made."""

    def test_a_free_agent_moves_by_its_velocity(self):
        new, _ = advance(model(), state([(1, 2), (1e3, 0)], v=[(0.5, 0.25), (0, 0)]))
        assert new.x[0] == pytest.approx((1.5, 2.25))
        assert new.v[0] == pytest.approx((0.5, 0.25))

    def test_at_the_wall_the_velocity_is_the_displacement(self):
        walls = model(n=4, clamp_x=8.5, clamp_y=6.5, a_up=0.0)
        x, v = [(8, 0), (0, -6), (-8, 6), (0, 0)], [(1, 0.25), (0.25, -1), (-1, 1), (0, 0)]
        new, _ = advance(walls, state(x, v, a=0.0))
        assert new.x.tolist() == [[8.5, 0.25], [0.25, -6.5], [-8.5, 6.5], [0, 0]]
        assert new.v.tolist() == [[0.5, 0.25], [0.25, -0.5], [-0.5, 0.5], [0, 0]]

    def test_pushing_on_against_the_wall_is_standing_still(self):
        new, _ = advance(model(clamp_x=8.5), state([(8.5, 0), (0, 0)], v=[(1, 0), (0, 0)], a=0.0))
        assert new.v[0].tolist() == [0.0, 0.0]

    def test_reaching_the_wall_exactly_is_free_movement(self):
        new, _ = advance(model(clamp_x=8.5, a_up=0.0), state([(8, 0), (0, 0)], v=[(0.5, 0), (0, 0)], a=0.0))
        assert (new.x[0, 0], new.v[0, 0]) == (8.5, 0.5)

    def test_starting_beyond_the_wall_is_being_put_inside_at_once_without_having_moved(self):
        outside = state([(10, 0), (0, 0)], a=0.0)
        new, _ = advance(model(clamp_x=8.5, max_speed=0.1, a_up=0.0), outside)
        assert (new.x[0, 0], new.v[0, 0]) == (8.5, 0.0)

    def test_agents_that_meet_in_a_corner_are_no_nan(self):
        corner = model(n=3, k=2, clamp_x=8.5, clamp_y=8.5)
        now = state([(8.4, 8.4), (8.45, 8.45), (0, 0)], v=[(1, 1), (1, 1), (0, 0)], a=0.0)
        with np.errstate(all="raise"):
            for _ in range(3):
                now, seen = advance(corner, now, r=0.5)
        assert now.x[:2].tolist() == [[8.5, 8.5], [8.5, 8.5]]
        assert np.isfinite(seen.phi).all()


class TestStep8Target:
    """Constant speed, at most turn_max per step, a new waypoint when reached or out of patience."""

    def move(self, heading=EAST, target=(0.0, 0.0), waypoint=(100.0, 0.0), steps_on_waypoint=0, **switches):
        far_away = [(500, 500), (-500, 500)]
        start = state(
            far_away,
            target=target,
            heading=heading,
            waypoint=waypoint,
            steps_on_waypoint=steps_on_waypoint,
        )
        return advance(model(**{**TURNING, **switches}), start, new_waypoint=(-7.0, 3.0))[0]

    def angle(self, **case):
        hx, hy = self.move(**case).heading
        return math.degrees(math.atan2(hy, hx))

    def test_it_goes_straight_to_a_waypoint_ahead(self):
        new = self.move()
        assert new.heading.tolist() == [1.0, 0.0]
        assert new.target.tolist() == [0.5, 0.0]

    def test_a_small_turn_is_made_in_full(self):
        assert self.angle(waypoint=(100, 100 * math.tan(math.radians(12)))) == pytest.approx(12)

    @pytest.mark.parametrize(
        ("waypoint", "turn"),
        [((0, 50), 20), ((0, -50), -20), ((-50, 1), 20), ((-50, -1), -20)],
    )
    def test_a_large_turn_is_made_the_shorter_way_and_in_part(self, waypoint, turn):
        assert self.angle(waypoint=waypoint) == pytest.approx(turn)

    @pytest.mark.parametrize("degrees", [0, 90, 180, 270])
    def test_a_waypoint_exactly_behind_is_turned_to_by_the_left(self, degrees):
        hx, hy = round(math.cos(math.radians(degrees))), round(math.sin(math.radians(degrees)))
        turned = self.move(heading=(hx, hy), waypoint=(-50 * hx, -50 * hy)).heading
        assert hx * turned[1] - hy * turned[0] == pytest.approx(math.sin(math.radians(20)))

    @pytest.mark.parametrize("heading", [(0.6, 0.8), (-0.6, -0.8), (0.6, -0.8), (-0.6, 0.8)])
    def test_a_waypoint_exactly_underneath_calls_for_no_turn(self, heading):
        assert self.move(heading=heading, waypoint=(0, 0)).heading == pytest.approx(heading)

    def test_it_moves_along_the_new_heading(self):
        new = self.move(waypoint=(0, 50))
        assert new.target == pytest.approx(0.5 * new.heading)

    def test_an_about_turn_takes_nine_steps(self):
        start = state([(500, 500), (-500, 500)], target=(0, 0), heading=EAST, waypoint=(-50, 0))
        turning = model(**{**TURNING, "target_speed": 0.0})
        for _ in range(8):
            start, _ = advance(turning, start)
        assert start.heading[0] > -0.95
        assert advance(turning, start)[0].heading == pytest.approx((-1.0, 0.0))

    def test_on_the_way_it_keeps_its_waypoint_and_counts(self):
        new = self.move(steps_on_waypoint=198)
        assert new.waypoint.tolist() == [100.0, 0.0]
        assert new.steps_on_waypoint == 199

    def test_the_200th_step_ends_its_patience(self):
        new = self.move(steps_on_waypoint=199)
        assert new.waypoint.tolist() == [-7.0, 3.0]
        assert new.steps_on_waypoint == 0

    def test_patience_lasts_exactly_200_steps(self):
        preset = dataclasses.replace(oceans2020(), target_speed=0.0, waypoint_reach=0.0)
        now = spread(preset, steps=1)
        now.steps_on_waypoint = 0
        taken_up = []
        for count in range(1, 402):
            before, (now, _) = now.waypoint, advance(preset, now, new_waypoint=now.waypoint + 0.01)
            if (now.waypoint != before).any():
                taken_up.append(count)
        assert taken_up == [200, 400]

    def test_closer_than_reach_it_is_reached(self):
        assert self.move(waypoint=(1.99, 0)).waypoint.tolist() == [-7.0, 3.0]

    def test_at_exactly_reach_it_is_not(self):
        assert self.move(waypoint=(2.0, 0)).waypoint.tolist() == [2.0, 0.0]

    def test_a_new_waypoint_turns_the_target_in_the_next_step(self):
        assert self.move(waypoint=(1.0, 0)).heading.tolist() == [1.0, 0.0]

    def test_it_cares_about_no_agent(self):
        near, far = state([(0, 0), (1, 0)], target=(0, 0)), state([(50, 0), (60, 0)], target=(0, 0))
        assert advance(model(), near)[0].target.tolist() == advance(model(), far)[0].target.tolist()

    def test_the_heading_stays_a_unit_vector_and_the_speed_constant(self):
        preset = oceans2020(k=1)
        now = spread(preset, steps=1)
        rng = np.random.default_rng(0)
        for _ in range(300):
            before = now
            now, _ = advance(preset, now, new_waypoint=rng.uniform(-8, 8, 2))
            assert np.hypot(*now.heading) == pytest.approx(1.0, abs=1e-15)
            assert np.hypot(*(now.target - before.target)) == pytest.approx(0.3, abs=1e-14)
            assert now.heading @ before.heading >= math.cos(math.radians(20)) - 1e-12
