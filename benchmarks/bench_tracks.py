"""How long a day of a national AIS feed takes to read, and how much memory: 1,000,000 rows, 5,000 ships.

    python benchmarks/bench_tracks.py

Each case runs in a process of its own; nothing here passes or fails.
"""

import random
import subprocess
import sys
import tempfile
from datetime import datetime, timedelta
from pathlib import Path

SHIPS, FIXES = 5000, 200
HEADER = (
    "MMSI,BaseDateTime,LAT,LON,SOG,COG,Heading,VesselName,IMO,CallSign,VesselType,Status,Length,Width,Draft,Cargo,"
    "TransceiverClass"
)
CASES = {"the mmsi is named": "MMSI=367002500", "another column is named": "VesselName=SHIP 7", "none is named": ""}
UNKNOWN = {"MMSI": "Unit", "VesselName": "Word", "IMO": "N1", "CallSign": "N2"}  # no column's name tells ships apart
READ = """
import resource, sys, time
from shoal.core.errors import TrackError
from shoal.tracks.read import read_track
start = time.perf_counter(), time.process_time()
try:
    said = f"{len(read_track(sys.argv[1], track_id=sys.argv[2] or None).time)} fixes"
except TrackError as error:
    said = error.args[1]
wall, cpu = time.perf_counter() - start[0], time.process_time() - start[1]
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
print(f"{wall:6.2f} s  {cpu:6.2f} s of CPU  {peak:5.0f} MB   {said}")
"""


def main() -> None:
    """Write the day, read it in each case, print."""
    with tempfile.TemporaryDirectory() as folder:
        day = Path(folder) / "day.csv"
        write_day(day)
        print(f"{SHIPS * FIXES:,} rows, {day.stat().st_size / 1e6:.0f} MB, columns of MarineCadastre\n")
        for name, track_id in CASES.items():
            print(f"{name:26}", end="", flush=True)
            subprocess.run([sys.executable, "-c", READ, str(day), track_id], check=True)
        with day.open("r+") as file:  # the same length: nothing moves
            file.write(",".join(UNKNOWN.get(name, name).ljust(len(name)) for name in HEADER.split(",")))
        print(f"{'no name says what is what':26}", end="", flush=True)
        subprocess.run([sys.executable, "-c", READ, str(day), ""], check=True)


def write_day(path: Path) -> None:
    """Every ship reports in turn, all day."""
    chance = random.Random(1)
    places = [(30 + 10 * chance.random(), -75 + 10 * chance.random()) for _ in range(SHIPS)]
    start = datetime(2024, 3, 10)
    with path.open("w") as file:
        file.write(HEADER + "\n")
        for fix in range(FIXES):
            for ship, (lat, lon) in enumerate(places):
                at = start + timedelta(seconds=432 * fix + 0.08 * ship)
                file.write(
                    f"{367000000 + ship},{at:%Y-%m-%dT%H:%M:%S},{lat + 0.0009 * fix:.5f},{lon + 0.0007 * fix:.5f},"
                    f"{15 * chance.random():.1f},{360 * chance.random():.1f},{chance.randrange(360)},SHIP {ship},"
                    f"IMO{9000000 + ship},C{ship},70,0,{100 + ship % 90},20,5.{ship % 10},70,A\n"
                )


if __name__ == "__main__":
    main()
