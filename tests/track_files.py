"""Files of recorded tracks, written for a test; where the real ones lie."""

from pathlib import Path

import pytest

from shoal.core.errors import TrackError
from shoal.tracks.read import read_track

DATA = Path(__file__).resolve().parents[2] / "shared" / "data"
SOLENT = DATA / "solent" / "solent_ais_2016-01-12.csv"
DRIFTERS = DATA / "mab" / "mab_drifters_uscg_sldmb.csv"
MAB_AIS = DATA / "mab" / "mab_ais_2022-01-03.csv"
CURRENTS = DATA / "mab" / "mab_currents_hfradar_2019-01-01.nc"
NORWAY_NMEA = DATA / "norway_west" / "norway_kystverket_2019-08-07.nmea"
NORWAY_DECODED = DATA / "norway_west" / "norway_kystverket_2019-08-07_decoded.csv"

DEGREE = 111_319.49  # [m] of longitude on the equator of WGS84


def real(path):
    if not path.is_file():
        pytest.skip(f"the real data file {path.name} is not beside this repository")
    return path


def write(folder, name, *lines):
    path = folder / name
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def csv_file(folder, *lines, header="time,lat,lon"):
    return write(folder, "track.csv", header, *lines)


def eastward(folder, lons, *, seconds_apart=60, lat=0.0):
    """A csv track along a parallel."""
    rows = (f"{1_600_000_000 + i * seconds_apart},{lat},{lon}" for i, lon in enumerate(lons))
    return csv_file(folder, *rows)


def refusal(path, **options):
    """(where, problem, fix) of the error that reading `path` raises."""
    with pytest.raises(TrackError) as caught:
        read_track(path, **options)
    return caught.value.args
