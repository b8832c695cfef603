"""Drift and coast, judged by methods that share nothing with the engine; benchmarks/judge_*.py are the long forms."""

import importlib

import numpy as np
import pytest
from drifters import bent, straight, write

from sea_files import axis
from shoal.run.simulation import Simulation
from shoal.scenario.load import load

shapely = pytest.importorskip("shapely")
pytest.importorskip("netCDF4")
pytest.importorskip("pyproj")
judge = importlib.import_module("judge_drift")  # which imports them


def grid(name):
    """An arena, and a grid around it."""
    if name == "curved, with an angle, staggered":
        return (-125.0, 44.0), bent((-125.0, 44.0), 60, 1000.0, 3)
    if name == "across the antimeridian":
        return (179.98, -17.0), straight(axis(180.0, 0.35, 84), axis(-17.0, 0.3, 72), 3, 8e3)
    uneven = np.linspace(-1.0, 1.0, 61)
    uneven = 0.5 * uneven + 0.5 * uneven**3
    return (0.1, 70.0), straight(360.0 + 0.9 * uneven, 70.0 + 0.3 * uneven, 3, 8e3)


@pytest.mark.parametrize("name", ["curved, with an angle, staggered", "across the antimeridian", "uneven, far north"])
def test_buoys_drift_as_runge_kutta_on_wgs84_says(tmp_path, name):
    origin, made = grid(name)
    case = judge.Case(name, made, write(tmp_path / "currents.nc", made), origin, 30e3, 30e3, judge.EPOCH)
    at, end = judge.drifters(case, 7200.0, count=20)
    assert len(at) == 20
    assert np.median(judge.apart(at, end)) > 1000.0
    off = judge.apart(judge.buoys(case, at, 60.0, 7200.0), end)
    assert np.median(off) <= 3.0
    assert off.max() <= 15.0


def star(chance, middle, radius, corners=90):
    """An island of spikes and bays, corners (P, 2) [m]."""
    angle = np.linspace(0.0, 2 * np.pi, corners, endpoint=False)
    reach = radius * (0.6 + 0.8 * chance.random(corners))
    return np.stack((middle[0] + reach * np.cos(angle), middle[1] + reach * np.sin(angle)), axis=-1)


def test_at_full_speed_nobody_gets_farther_into_a_jagged_coast_than_a_cell():
    chance = np.random.default_rng(3)
    islands = [star(chance, middle, 350.0) for middle in ((-900.0, 300.0), (0.0, -700.0), (600.0, 700.0), (800.0, 0.0))]
    boats = [{"name": "boats", "count": 50, "max_speed": 30.0}]
    run = Simulation(
        load(
            "oceans2020",
            time_step=5.0,
            steps=2000,
            strategy="random-walk",
            fleets=boats,
            area={"width": 3000.0, "height": 3000.0},
            sea={"coast": islands, "currents": {"kind": "uniform", "x": 0.8, "y": 0.5}},
        )
    )
    land = shapely.polygons(islands)
    aground, inside = 0, 0
    for _ in range(200):
        run.advance(10)
        places = shapely.points(run.swarm.x[:50], run.swarm.y[:50])
        assert np.isfinite(shapely.get_coordinates(places)).all()
        aground += int(run.swarm.aground[:50].sum())
        for island in land:
            there = places[shapely.contains(island, places)]
            inside += len(there)
            assert shapely.distance(island.boundary, there).max(initial=0.0) <= run._sea.shore.cell
    assert aground > 100
    assert inside > 0  # a raster is not the polygon: the judge sees the difference
