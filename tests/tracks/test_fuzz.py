"""2,000 odd track files, by a seed: each is read, or refused with one clear error; none hangs."""

import json
import random
import warnings
from datetime import datetime, timedelta

import numpy as np
import pytest

from shoal.core.errors import ShoalError
from shoal.tracks.read import read_track

FILES, SHARDS, NETCDF_FILES = 2000, 20, 100
COUNT = 25
STAMPS = [f"{datetime(2024, 3, 10, 12) + timedelta(minutes=i):%Y-%m-%dT%H:%M:%SZ}" for i in range(COUNT)]
PLACES = [(54 + 0.0009 * i, 10 + 0.0012 * i) for i in range(COUNT)]
ODD = [
    "", " ", "nan", "NaN", "inf", "-inf", "1e308", "1e999", "-0", "1_0", "١٢", "91", "181", "-9999", "null", "\x00",
    "\x1b[31m", '"', "'", "=1+1", "<b>", "&amp;", "é", "海", "\ufeff", "9" * 400, "1.7e9", "1710072000000", "0x10",
    "2024-02-30T00:00:00Z", "10/03/2024 12:00", "31.12.9999 23:59", "0001-01-01", "24:00", "UTC", "true", "[]", "{}",
]  # fmt: skip
AIS = "!AIVDM,1,1,,A,13mb9U0P00PRk8fT5nw>4?wj2006,0*4E"


def csv_text(odd):
    separator = odd.choice([",", ",", ";", "\t", "|", " "])
    columns = ["time", "lat", "lon", odd.choice(["mmsi", "Device", "name", "status", "x7"])]
    rows = [(STAMPS[i], f"{lat:.4f}", f"{lon:.4f}", str(i % 2)) for i, (lat, lon) in enumerate(PLACES)]
    return "\n".join(separator.join(row) for row in [columns, *rows]) + "\n"


def gpx_text(odd):
    points = (f'<trkpt lat="{x}" lon="{y}"><time>{STAMPS[i]}</time></trkpt>' for i, (x, y) in enumerate(PLACES))
    return "<gpx>\n<trk><name>a</name><trkseg>\n" + "\n".join(points) + "\n</trkseg></trk>\n</gpx>"


def kml_text(odd):
    whens = "\n".join(f"<when>{stamp}</when>" for stamp in STAMPS)
    coords = "\n".join(f"<gx:coord>{lon} {lat} 0</gx:coord>" for lat, lon in PLACES)
    return f"<kml>\n<Placemark><gx:Track>\n{whens}\n{coords}\n</gx:Track></Placemark>\n</kml>"


def json_text(odd):
    coordinates = [[lon, lat] for lat, lon in PLACES]
    moving = {"type": "MovingPoint", "datetimes": STAMPS, "coordinates": coordinates}
    line = {"type": "LineString", "coordinates": coordinates}
    feature = {"type": "Feature", "properties": {"coordTimes": STAMPS}, "geometry": line}
    point = {"type": "Point", "coordinates": coordinates[0]}
    points = [{"type": "Feature", "properties": {"time": at, "id": 1}, "geometry": point} for at in STAMPS]
    forms = [
        {"type": "Feature", "temporalGeometry": moving},
        feature,
        {"type": "FeatureCollection", "features": points},
    ]
    return json.dumps(odd.choice(forms), indent=1)


def nmea_text(odd):
    sentences = (AIS, AIS.replace("w>4", "w>5"), "$GPRMC,120000.00,A,5400.0000,N,01000.0000,E,2.0,0.0,100324,,")
    return "\n".join(f"\\c:{1710072000 + 60 * i}*00\\{odd.choice(sentences).partition('*')[0]}" for i in range(COUNT))


TEXTS = {
    ".csv": csv_text, ".tsv": csv_text, ".txt": csv_text, ".gpx": gpx_text, ".kml": kml_text,
    ".json": json_text, ".nmea": nmea_text, ".log": nmea_text,
}  # fmt: skip


def cell(odd, text):
    """Another value somewhere."""
    words = text.split(",") if "," in text else text.split(" ")
    words[odd.randrange(len(words))] = odd.choice(ODD)
    return ("," if "," in text else " ").join(words)


def lines(odd, text):
    """Lines gone, doubled or in another order."""
    rows = text.split("\n")
    at = odd.randrange(len(rows))
    gone, doubled = rows[:at] + rows[at + 1 :], rows[:at] + [rows[at]] * 3 + rows[at:]
    return "\n".join(odd.choice([gone, doubled, odd.sample(rows, len(rows)), rows[::-1]]))


def swapped(odd, text):
    """One sign for another, everywhere."""
    return text.replace(odd.choice(',;.:-T\t <>{}[]"\n='), odd.choice(',;.:- \t|<>"\x00\n'))


def cut(odd, text):
    """The end is missing."""
    return text[: odd.randrange(len(text) + 1)]


def renamed(odd, text):
    """A column, a tag or a key under another name."""
    old = odd.choice(["time", "lat", "lon", "trk", "when", "coord", "datetimes", "AIVDM", "RMC", "type"])
    return text.replace(old, odd.choice(["", "x", "date", "latitude", "year", "LON", "GGA", *ODD]))


def odd_bytes(odd, text):
    """Another encoding, or noise in the middle."""
    data = text.encode(odd.choice(["utf-8", "utf-16", "utf-8-sig", "latin-1", "utf-32", "cp1252"]), errors="replace")
    at = odd.randrange(len(data) + 1)
    noise = odd.randbytes(odd.choice([0, 0, 1, 5, 300]))
    return data[:at] + noise + data[at + odd.choice([0, len(noise)]) :]


def netcdf(odd, path):
    """A file whose variables have odd names, sizes, types and attributes."""
    netcdf4 = pytest.importorskip("netCDF4")
    sizes = {"obs": odd.choice([COUNT, COUNT, COUNT, 1]), "trajectory": odd.choice([1, 2]), "text": 3}
    shape = odd.choice([["obs"], ["obs"], ["obs"], ["trajectory", "obs"], ["obs", "trajectory"], [], ["obs", "obs"]])
    since = [
        "seconds since 1970-01-01",
        "days since 1950-01-01",
        "s since 2024-03-10T12:00:00Z",
        "minutes since",
        "m",
        "",
    ]
    with netcdf4.Dataset(path, "w", format=odd.choice(["NETCDF4", "NETCDF3_CLASSIC"])) as dataset:
        for name, size in sizes.items():
            dataset.createDimension(name, size)

        def variable(name, over, values, kind="f8", **attributes):
            made = dataset.createVariable(name, kind, over)
            made.setncatts({key: value for key, value in attributes.items() if odd.random() < 0.9})
            wanted = np.broadcast_to(np.resize(values, made.shape or (1,)), made.shape or (1,))
            made[...] = wanted if made.shape else wanted[0]

        for name, values, units in (
            ("time", np.arange(COUNT) * 60.0, odd.choice(since)),
            ("lat", [lat for lat, _ in PLACES], "degrees_north"),
            ("lon", [lon for _, lon in PLACES], "degrees_east"),
        ):
            over = shape if odd.random() < 0.9 else odd.choice([["obs"], ["trajectory"], []])
            values = np.where(odd.random() < 0.1, odd.choice([np.nan, np.inf, -9999.0, 1e300, 181.0]), values)
            kind = odd.choice(["f8", "f8", "f8", "f4", "i4", "i2"])
            with np.errstate(all="ignore"):
                values = values if kind.startswith("f") else np.nan_to_num(values).clip(-30000, 30000)
                known = odd.choice([name, name, name, name.upper(), "x" + name])
                variable(known, over, values.astype(kind), kind, units=units, valid_min=odd.choice([0, "zero"]))
        if odd.random() < 0.5:
            role = {"cf_role": "trajectory_id", "sample_dimension": "obs", "instance_dimension": "trajectory"}
            for key in odd.sample(list(role), odd.randrange(1, 4)):
                over = odd.choice([["trajectory"], ["obs"], []])
                variable(
                    odd.choice(["id", "rowsize", "x"]) + key,
                    over,
                    np.array([odd.choice([0, 1, 7, COUNT, -3])]),
                    "i4",
                    **{key: role[key]},
                )


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("shard", range(4))
def test_an_odd_netcdf_file_is_read_or_refused_with_one_clear_error(tmp_path, shard):
    read = 0
    for n in range(shard, NETCDF_FILES, 4):
        odd = random.Random(n)
        path = tmp_path / f"{n}.nc"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of what is written
            netcdf(odd, path)
        if odd.random() < 0.3:
            data = bytearray(path.read_bytes())
            for _ in range(odd.choice([1, 8, 40])):
                data[odd.randrange(len(data))] = odd.randrange(256)
            path.write_bytes(data[: odd.choice([len(data), len(data), odd.randrange(400)])])
        outcome = outcome_of(path, odd.choice([None, None, None, "all", "trajectory=0"]))
        if isinstance(outcome, ShoalError):
            assert all(outcome.args), n
        else:
            read += 1
    assert read > 0


@pytest.mark.timeout(120)
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("shard", range(SHARDS))
def test_an_odd_file_is_read_or_refused_with_one_clear_error(tmp_path, shard):
    pytest.importorskip("pyais")
    read = 0
    for n in range(shard, FILES, SHARDS):
        odd = random.Random(n)
        suffix = odd.choice(list(TEXTS))
        text = TEXTS[suffix](odd)
        for mutation in odd.choices([cell, lines, swapped, cut, renamed], k=odd.randrange(4)):
            text = mutation(odd, text)
        path = tmp_path / f"{n}{suffix}"
        path.write_bytes(odd_bytes(odd, text))
        outcome = outcome_of(path, odd.choice([None, None, None, "all", "mmsi=1", "name=*"]))
        if isinstance(outcome, ShoalError):
            assert all(outcome.args), n
            assert len(str(outcome)) < 2000, n
        else:
            assert len(outcome.time) >= 2, n
            read += 1
    assert read > 0


def outcome_of(path, track_id):
    """The track, or the one clear error; anything else is raised."""
    try:
        return read_track(path, track_id=track_id)
    except ShoalError as error:
        return error
