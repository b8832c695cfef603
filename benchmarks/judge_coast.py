"""Whether anybody gets onto land: ten million agent-steps at full speed along the coast of Norway.

    python benchmarks/judge_coast.py [--data ../shared/data]

The judge is the coast itself: the polygons of the file, in longitude and latitude, by shapely (its edges are straight
there, as GeoJSON says). Every so many steps all agents are looked up. The currents are those of NorKyst. Bars: nobody
is inside of a polygon by more than one cell of shoal's raster, and all numbers are finite. Wanderers meet the coast by
chance; `landward`, a strategy written for this, steers for it: more or less eastward. Exit code 1 if a bar is missed.

Here, of those looked up 26 to 97 % were at the shore; the deepest was 18 m inside a polygon, a cell is 30 m.
"""

import argparse
import json
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import pyproj
import shapely

import shoal

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
COAST = "norway_west/norway_west_coastline_osm.geojson"
CURRENTS = "norway_west/norway_west_currents_norkyst800_2015-11-16.nc"
ORIGIN, SIDE = (4.95, 60.6), 60e3  # [deg], [m]
START = "2015-11-16T02:00:00Z"
TIME_STEP, EVERY = 30.0, 20  # [s]; steps between two looks
HOURS = 60.0
AGENTS, SPEED = 400, 12.0  # [m/s]: seven cells a step
AGENT_STEPS = 10_000_000
LANDWARD = """
import math
from typing import NamedTuple

import shoal


class Landward(NamedTuple):
    turn_chance: float = 0.002


@shoal.strategy("landward", params=Landward, memory={"heading": "rad"})
def landward(me, heard, memory, params, draw):
    if shoal.uniform(draw, 0) < params.turn_chance:
        memory.heading = 4.0 * shoal.uniform(draw, 1) - 2.0
    return me.max_speed * math.cos(memory.heading), me.max_speed * math.sin(memory.heading)
"""


def main() -> int:
    """Run each strategy, look up its agents."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--data", type=Path, default=DATA)
    data = parser.parse_args().data
    good = True
    with tempfile.TemporaryDirectory() as folder:
        homing = Path(folder) / "landward.py"
        homing.write_text(LANDWARD)
        strategies: dict[str, Any] = {"random-walk": "random-walk", "levy-walk": "levy-walk"}
        strategies["landward"] = {"file": str(homing)}
        for name, strategy in strategies.items():
            good &= judged(name, strategy, data, AGENT_STEPS // len(strategies))
    return 0 if good else 1


def judged(name: str, strategy: Any, data: Path, agent_steps: int) -> bool:
    """Run a strategy, print the deepest that anybody was on land; whether the bars are kept."""
    sea = {"start": START, "coast": str(data / COAST), "currents": str(data / CURRENTS)}
    scenario = shoal.load(
        "oceans2020",
        steps=int(HOURS * 3600 / TIME_STEP),
        time_step=TIME_STEP,
        strategy=strategy,
        fleets=[{"name": "boats", "count": AGENTS, "max_speed": SPEED, "start": "arena"}],
        area={"width": SIDE, "height": SIDE, "origin": ORIGIN},
        network={"neighbors": 1, "range": 1.0},
        sea=sea,
    )
    coast = Coast(data / COAST)
    begun, done, looks, ashore, run, deepest, finite = time.perf_counter(), 0, 0, 0, 0, 0.0, True
    cell = 0.0
    while done < agent_steps:
        simulation = shoal.Simulation(scenario, run)
        cell = simulation._sea.shore.cell
        for _ in range(scenario.steps // EVERY):
            simulation.advance(EVERY)
            x, y = simulation.swarm.x[:AGENTS], simulation.swarm.y[:AGENTS]
            finite &= bool(np.isfinite((x, y, simulation.swarm.vx[:AGENTS], simulation.swarm.vy[:AGENTS])).all())
            deepest = max(deepest, coast.depth(x, y))
            ashore += int(simulation.swarm.aground[:AGENTS].sum())
            looks += AGENTS
            done += EVERY * AGENTS
            if done >= agent_steps:
                break
        run += 1
    good = finite and deepest <= cell
    print(
        f"{name}: {done:,} agent-steps, {looks:,} looked up, {ashore / looks:.0%} of them stopped by land; deepest on "
        f"land {deepest:.1f} m, a cell is {cell:g} m; {'all finite' if finite else 'NOT FINITE'}; "
        f"{time.perf_counter() - begun:.0f} s{'' if good else '   MISSED'}",
        flush=True,
    )
    return good


class Coast:
    """The polygons of a file around the arena."""

    def __init__(self, file: Path) -> None:
        shapes = [shapely.geometry.shape(each["geometry"]) for each in json.loads(file.read_text())["features"]]
        self.polygons = shapely.make_valid(np.array(shapes))
        self.tree = shapely.STRtree(self.polygons)
        self.frame = pyproj.Proj(proj="aeqd", ellps="WGS84", lon_0=ORIGIN[0], lat_0=ORIGIN[1])

    def depth(self, x: Any, y: Any) -> float:
        """How far the deepest of places [m] is inside of a polygon [m]; 0 if none is."""
        lon, lat = self.frame(x, y, inverse=True)
        points = shapely.points(lon, lat)
        where, inside = self.tree.query(points, predicate="within")
        deepest = 0.0
        for point, polygon in zip(where, inside, strict=True):
            shore = shapely.get_coordinates(self.polygons[polygon].boundary)
            ring = shapely.linestrings(np.stack(self.frame(*shore.T), axis=-1))
            deepest = max(deepest, float(shapely.distance(ring, shapely.points(x[point], y[point]))))
        return deepest


if __name__ == "__main__":
    sys.exit(main())
