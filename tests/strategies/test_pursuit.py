"""Runs after the known target."""

import numpy as np
import pytest

from staging import places, staged, wanted


def test_heads_straight_for_the_nearest_target_at_full_speed():
    simulation = staged("pursuit", [(0, 0), (-8, 0)], targets=[(3, 4), (-8, -5)], top=[1.0, 2.6])
    assert wanted(simulation).tolist() == [pytest.approx([0.6, 0.8]), pytest.approx([0.0, -2.6])]


def test_catches_a_target_that_waits_after_distance_over_speed():
    """And is there to the last bit."""
    simulation = staged("pursuit", [(-3, -4), (9, 9)], targets=[(0, 0)], top=1.0)
    simulation.advance(49)
    assert np.hypot(*places(simulation)[0]) == pytest.approx(0.1)
    simulation.advance(1)
    assert places(simulation)[0] == pytest.approx([0, 0], abs=1e-12)


def test_waits_while_no_target_is_there():
    simulation = staged("pursuit", [(0, 0), (5, 5)], targets=[(3, 4)], top=1.0)
    with simulation.edit() as now:
        now.targets["present"] = 0
    assert not wanted(simulation).any()
