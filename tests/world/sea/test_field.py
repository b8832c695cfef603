"""Fields of currents and wind: grids keep their axes, bilinear in space, linear in time; flows with formulas."""

import math

import numpy as np
import pytest

from shoal.compiler.kernel import plain
from shoal.world.sea import field as fields
from shoal.world.sea.field import GRID, flow_field, moment, still_field, velocity

SIZE = 1000.0


def grid(values, times, first, second):
    """A field on axes that are local x and y themselves; values (T, J, I, 2)."""
    coefficients = np.zeros((2, 15))
    coefficients[0, 5] = coefficients[1, 1] = SIZE
    even = [
        float(np.diff(axis)[0]) if len(axis) > 1 and np.ptp(np.diff(axis)) < 1e-9 else 0.0 for axis in (first, second)
    ]
    return still_field()._replace(
        kind=GRID,
        values=np.asarray(values, np.float32).ravel(),
        times=np.asarray(times, float),
        first=np.asarray(first, float),
        second=np.asarray(second, float),
        first_step=even[0],
        second_step=even[1],
        coefficients=coefficients,
        size=SIZE,
    )


def at(field, x, y, time):
    return velocity(field, x, y, moment(field, time))


class TestGrid:
    """A field that is linear in x, y and time is met exactly, up to single precision."""

    X, Y, T = np.array([-300.0, -100.0, 200.0, 500.0]), np.array([-50.0, 50.0, 150.0]), np.array([0.0, 600.0, 900.0])

    def linear(self, x, y, t):
        return 0.1 + 1e-3 * x - 2e-3 * y + 1e-4 * t, -0.2 + 5e-4 * x + 1e-3 * y - 2e-4 * t

    def made(self, x_axis):
        t, y, x = np.meshgrid(self.T, self.Y, x_axis, indexing="ij")
        return grid(np.stack(self.linear(x, y, t), axis=-1), self.T, x_axis, self.Y)

    @pytest.mark.parametrize("axis", [X, np.linspace(-300.0, 500.0, 5)], ids=["uneven", "even"])
    def test_linear_fields_are_exact(self, axis):
        field = self.made(axis)
        for x, y, time in [(-300.0, -50.0, 0.0), (17.0, 33.0, 250.0), (499.0, 149.0, 899.0), (500.0, 150.0, 900.0)]:
            assert at(field, x, y, time) == pytest.approx(self.linear(x, y, time), abs=2e-7)

    def test_holds_still_beyond_its_edges_and_times(self):
        field = self.made(self.X)
        assert at(field, 900.0, 400.0, 5000.0) == at(field, 500.0, 150.0, 900.0)
        assert at(field, -900.0, -400.0, -1.0) == at(field, -300.0, -50.0, 0.0)

    def test_one_time_is_always(self):
        field = grid(np.full((1, 2, 2, 2), 0.25), [0.0], [-1.0, 1.0], [-1.0, 1.0])
        assert at(field, 0.0, 0.0, 1e6) == (0.25, 0.25)

    def test_one_row_is_everywhere(self):
        values = np.array([[[[0.0, 1.0], [1.0, 1.0]]]])
        field = grid(values, [0.0], [0.0, 100.0], [0.0])
        assert at(field, 25.0, 7.0, 0.0) == pytest.approx((0.25, 1.0))

    def test_loops_give_the_bits_of_the_formula(self):
        field = self.made(self.X)
        rng = np.random.default_rng(1)
        x, y = rng.uniform(-400, 600, 40), rng.uniform(-100, 200, 40)
        u, v, first, second = (np.zeros(40) for _ in range(4))
        fields.velocities(field, x, y, moment(field, 321.0), first, second, u, v)
        alone = np.array([at(field, *place, 321.0) for place in zip(x, y, strict=True)])
        assert (np.stack((u, v), axis=-1) == alone).all()


class TestFlows:
    """Formulas, at places where their values are known."""

    def test_uniform(self):
        assert at(flow_field("uniform", [0.3, -0.4]), 5.0, 6.0, 7.0) == (0.3, -0.4)

    def test_tide_turns_along_its_ellipse(self):
        field = flow_field("tide", [0.1, 0.0, 0.5, 0.0, 0.0, 0.2, 2 * math.pi / 100.0, 0.0])
        assert at(field, 0.0, 0.0, 0.0) == pytest.approx((0.6, 0.0))
        assert at(field, 9.0, 9.0, 25.0) == pytest.approx((0.1, 0.2))
        assert at(field, 9.0, 9.0, 50.0) == pytest.approx((-0.4, 0.0))

    def test_gyre_flows_along_its_walls_and_is_still_in_the_middle(self):
        field = flow_field("gyre", [0.5, 1000.0, 0.0, 0.0])
        assert at(field, 0.0, 0.0, 0.0) == pytest.approx((0.0, 0.0), abs=1e-12)
        assert at(field, 0.0, -500.0, 0.0) == pytest.approx((0.5, 0.0), abs=1e-12)  # east along the south
        assert at(field, 500.0, 0.0, 0.0) == pytest.approx((0.0, 0.5), abs=1e-12)
        assert at(field, 501.0, 0.0, 0.0) == (0.0, 0.0)

    def test_gyre_has_no_divergence(self):
        field, h = flow_field("gyre", [0.5, 1000.0, 0.0, 0.0]), 1e-3
        for x, y in [(100.0, 200.0), (-333.0, 21.0)]:
            across = (at(field, x + h, y, 0.0)[0] - at(field, x - h, y, 0.0)[0]) / (2 * h)
            along = (at(field, x, y + h, 0.0)[1] - at(field, x, y - h, 0.0)[1]) / (2 * h)
            assert across + along == pytest.approx(0.0, abs=1e-9)

    def test_eddy_is_fastest_at_its_radius_and_moves(self):
        field = flow_field("eddy", [0.8, 200.0, 0.0, 0.0, 1.0, 0.0])
        assert at(field, 200.0, 0.0, 0.0) == pytest.approx((1.0, 0.8))
        assert at(field, 300.0, 0.0, 100.0) == pytest.approx((1.0, 0.8))
        assert at(field, 100.0, 0.0, 100.0) == pytest.approx((1.0, 0.0))
        speeds = [at(field, r, 0.0, 0.0)[1] for r in (150.0, 190.0, 200.0, 210.0, 260.0)]
        assert max(speeds) == speeds[2]

    def test_rotation(self):
        field = flow_field("rotation", [0.01, 10.0, 20.0])
        assert at(field, 10.0, 120.0, 0.0) == pytest.approx((-1.0, 0.0))

    def test_still(self):
        assert at(still_field(), 1.0, 2.0, 3.0) == (0.0, 0.0)


def test_polynomials_are_read_in_the_order_they_are_fitted_in():
    powers = [(i, j) for i in range(5) for j in range(5 - i)]
    for place, (i, j) in enumerate(powers):
        coefficients = np.zeros((2, 15))
        coefficients[1, place] = 1.0
        assert plain(fields.along_axis)(coefficients, 1, 0.3, -0.7) == pytest.approx(0.3**i * (-0.7) ** j)
