"""Whether buoys drift where they should: 100 without a will, against Runge-Kutta on WGS 84, and against Parcels.

    python benchmarks/judge_drift.py [--data ../shared/data] [--parcels PYTHON]

For every grid, drifters.py follows the same drifters over 2 h on the file's own grid: median <= 3 m, worst <= 15 m, at
time-steps of 1 to 300 s. Only drifters count that stay among nodes with values. Data that are absent are left out.

PYTHON is that of an environment with Parcels (`python -m venv E; E/bin/pip install parcels==4.0.2 netCDF4`): 6 h of
NorKyst, RK4, 300 s: median <= 2 m, worst <= 10 m. Parcels' Earth has 1852 x 60 m per degree everywhere, WGS 84 has
up to 0.6 % more or less. So it gets velocities multiplied by its meters per degree and divided by those of WGS 84:
degrees per second, which is what it integrates, are then right.

Here: against Runge-Kutta, medians of 0.01 to 1.9 m and at worst 7 m, on a grid that bends; against Parcels 0.8 and
3.2 m at 10 s and at 60 s, 1.0 and 3.7 m at 300 s. Exit code 1 if a bar is missed.
"""

import argparse
import subprocess
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, NamedTuple

import netCDF4
import numpy as np
import pyproj
from drifters import Grid, Numbers, bent, drifted, meters_per_degree, places, straight, write

import shoal

BUOYS = 100
STEPS = (1.0, 10.0, 60.0, 300.0)  # [s]
HOUR = 3600.0
NORKYST = "norway_west/norway_west_currents_norkyst800_2015-11-16.nc"
RADAR = "mab/mab_currents_hfradar_2019-01-01.nc"
EPOCH = datetime(2020, 1, 1, tzinfo=UTC)  # of drifters.HOURS
PARCELS = """
import sys
import numpy as np, xarray as xr
import parcels
given = np.load(sys.argv[1])
time = np.datetime64("2020-01-01T00:00:00", "ns") + (given["time"] * 1e9).astype("timedelta64[ns]")
over = ("time", "lat", "lon")
dataset = xr.Dataset(
    {"uo": (over, given["u"], {"units": "m s-1"}), "vo": (over, given["v"], {"units": "m s-1"})},
    {
        "time": ("time", time, {"axis": "T"}),
        "lat": ("lat", given["lat"], {"axis": "Y", "units": "degrees_north"}),
        "lon": ("lon", given["lon"], {"axis": "X", "units": "degrees_east"}),
    },
)
fields = parcels.convert.copernicusmarine_to_sgrid(fields={"U": dataset["uo"], "V": dataset["vo"]})
fieldset = parcels.FieldSet.from_sgrid_conventions(fields)
start = given["start"]
drifters = parcels.ParticleSet(fieldset, x=start[:, 0], y=start[:, 1], t=np.repeat(time[0], len(start)))
drifters.execute(
    parcels.kernels.AdvectionRK4,
    runtime=np.timedelta64(int(given["duration"]), "s"),
    dt=np.timedelta64(300, "s"),
    verbose_progress=False,
)
np.save(sys.argv[2], np.stack((drifters.x, drifters.y), axis=-1))
"""


class Case(NamedTuple):
    """A grid with its file, and an arena in it: origin (lon, lat) [deg], width and height [m], start."""

    name: str
    grid: Grid
    file: Path
    origin: tuple[float, float]
    width: float
    height: float
    start: datetime


def main() -> int:
    """Judge every grid; Parcels where it is."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--data", type=Path, default=Path(__file__).resolve().parents[2] / "shared" / "data")
    parser.add_argument("--parcels", metavar="PYTHON", help="of an environment that has Parcels")
    parser.add_argument("--only", metavar="WORD", default="", help="grids whose names have this word")
    chosen = parser.parse_args()
    good = True
    with tempfile.TemporaryDirectory() as folder:
        for case in (*real(chosen.data), *made_up(Path(folder))):
            if chosen.only in case.name:
                good &= judged(case)
        if chosen.parcels and (chosen.data / NORKYST).is_file():
            good &= judged_by_parcels(norkyst(chosen.data, 6.0), chosen.parcels, Path(folder))
    return 0 if good else 1


def real(data: Path) -> list[Case]:
    """The grids of data that are there."""
    found = []
    if (data / NORKYST).is_file():
        found.append(norkyst(data, 2.0))
    if (data / RADAR).is_file():
        start = datetime(2019, 1, 1, 6, tzinfo=UTC)
        found.append(cut("HF radar, Mid-Atlantic Bight", data / RADAR, (-73.2, 39.4), 150e3, 150e3, start, 2.0))
    return found


def norkyst(data: Path, hours: float) -> Case:
    """Open water west of Norway, in an autumn gale."""
    start = datetime(2015, 11, 16, 6, tzinfo=UTC)
    return cut("NorKyst, 0.016 x 0.008 deg", data / NORKYST, (4.5, 60.65), 50e3, 130e3, start, hours)


def cut(
    name: str, file: Path, origin: tuple[float, float], width: float, height: float, start: datetime, hours: float
) -> Case:
    """The times of a file that a run needs."""
    with netCDF4.Dataset(file) as dataset:
        time = dataset["time"]
        stamps = netCDF4.num2date(time[:], time.units, only_use_cftime_datetimes=False, only_use_python_datetimes=True)
        since = np.array([(each.replace(tzinfo=UTC) - start).total_seconds() for each in stamps])
        kept = (since >= 0.0) & (since <= hours * HOUR)
        u, v = (np.ma.filled(dataset[each][kept].astype(float), np.nan) for each in "uv")
        lon, lat = np.meshgrid(dataset["lon"][:].astype(float), dataset["lat"][:].astype(float))
        return Case(name, Grid(lon, lat, since[kept], u, v), file, origin, width, height, start)


def made_up(folder: Path) -> list[Case]:
    """Grids of other kinds, hourly, with swirls of some cells and more."""

    def axis(middle: float, step: float, count: int) -> Numbers:
        return middle + step * (np.arange(count) - count // 2)

    def uneven(middle: float, reach: float, count: int) -> Numbers:
        side = np.linspace(-1.0, 1.0, count)
        return middle + reach * (0.5 * side + 0.5 * side**3)

    degree, twelfth = 1.0 / 120.0, 1.0 / 12.0
    grids = {
        "1/12 deg (Copernicus)": ((-30.0, 45.0), straight(axis(-30.0, twelfth, 41), axis(45.0, twelfth, 41), 4, 50e3)),
        "curved 1 km, angle, staggered (ROMS)": ((-125.0, 44.0), bent((-125.0, 44.0), 160, 1000.0, 4)),
        "uneven axes": ((15.0, 57.0), straight(uneven(15.0, 1.2, 81), uneven(57.0, 0.7, 81), 4, 10e3)),
        "longitudes of 0 to 360": ((-5.0, 48.0), straight(axis(355.0, degree, 161), axis(48.0, degree, 161), 4, 8e3)),
        "antimeridian": ((179.95, -17.0), straight(axis(180.0, degree, 161), axis(-17.0, degree, 161), 4, 8e3)),
        "latitude -40": ((150.0, -40.0), straight(axis(150.0, degree, 161), axis(-40.0, degree, 161), 4, 8e3)),
        "latitude 75": ((20.0, 75.0), straight(axis(20.0, 4 * degree, 161), axis(75.0, degree, 161), 4, 8e3)),
    }
    found = []
    for name, (origin, grid) in grids.items():
        side = 150e3 if "1/12" in name else 75e3
        found.append(
            Case(name, grid, write(folder / f"{len(found)}.nc", grid), origin, side, side, EPOCH),
        )
    return found


def judged(case: Case) -> bool:
    """Print how far the buoys are, after 2 h, from where Runge-Kutta has them; whether that is near enough."""
    at, end = drifters(case, 2 * HOUR)
    good = True
    print(f"{case.name}: {len(at)} drifters went {np.median(apart(at, end)):.0f} m", flush=True)
    for step in STEPS:
        off = apart(buoys(case, at, step, 2 * HOUR), end)
        good &= verdict(f"  {step:5.0f} s", off, 3.0, 15.0)
    return good


def judged_by_parcels(case: Case, python: str, folder: Path) -> bool:
    """The same for Parcels, after 6 h."""
    at, end = drifters(case, 6 * HOUR)
    print(f"{case.name}: {len(at)} drifters went {np.median(apart(at, end)):.0f} m in 6 h; against Parcels", flush=True)
    grid = case.grid
    to_east, to_north = meters_per_degree(grid.lat)
    of_parcels = 1852.0 * 60.0
    given = {
        "u": np.nan_to_num(grid.u * (of_parcels * np.cos(np.radians(grid.lat)) / to_east)),
        "v": np.nan_to_num(grid.v * (of_parcels / to_north)),
    }
    np.savez(
        folder / "given.npz", start=at, lon=grid.lon[0], lat=grid.lat[:, 0], time=grid.time, duration=6 * HOUR, **given
    )
    there = folder / "there.npy"
    subprocess.run([python, "-c", PARCELS, str(folder / "given.npz"), str(there)], check=True)
    parcels = np.load(there)
    good = True
    for step in STEPS[1:]:
        good &= verdict(f"  {step:5.0f} s", apart(buoys(case, at, step, 6 * HOUR), parcels), 2.0, 10.0)
    verdict("  Runge-Kutta, 60 s", apart(end, parcels), 2.0, 10.0)
    return good


def verdict(name: str, off: Numbers, median: float, worst: float) -> bool:
    """Print distances [m] beside their bars."""
    good = bool(np.median(off) <= median and off.max() <= worst)
    print(
        f"{name}: median {np.median(off):6.2f} m, worst {off.max():6.2f} m{'' if good else '   MISSED'}",
        flush=True,
    )
    return good


def drifters(case: Case, duration: float, count: int = BUOYS) -> tuple[Numbers, Numbers]:
    """Drifters that stay in the arena, among nodes with values: where they start and end, (P, 2) [deg]."""
    grid = case.grid
    local = pyproj.Proj(proj="aeqd", ellps="WGS84", lon_0=case.origin[0], lat_0=case.origin[1])
    chance = np.random.default_rng(1)
    at = chance.random((400 * count, 2)) * (np.array(grid.lon.shape[::-1]) - 1.0)

    def inside(at: Numbers) -> Any:
        x, y = local(*places(grid, at).T)
        return (np.abs(x) < 0.48 * case.width) & (np.abs(y) < 0.48 * case.height)

    way, fine = drifted(grid, at[inside(at)][: 8 * count], duration)
    fine &= np.all([inside(each) for each in way[::5]], axis=0)
    kept = way[:, fine][:, :count]
    return places(grid, kept[0]), places(grid, kept[-1])


def buoys(case: Case, at: Numbers, time_step: float, duration: float) -> Numbers:
    """Where shoal has buoys (P, 2) [deg] that set out at the same places."""
    scenario = shoal.load(
        "oceans2020",
        time_step=time_step,
        steps=round(duration / time_step),
        strategy="adrift",
        fleets=[{"name": "drifters", "count": len(at), "max_speed": 1.0}],
        area={"width": case.width, "height": case.height, "origin": case.origin},
        network={"neighbors": 1},
        sea={"start": case.start, "currents": str(case.file)},
    )
    run = shoal.Simulation(scenario)
    frame = pyproj.Proj(proj="aeqd", ellps="WGS84", lon_0=case.origin[0], lat_0=case.origin[1])
    with run.edit() as now:
        now.swarm.x[: len(at)], now.swarm.y[: len(at)] = frame(*at.T)
    run.advance(scenario.steps)
    return np.stack(frame(run.swarm.x[: len(at)], run.swarm.y[: len(at)], inverse=True), axis=-1)


def apart(a: Numbers, b: Numbers) -> Numbers:
    """Distances (P,) [m] on the Earth."""
    return np.asarray(pyproj.Geod(ellps="WGS84").inv(*a.T, *b.T)[2])


if __name__ == "__main__":
    sys.exit(main())
