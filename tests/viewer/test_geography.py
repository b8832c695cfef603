"""What the page is told of the place: against the frame, the shore and the flow themselves."""

import json

import numpy as np
import pytest

pytest.importorskip("pyproj", reason="pyproj is not installed")
pytest.importorskip("scipy", reason="scipy is not installed")

from shoal.core.geodesy import Frame
from shoal.run.sea import EXACT, build_sea, flow_at
from shoal.scenario.at_sea import open_sea
from shoal.scenario.load import load
from shoal.viewer.geography import CELLS, NUMBERS, geography_of


@pytest.fixture(scope="module")
def bay():
    return load("bay")


@pytest.fixture(scope="module")
def told(bay):
    return geography_of(bay)


def on_earth(earth, x, y):
    """As the page works it out."""
    u, v = x / earth["size"], y / earth["size"]
    powers = [u**i * v**j for i in range(5) for j in range(5 - i)]
    return np.dot(earth["lon"], powers), np.dot(earth["lat"], powers)


def test_a_pool_is_nowhere_on_earth():
    assert geography_of(load("oceans2020")) is None


def test_places_on_earth_are_those_of_the_frame_to_a_millimeter(bay, told):
    frame = Frame(bay.area.origin)
    for x, y in [(0.0, 0.0), (1500.0, 1000.0), (-1500.0, 1000.0), (700.0, -400.0)]:
        back = frame.local(*on_earth(told["earth"], x, y))
        assert np.hypot(back[0] - x, back[1] - y) < 1e-3
    assert told["earth"]["error"] < 1e-3


def test_of_an_arena_that_is_too_large_for_them_they_are_not_told(bay):
    huge = bay.model_copy(update={"sea": None, "area": bay.area.model_copy(update={"width": 9e6, "height": 9e6})})
    assert geography_of(huge)["earth"] is None
    assert EXACT == 5.0


def test_land_is_that_of_the_scenario(bay, told):
    island = bay.sea.coast[1]
    assert told["land"][1] == [value for corner in (*island, island[0]) for value in corner]


def test_points_of_a_shore_that_are_too_close_to_tell_apart_are_one():
    from shoal.viewer.geography import _thinned

    ring = np.array([[0.0, 0.0], [10.0, 0.0], [10.5, 0.2], [11.2, 0.0], [0.0, 10.0]])
    assert _thinned(ring, 1.0) == [0.0, 0.0, 10.0, 0.0, 11.2, 0.0, 0.0, 10.0]


def test_arrows_are_the_flow_of_the_run_at_any_time_of_a_tide(bay, told):
    currents = told["currents"]
    field = build_sea(bay, open_sea(bay)).currents
    places = np.reshape(currents["places"], (-1, 2))
    values = np.reshape(currents["values"], (len(currents["times"]), -1, 2)) * currents["fastest"] / 100.0
    for time in (0.0, 5000.0, 0.7 * currents["period"] + 3.0 * currents["period"]):
        now = np.array([[np.interp(time % currents["period"], currents["times"], values[:, p, axis]) for axis in (0, 1)]
                        for p in range(len(places))])  # fmt: skip
        assert np.abs(now - flow_at(field, places, time)).max() < 0.02 * currents["fastest"]
    assert len(currents["values"]) <= NUMBERS


def test_land_that_only_a_grid_knows_is_told_in_rows_of_cells(bay):
    opened = open_sea(bay)
    from shoal.viewer.geography import _cells

    nameless = type(opened)(**{**vars(opened), "coast": ()})
    cells = np.array(_cells(nameless, bay.area))
    share = (opened.land.distance < 0).mean() * np.prod(opened.land.distance.shape) * opened.land.cell**2
    assert (cells[:, 2] * cells[:, 3]).sum() == pytest.approx(share, rel=0.05)
    assert len(set(cells[:, 1])) <= CELLS


def test_what_was_said_once_is_not_worked_out_again(bay, told):
    assert geography_of(bay.model_copy(update={"seed": 7})) is told


def test_it_is_json(told):
    assert len(json.dumps(told)) < 40_000
