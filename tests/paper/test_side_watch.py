"""What is seen in frames: who is near whom, and which fields of the area hold a buoy."""

from types import SimpleNamespace

import numpy as np
import pytest

from shoal.paper.side_plan import CONSTANT
from shoal.paper.side_watch import FIELDS, filled_share, neighbor_turnover, watch_sides


def frames(x, y):
    return SimpleNamespace(x=np.array(x, float), y=np.array(y, float), step=np.arange(len(x)))


def line(order):
    """Buoys on a line, one meter apart, in this order."""
    places = np.empty(len(order))
    places[np.array(order)] = np.arange(len(order))
    return places


def test_who_stays_put_keeps_all_neighbors():
    still = frames([line(range(20))] * 6, np.zeros((6, 20)))
    assert neighbor_turnover(still, apart=2) == 0.0


def test_moving_together_changes_nothing():
    drifting = frames([line(range(20)) + 3.0 * step for step in range(6)], np.zeros((6, 20)))
    assert neighbor_turnover(drifting, apart=2) == 0.0


def test_two_groups_that_trade_all_their_members_change_most():
    """Seven here, seven there: the six nearest are the rest of the group."""
    here, there = np.arange(7.0), np.arange(7.0) + 100.0
    before = np.concatenate([here, there])
    mixed = np.empty(14)
    mixed[0::2], mixed[1::2] = here, there
    one = neighbor_turnover(frames([before, mixed], np.zeros((2, 14))), apart=1)
    stay = (
        np.mean([sum((i < 7) == (j < 7) and (i % 2) == (j % 2) and i != j for j in range(14)) for i in range(14)]) / 6
    )
    assert one == pytest.approx(1.0 - stay)


def test_a_buoy_in_every_field_fills_the_area_and_one_heap_a_field():
    middles = (np.arange(FIELDS) + 0.5) / FIELDS * 20.0 - 10.0
    x, y = (each.ravel() for each in np.meshgrid(middles, middles))
    assert filled_share(frames([x] * 2, [y] * 2), 10.0, 10.0) == 1.0
    assert filled_share(frames([0 * x] * 2, [0 * y] * 2), 10.0, 10.0) == 1 / 25


def test_those_at_the_wall_are_in_the_outer_fields():
    assert filled_share(frames([[-8.5, 8.5]] * 2, [[8.5, 8.5]] * 2), 8.5, 8.5) == 2 / 25


def test_later_frames_count():
    apart = frames([[0.0, 0.0], [-9.0, 9.0]], [[0.0, 0.0], [-9.0, 9.0]])
    assert filled_share(apart, 10.0, 10.0) == 2 / 25


def test_every_setting_is_watched_in_every_run():
    seen = watch_sides("oceans2020", 400, 2)
    assert {strength for strength, _ in seen.turnover} == {None, *CONSTANT}
    assert all(
        values.shape == (2,) and (values >= 0).all() and (values <= 1).all() for values in seen.turnover.values()
    )
    assert all(0 < values.min() <= values.max() <= 1 for values in seen.filled.values())
