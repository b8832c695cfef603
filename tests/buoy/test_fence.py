"""The geofence: whatever is wanted, a vehicle that obeys stays inside, and one outside comes back."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shoal.buoy.fence import Fence, fence_of, kept_inside
from shoal.scenario.load import load

BOX = Fence(200.0, 100.0, 2.0)
HORIZON = 3.0
ISLAND = 40.0  # [m] its radius
SEA = Fence(200.0, 100.0, 2.0, depth=lambda x, y: math.hypot(x - 50.0, y) - ISLAND, cell=1.0)

within_x, within_y = st.floats(-200.0, 200.0), st.floats(-100.0, 100.0)
any_speed = st.floats(allow_nan=True, allow_infinity=True)
speed = st.floats(-3.0, 3.0)


def after(x, y, velocity, time=HORIZON):
    return x + velocity[0] * time, y + velocity[1] * time


class TestRectangle:
    @given(within_x, within_y, any_speed, any_speed)
    def test_whatever_is_wanted_it_ends_inside_and_is_not_too_fast(self, x, y, vx, vy):
        told = kept_inside(BOX, x, y, vx, vy, HORIZON)
        assert BOX.outside(*after(x, y, told)) <= 1e-9
        assert math.hypot(*told) <= BOX.top_speed * (1 + 1e-12)

    @given(within_x, within_y, speed, speed, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.floats(0.0, 30.0))
    def test_wherever_it_is_within_the_slack_it_ends_inside(self, x, y, vx, vy, share_x, share_y, slack):
        seen = x + share_x * slack, y + share_y * slack
        if BOX.outside(*seen) == 0.0:
            told = kept_inside(BOX, *seen, vx, vy, HORIZON, slack)
            assert BOX.outside(*after(x, y, told)) <= 1e-9

    @given(st.floats(-190.0, 190.0), st.floats(-90.0, 90.0), speed, speed)
    def test_far_from_the_edges_it_is_what_was_wanted_or_as_fast_as_can_be(self, x, y, vx, vy):
        told = kept_inside(BOX, x, y, vx, vy, HORIZON)
        size = math.hypot(vx, vy)
        scale = min(1.0, BOX.top_speed / size) if size > 1e-300 else 0.0
        assert told == pytest.approx((scale * vx, scale * vy))

    def test_at_an_edge_it_goes_along(self):
        assert kept_inside(BOX, 200.0, 0.0, 1.0, 1.0, HORIZON) == (0.0, 1.0)
        assert kept_inside(BOX, 197.0, 0.0, 1.5, 1.0, HORIZON) == (1.0, 1.0)
        assert kept_inside(BOX, 200.0, 100.0, 1.0, 1.0, HORIZON) == (0.0, 0.0)

    @given(st.floats(-900.0, 900.0), st.floats(-900.0, 900.0), speed, speed)
    def test_from_outside_it_comes_straight_back_at_top_speed(self, x, y, vx, vy):
        before = BOX.outside(x, y)
        told = kept_inside(BOX, x, y, vx, vy, HORIZON)
        if before > 0.0:
            assert math.hypot(*told) == pytest.approx(BOX.top_speed)
            assert BOX.outside(*after(x, y, told, 0.01)) == pytest.approx(max(before - 0.02, 0.0), abs=1e-9)


class TestShore:
    """An island of a radius of 40 m at (50, 0)."""

    @given(within_x, within_y, speed, speed)
    def test_from_the_water_the_whole_way_stays_on_it(self, x, y, vx, vy):
        if SEA.depth(x, y) < 0.0:
            return
        told = kept_inside(SEA, x, y, vx, vy, HORIZON)
        on_the_way = [SEA.outside(*after(x, y, told, share * HORIZON)) for share in (0.25, 0.5, 0.75, 1.0)]
        assert max(on_the_way) <= 0.05  # between two strides of a quarter of a cell

    @given(st.floats(12.0, 38.0), st.floats(-3.1, 3.1), speed, speed)
    def test_aground_it_goes_to_the_water(self, far, bearing, vx, vy):
        x, y = 50.0 + far * math.cos(bearing), far * math.sin(bearing)
        told = kept_inside(SEA, x, y, vx, vy, HORIZON)
        assert math.hypot(*told) == pytest.approx(SEA.top_speed)
        assert SEA.outside(*after(x, y, told, 0.5)) == pytest.approx(ISLAND - far - 1.0, abs=0.05)

    @given(within_x, within_y, speed, speed, st.floats(0.0, 20.0))
    def test_with_slack_it_comes_no_closer_than_that_or_than_it_was(self, x, y, vx, vy, slack):
        depth = SEA.depth(x, y)
        if depth >= 0.0:
            told = kept_inside(SEA, x, y, vx, vy, HORIZON, slack)
            assert SEA.depth(*after(x, y, told)) >= min(slack, depth) - 1e-9

    def test_off_the_shore_it_may_go_whatever_the_slack(self):
        assert kept_inside(SEA, 9.0, 0.0, -1.5, 0.0, HORIZON, 5.0) == (-1.5, 0.0)

    def test_it_slides_along(self):
        vx, vy = kept_inside(SEA, 9.99, 0.0, 1.0, 1.0, HORIZON)
        assert vy == pytest.approx(1.0, abs=0.05)
        assert vx == pytest.approx(0.0, abs=0.05)

    def test_at_the_end_of_an_inlet_it_stops(self):
        inlet = Fence(200.0, 100.0, 2.0, depth=lambda x, y: (10.0 - x - 3.0 * abs(y)) / math.sqrt(10.0), cell=1.0)
        for y in (-1.0, 0.0, 0.5):
            x = 0.0
            for _ in range(300):  # 0.1 s each
                vx, vy = kept_inside(inlet, x, y, 2.0, 0.1, HORIZON)
                x, y = x + 0.1 * vx, y + 0.1 * vy
                assert inlet.depth(x, y) >= 0.0
            assert x > 5.0

    def test_head_on_it_stops(self):
        x = 0.0
        for _ in range(500):  # 0.1 s each
            vx, vy = kept_inside(SEA, x, 0.0, 2.0, 0.0, HORIZON)
            assert vy == pytest.approx(0.0, abs=1e-6)
            x += 0.1 * vx
        assert 9.0 < x <= 10.0


class TestOfAScenario:
    def test_is_the_arena_less_its_margin_and_the_top_speed_of_the_fleet(self):
        scenario = load("oceans2020", **{"area.agent_margin": 1.5})
        fence = fence_of(scenario, 0)
        assert fence == (8.5, 8.5, scenario.fleets[0].max_speed, None, 1.0)
        assert fence_of(scenario, 49).top_speed == scenario.fleets[1].max_speed

    def test_has_the_coast_of_the_sea(self):
        pytest.importorskip("scipy", reason="scipy is not installed: pip install '.[maritime]'")
        corners = [[[0.0, -20.0], [20.0, -20.0], [20.0, 20.0], [0.0, 20.0]]]
        scenario = load("oceans2020", area={"width": 100.0, "height": 100.0}, sea={"coast": corners, "cell": 0.5})
        fence = fence_of(scenario, 0)
        assert fence.outside(10.0, 0.0) == pytest.approx(10.0, abs=0.5)
        assert fence.outside(-10.0, 0.0) == 0.0
        assert kept_inside(fence, -1.0, 0.0, 1.0, 0.0, HORIZON)[0] == pytest.approx(1.0 / HORIZON, abs=0.2)
