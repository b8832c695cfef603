"""Specification of finding places in a grid that bends."""

import numpy as np
import pytest

from shoal.sea.resample import locate, metric_axis, weights_of

ANGLES, RADII = np.linspace(0.2, 1.8, 41), np.linspace(1000.0, 3000.0, 31)


def fan():
    """Nodes (J, I) on arcs around a center: columns by angle, rows by radius."""
    radius, angle = np.meshgrid(RADII, ANGLES, indexing="ij")
    return radius * np.cos(angle), radius * np.sin(angle)


def test_places_in_a_fan():
    chance = np.random.default_rng(1)
    angle, radius = chance.uniform(0.25, 1.75, 200), chance.uniform(1050.0, 2950.0, 200)
    column, row, inside = locate(*fan(), radius * np.cos(angle), radius * np.sin(angle))
    assert inside.all()
    np.testing.assert_allclose(column, (angle - 0.2) / 0.04, atol=0.01)
    np.testing.assert_allclose(row, (radius - 1000.0) / (2000.0 / 30.0), atol=0.02)


def test_places_outside_are_outside():
    _, _, inside = locate(*fan(), np.array([0.0, 5000.0, -2000.0, 2000.0]), np.array([0.0, 0.0, 0.0, -500.0]))
    assert not inside.any()


def test_nodes_without_a_place_cover_nothing():
    x, y = fan()
    x[10:12, 10:12] = np.nan
    angle, radius = ANGLES[[10, 30]], RADII[[10, 20]]
    _, _, inside = locate(x, y, radius * np.cos(angle), radius * np.sin(angle))
    assert inside.tolist() == [False, True]


def test_a_place_is_sea_by_its_nearest_nodes():
    x, y = np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0])
    unknown = np.zeros((2, 3), dtype=bool)
    unknown[:, 2] = True
    found = weights_of(x, y, np.array([0.5, 1.25, 1.75]), np.full(3, 0.5), unknown)
    assert found.sea.tolist() == [True, True, False]
    np.testing.assert_allclose(found.weights.sum(axis=0), 1.0)


@pytest.mark.parametrize(("half", "cell"), [(5000.0, 800.0), (100.0, 800.0), (400.0, 800.0)])
def test_an_axis_meets_both_sides(half, cell):
    axis = metric_axis(half, cell)
    assert (axis[2], axis[-3]) == pytest.approx((-half, half))
    assert np.diff(axis) == pytest.approx(np.diff(axis)[0])
    assert np.diff(axis)[0] <= cell
