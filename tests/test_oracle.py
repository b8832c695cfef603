"""The oracle is right: closed forms, symmetries and cases small enough for a hand."""

import dataclasses
import math

import numpy as np
import pytest

import oracle
from oracle import A_START, PHI_CENTERS, Model, State, aamas2020, aamas2020_constant, oceans2020, run, step

FAR = (100.0, 0.0)  # a target nobody detects
EAST = (1.0, 0.0)

STILL = {"a_up": 0.0, "a_down": 0.0}  # repulsion strengths that stay what they are
LONE = {"x": [(0, 0), (1e9, 0)], "v": [(3, 4), (0.3, 0.4)]}  # two agents too far apart to push
PUSHED = {"x": [(0, 0), (2, 0), (9, 9)], "v": [(1, 0), (0, 0), (0, 0)]}  # agent 0 runs at agent 1
TURNING = {"turn_max": math.radians(20), "target_speed": 0.5}


def model(n=2, k=1, max_speed=100.0, **switches):
    """n agents whose top speed and arena do not interfere, unless asked to."""
    switches = {"clamp_x": 1e12, "clamp_y": 1e12, **switches}
    return Model(max_speed=np.broadcast_to(max_speed, n), k=k, **switches)


def state(x, v=None, a=1.0, target=FAR, heading=EAST, waypoint=(200.0, 0.0), steps_on_waypoint=0):
    x = np.array(x, dtype=float)
    return State(
        x=x,
        v=np.zeros_like(x) if v is None else np.array(v, dtype=float),
        a=np.broadcast_to(np.array(a, dtype=float), len(x)).copy(),
        target=np.array(target, dtype=float),
        heading=np.array(heading, dtype=float),
        waypoint=np.array(waypoint, dtype=float),
        steps_on_waypoint=steps_on_waypoint,
    )


def advance(model, state, r=0.0, new_waypoint=(7.0, 7.0)):
    shape = (model.n, 2) if model.per_axis_r else (model.n,)
    return step(model, state, np.broadcast_to(r, shape), np.array(new_waypoint))


def spread(model, seed=0, steps=30):
    """A state in the middle of a run, where everything happens."""
    rng = np.random.default_rng(seed)
    return run(model, oracle.random_start(model, rng), steps, rng).state


def assert_same(one, other, atol=0.0):
    for field in dataclasses.fields(one):
        np.testing.assert_allclose(
            getattr(one, field.name),
            getattr(other, field.name),
            rtol=0,
            atol=atol,
            err_msg=field.name,
        )


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
