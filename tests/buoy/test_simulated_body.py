"""A point that stands for a vehicle."""

import math

import pytest

from scenarios import scenario
from shoal.buoy.body import open_body
from shoal.buoy.errors import BodyError
from shoal.buoy.fence import Fence, fence_of
from shoal.buoy.simulated_body import SimulatedBody


class Hand:
    """A clock that is moved by hand."""

    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def hand():
    return Hand()


def test_it_goes_as_told_and_says_so(hand):
    body = SimulatedBody(1.0, 2.0, Fence(100.0, 100.0, 2.0), clock=hand)
    assert body.read() == (1.0, 2.0, 0.0, 0.0, False, 0.0, 0.0, False)
    body.go(0.6, -0.8)
    hand.now = 1.5
    assert body.read()[:4] == pytest.approx((1.9, 0.8, 0.6, -0.8))
    body.stop()
    hand.now = 2.0
    assert body.read()[:4] == pytest.approx((1.9, 0.8, 0.0, 0.0))


def test_no_faster_than_its_make_nor_out_of_the_fence(hand):
    body = SimulatedBody(0.0, 0.0, Fence(10.0, 10.0, 2.0), clock=hand)
    for second in range(60):
        body.go(30.0, 0.5)
        reading = body.read()
        assert math.hypot(reading.vx, reading.vy) <= 2.0 + 1e-12
        assert max(reading.x, reading.y) < 10.0
        hand.now = second + 1.0
    assert reading.x > 9.9


def test_it_stops_when_it_is_told_nothing_more(hand):
    body = SimulatedBody(0.0, 0.0, Fence(100.0, 100.0, 2.0), silence=3.0, clock=hand)
    body.go(1.0, 0.0)
    hand.now = 50.0
    assert body.read()[:4] == pytest.approx((3.0, 0.0, 0.0, 0.0))
    with pytest.raises(BodyError, match="is not finite"):
        body.go(math.nan, 0.0)


def test_its_detector_sees_from_where_it_is(hand):
    body = SimulatedBody(0.0, 0.0, Fence(100.0, 100.0, 2.0), detector=lambda x, y: x > 1.0, clock=hand)
    body.go(1.0, 0.0)
    seen = body.read().on_target
    hand.now = 2.0
    assert (seen, body.read().on_target) == (False, True)


def test_it_begins_where_the_text_says_or_all_apart():
    assert open_body("simulated:3,-4.5", "oceans2020", 7).read()[:2] == (3.0, -4.5)
    starts = [open_body("simulated", "oceans2020", id).read()[:2] for id in range(50)]
    assert min(math.dist(one, other) for n, one in enumerate(starts) for other in starts[:n]) > 0.3
    assert not any(fence_of("oceans2020", 0).outside(*start) for start in starts)


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("simulated:3", {}, "'3' is no place"),
        ("simulated:a,b", {}, "is no place"),
        ("simulated:nan,0", {}, "outside the fence"),
        ("simulated:9,0", {}, "9, 0 m is outside the fence"),
        ("simulated", {"arm": True}, "--arm: is for a vehicle"),
        ("simulated", {"key": b"k" * 32}, "--body-key: is for a vehicle"),
    ],
)
def test_what_cannot_be_is_one_error(text, options, said):
    with pytest.raises(BodyError, match=r"\n  fix: ") as error:
        open_body(text, scenario(), 0, **options)
    assert said in str(error.value)
