"""How long currents around an arena take to read from a file of 2 GB, and how much memory: a week of an ocean model.

    python benchmarks/bench_sea_read.py

Each case runs in a process of its own; nothing here passes or fails. The memory is that of this process or of its
child that reads, in case the file is damaged, whichever is larger.
"""

import multiprocessing
import subprocess
import sys
import tempfile
from pathlib import Path

import netCDF4
import numpy as np

TIMES, DEPTHS, ROWS, COLUMNS = 168, 3, 1000, 1050  # of 16 bits: 2 x 1.06 GB
CHUNKS = {"a chunk for each time and depth": (1, 1, ROWS, COLUMNS), "chunks of a day": (24, 1, 100, 105)}
READ = """
import resource, sys, time
from datetime import UTC, datetime
from shoal.core.geodesy import Frame
from shoal.sea.gridded import read_gridded
start = time.perf_counter()
frame, day = Frame((5.0, 60.0)), datetime(2020, 1, 3, tzinfo=UTC)
field = read_gridded(sys.argv[1], "currents", frame, 50e3, 50e3, day, 48 * 3600.0)
wall = time.perf_counter() - start
peak = max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)) / 1024
print(f"{wall:6.2f} s  {peak:5.0f} MB   {field.u.shape} of {sys.argv[2]}")
"""


def main() -> None:
    """Write the file with each layout, read a window of it, print."""
    for name, chunks in CHUNKS.items():
        for packed in (False, True):
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "week.nc"
                writer = multiprocessing.get_context("spawn").Process(target=write, args=(path, chunks, packed))
                writer.start()  # elsewhere: the reader's peak would begin at ours
                writer.join()
                size = path.stat().st_size / 1e9
                print(f"{name}, {'compressed' if packed else 'plain'}, {size:.1f} GB", flush=True)
                shape = f"({TIMES}, {DEPTHS}, {ROWS}, {COLUMNS})"
                subprocess.run([sys.executable, "-c", READ, str(path), shape], check=True)


def write(path: Path, chunks: tuple[int, ...], packed: bool) -> None:
    """A swirl with noise that no compression removes, as 16-bit integers."""
    noise = np.random.default_rng(1).normal(0.0, 0.02, (ROWS, COLUMNS)).astype(np.float32)
    sizes = {"time": TIMES, "depth": DEPTHS, "lat": ROWS, "lon": COLUMNS}
    with netCDF4.Dataset(path, "w") as dataset:
        for name, size in sizes.items():
            dataset.createDimension(name, size)
        axes = (np.arange(TIMES), np.arange(DEPTHS), np.linspace(50, 70, ROWS), np.linspace(-10, 15, COLUMNS))
        units = ("hours since 2020-01-01", "m", "degrees_north", "degrees_east")
        for name, values, unit in zip(sizes, axes, units, strict=True):
            dataset.createVariable(name, "f8", (name,))[:] = values
            dataset[name].units = unit
        for name in ("uo", "vo"):
            options = {"zlib": packed, "complevel": 1, "chunksizes": chunks, "fill_value": np.int16(-32767)}
            variable = dataset.createVariable(name, "i2", tuple(sizes), **options)
            variable.setncatts({"units": "m s-1", "scale_factor": 1e-3})
            step = chunks[0]
            for time in range(0, TIMES, step):
                for depth in range(DEPTHS):
                    variable[time : time + step, depth] = np.stack([np.roll(noise, t, axis=0) for t in range(step)])


if __name__ == "__main__":
    main()
