"""Land stops what moves and hides what is behind it."""

import math

import numpy as np
import pytest

from shoal.core.draws import split
from shoal.world.sea.land import afloat, anywhere_afloat, clearance, land_of, no_land, room_at, sailed, seaward
from shoal.world.sea.sight import in_sight, look_along

CELL = 5.0
SIDE = 201
RADIUS = 100.0  # of an island around (0, 0)


def land(shape):
    """The raster of a shape, a function of x and y that is its signed distance [m]."""
    start = -CELL * (SIDE - 1) / 2
    axis = start + CELL * np.arange(SIDE)
    x, y = np.meshgrid(axis, axis)
    return land_of(shape(x, y), start, start, CELL)


ISLAND = land(lambda x, y: np.hypot(x, y) - RADIUS)
COAST = land(lambda x, y: 50.0 - y)  # land to the north of y = 50


def lowest_along(land, a, b):
    """The least distance to the shore along a line [m], bilinear, from 20,001 samples."""
    share = np.linspace(0.0, 1.0, 20001)
    x, y = ((a + share[:, None] * (b - a)).T - np.array([[land.x], [land.y]])) / land.cell
    i, j = x.astype(int), y.astype(int)
    right, up = x - i, y - j
    low = (1 - right) * land.distance[j, i] + right * land.distance[j, i + 1]
    high = (1 - right) * land.distance[j + 1, i] + right * land.distance[j + 1, i + 1]
    return ((1 - up) * low + up * high).min()


class TestClearance:
    def test_is_the_distance_to_the_shore(self):
        assert clearance(COAST, 12.3, -7.7) == pytest.approx(57.7, abs=1e-4)
        assert clearance(COAST, 12.3, 61.0) == pytest.approx(-11.0, abs=1e-4)
        assert clearance(ISLAND, 200.0, 0.0) == pytest.approx(100.0, abs=0.05)

    def test_holds_still_beyond_the_raster(self):
        assert clearance(COAST, 0.0, -9000.0) == clearance(COAST, 0.0, -500.0)

    def test_room_is_never_longer(self):
        """Not than the distance anywhere within half a block."""
        rng = np.random.default_rng(7)
        for shape in (COAST, ISLAND):
            for x, y in rng.uniform(-520.0, 520.0, (500, 2)):
                room = room_at(shape, (x - shape.x) * shape.per_meter, (y - shape.y) * shape.per_meter)
                right = clearance(shape, *(np.array([x, y]) + rng.uniform(-2.0, 2.0, 2) * CELL))
                assert room * right >= 0.0
                assert abs(room) <= abs(right)

    def test_room_is_of_use(self):
        a = -COAST.x / COAST.cell
        assert room_at(COAST, a, (-100.0 - COAST.y) / COAST.cell) >= 120.0
        assert room_at(COAST, a, (200.0 - COAST.y) / COAST.cell) <= -120.0
        assert room_at(COAST, a, (50.0 - COAST.y) / COAST.cell) == 0.0

    def test_open_water(self):
        assert clearance(no_land(), 1e5, -1e5) == 1e6

    def test_seaward(self):
        assert seaward(COAST, 0.0, 40.0) == pytest.approx((0.0, -1.0))
        assert seaward(ISLAND, 80.0, 80.0) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), abs=1e-2)


class TestSailed:
    def test_open_water_changes_no_bit(self):
        assert sailed(COAST, 0.1, -300.3, 7.7, -299.9) == (7.7, -299.9)
        assert sailed(no_land(), 0.1, 0.2, 1234.5, 6789.0) == (1234.5, 6789.0)

    def test_a_way_into_land_slides_along_it(self):
        x, y = sailed(COAST, 0.0, 45.0, 30.0, 75.0)
        assert 49.0 < y <= 50.0
        assert x == pytest.approx(30.0, abs=0.1)

    def test_straight_into_land_ends_at_the_shore(self):
        x, y = sailed(COAST, 3.0, 20.0, 3.0, 90.0)
        assert (x, y) == (pytest.approx(3.0, abs=0.1), pytest.approx(50.0, abs=0.1))

    def test_no_step_jumps_over_land(self):
        x, y = sailed(ISLAND, -150.0, 0.0, 150.0, 0.0)
        assert x < 0.0
        assert clearance(ISLAND, x, y) >= 0.0

    def test_never_ends_on_land(self):
        rng = np.random.default_rng(3)
        for _ in range(300):
            x, y, to_x, to_y = rng.uniform(-400.0, 400.0, 4)
            if clearance(ISLAND, x, y) >= 0.0:
                assert clearance(ISLAND, *sailed(ISLAND, x, y, to_x, to_y)) >= 0.0


class TestSight:
    def test_an_island_hides(self):
        assert not in_sight(ISLAND, -200.0, 0.0, 200.0, 0.0)
        assert in_sight(ISLAND, -200.0, 150.0, 200.0, 150.0)
        assert in_sight(ISLAND, -200.0, 0.0, -150.0, 0.0)

    def test_as_samples_along_the_line_say(self):
        rng = np.random.default_rng(4)
        share = np.linspace(0.0, 1.0, 2001)
        for _ in range(300):
            a, b = rng.uniform(-400.0, 400.0, (2, 2))
            if min(clearance(ISLAND, *a), clearance(ISLAND, *b)) < 0.0:
                continue
            lowest = np.hypot(*(a[:, None] + share * (b - a)[:, None])).min() - RADIUS
            if abs(lowest) > CELL:
                assert in_sight(ISLAND, *a, *b) == (lowest > 0.0)

    def test_what_was_seen_holds_as_long_as_it_is_said_to(self):
        """Both ends move so far, anywhere: the answer is the same. Sight keeps what it found by this rule."""
        rng = np.random.default_rng(5)
        hidden = 0
        for _ in range(300):
            ends = rng.uniform(-400.0, 400.0, (2, 2))
            seen, slack, _ = look_along(ISLAND, *ends.ravel())
            hidden += not seen
            for _ in range(4):
                angle = rng.uniform(0.0, 2 * math.pi, 2)
                moved = ends + 0.999 * slack * np.stack((np.cos(angle), np.sin(angle)), axis=-1)
                assert look_along(ISLAND, *moved.ravel())[0] == seen
        assert 30 < hidden < 270

    def test_among_islands_no_sample_is_missed(self):
        """Beyond what a line dips between two samples, an eighth of a cell apart: 0.09 cells."""
        rng = np.random.default_rng(8)
        middles = rng.uniform(-450.0, 450.0, (40, 2))
        sizes = rng.uniform(5.0, 60.0, 40)
        islands = land(
            lambda x, y: (np.hypot(x[..., None] - middles[:, 0], y[..., None] - middles[:, 1]) - sizes).min(-1)
        )
        answers = []
        for _ in range(400):
            a, b = rng.uniform(-480.0, 480.0, (2, 2))
            deepest = lowest_along(islands, a, b) / CELL + 0.5
            seen = in_sight(islands, *a, *b)
            assert deepest < 0.0 or seen
            assert deepest > -0.09 or not seen
            answers.append(seen)
        assert 50 < sum(answers) < 350

    def test_both_see_each_other_or_neither(self):
        rng = np.random.default_rng(6)
        for _ in range(300):
            a, b = rng.uniform(-400.0, 400.0, (2, 2))
            assert look_along(ISLAND, *a, *b) == look_along(ISLAND, *b, *a)

    def test_slack_is_of_use(self):
        assert look_along(ISLAND, -300.0, 300.0, 300.0, 300.0)[1] > 50.0
        assert look_along(ISLAND, -300.0, 0.0, 300.0, 0.0)[1] > 20.0


class TestPlaces:
    def test_anywhere_afloat_is_at_sea_and_all_over(self):
        keys = [np.uint64(split(np.uint64(1), number)) for number in range(400)]
        places = np.array([anywhere_afloat(ISLAND, 300.0, 200.0, key) for key in keys])
        assert (np.hypot(*places.T) > RADIUS - 0.1).all()
        assert (np.abs(places) <= (300.0, 200.0)).all()
        assert np.abs(places.mean(axis=0)).max() < 40.0

    def test_afloat_is_the_nearest_water(self):
        assert afloat(ISLAND, 250.0, 0.0) == (250.0, 0.0)
        x, y = afloat(ISLAND, 70.0, 0.0)
        assert RADIUS < math.hypot(x, y) < RADIUS + 3 * CELL
        assert x > 90.0
