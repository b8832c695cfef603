"""Specification of reading NMEA logs: AIS reports of others, the GPS of the own ship."""

import csv
import sys
from functools import reduce

import numpy as np
import pytest

from shoal.core.errors import MissingExtraError
from shoal.tracks.nmea import nmea_table
from shoal.tracks.read import read_track
from shoal.tracks.times import iso
from shoal.tracks.wanted import Wanted
from track_files import NORWAY_DECODED, NORWAY_NMEA, real, refusal, write

START = 1_577_836_800  # 2020-01-01T00:00:00Z


def summed(sentence):
    """With its checksum."""
    return f"{sentence}*{reduce(lambda a, b: a ^ b, sentence[1:].encode()):02X}"


def report(i, *, mmsi=219000001, lat=54.0, kind=1):
    """The AIVDM sentence of a position report, 0.0005 degrees further north each time."""
    encode = pytest.importorskip("pyais").encode_dict
    position = {"type": kind, "mmsi": mmsi, "lat": lat + 0.0005 * i, "lon": 10.0, "speed": 2.0, "course": 0.0}
    (sentence,) = encode(position, talker_id="AI", radio_channel="A")
    return summed(sentence.replace("VDO", "VDM").partition("*")[0])


def in_two(i):
    """A report of class B in two sentences."""
    *head, payload, fill = report(i, kind=19).partition("*")[0].split(",")
    assert head == ["!AIVDM", "1", "1", "", "A"]
    first, second = payload[:30], payload[30:]
    sentences = (f"!AIVDM,2,1,{i % 10},A,{first},0", f"!AIVDM,2,2,{i % 10},A,{second},{fill}")
    return "\n".join(f"{START + 60 * i} {summed(each)}" for each in sentences)


def own(i):
    """The GPRMC sentence of the same path, 54 degrees and so many minutes north."""
    return summed(f"$GPRMC,00{i:02}00.00,A,54{0.03 * i:07.4f},N,01000.0000,E,2.0,0.0,010120,,")


FORMS = {
    "tag block": lambda i: "\\" + summed(f"?c:{START + 60 * i}")[1:] + "\\" + report(i),
    "tag block in ms": lambda i: f"\\s:station,c:{START + 60 * i}000*00\\" + report(i),
    "ISO before": lambda i: f"2020-01-01T00:{i:02}:00Z {report(i)}",
    "ISO in brackets": lambda i: f"[2020-01-01 00:{i:02}:00.000] {report(i)}",
    "unix before": lambda i: f"{START + 60 * i},{report(i)}",
    "unix behind": lambda i: f"{report(i)},{START + 60 * i}",
    "signalk": lambda i: f"{START + 60 * i}000;N;{report(i)}",
    "own GPS before": lambda i: summed(f"$GPRMC,00{i:02}00,V,,,,,,,010120,,") + "\n" + report(i),
    "class B": lambda i: f"{START + 60 * i} " + report(i, kind=18),
    "class B in two": in_two,
}


class TestAis:
    """Position reports of one vessel, whichever way the log says when."""

    @pytest.mark.parametrize("form", FORMS)
    def test_it_is_read(self, tmp_path, form):
        track = read_track(write(tmp_path, "track.nmea", *map(FORMS[form], range(9))))
        assert track.start == "2020-01-01T00:00:00Z"
        assert track.time.tolist() == [60.0 * i for i in range(9)]
        assert np.diff(track.y) == pytest.approx(np.full(8, 55.66), abs=0.2)

    @pytest.mark.parametrize("name", ["track.nmea", "track.nm4", "track.log", "track.txt"])
    def test_the_suffix_may_be_any_of_four(self, tmp_path, name):
        assert len(read_track(write(tmp_path, name, *map(FORMS["tag block"], range(9)))).time) == 9

    def test_vessels_are_told_apart_by_mmsi(self, tmp_path):
        lines = [f"{START + 60 * i} {report(i, mmsi=219000001 + n, lat=54 + n)}" for i in range(9) for n in (0, 1)]
        path = write(tmp_path, "track.nmea", *lines)
        assert "holds 2 tracks, told apart by mmsi" in refusal(path)[1]
        assert read_track(path, track_id="mmsi=219000002").origin[1] == pytest.approx(55.002, abs=1e-6)
        assert "mmsi=219000002" in refusal(path, track_id="mmsi=219000003")[2]

    def test_a_position_that_is_not_available_is_dropped_and_counted(self, tmp_path):
        lines = [f"{START + 60 * i} {report(i, lat=91.0 - 0.0005 * i if i == 4 else 54.0)}" for i in range(9)]
        track = read_track(write(tmp_path, "track.nmea", *lines))
        assert len(track.time) == 8
        assert "Fixes dropped because the file marks them missing: 1." in track.notes

    def test_damaged_sentences_are_skipped_and_counted(self, tmp_path):
        lines = [FORMS["tag block"](i) for i in range(9)]
        lines[4] = lines[4].replace("AIVDM,1,1", "AIVDM,1,7")
        track = read_track(write(tmp_path, "track.nmea", *lines))
        assert len(track.time) == 8
        assert "Sentences skipped because they are damaged: 1." in track.notes

    def test_a_log_without_times_is_refused_with_what_to_do(self, tmp_path):
        _, problem, fix = refusal(write(tmp_path, "track.nmea", *(report(i) for i in range(9))))
        assert problem == "no fix has a time"
        assert "log with tag blocks" in fix

    def test_another_text_is_refused(self, tmp_path):
        assert "holds no AIS position report" in refusal(write(tmp_path, "track.nmea", "time,lat,lon", "0,0,0"))[1]

    def test_it_needs_pyais(self, tmp_path, monkeypatch):
        path = write(tmp_path, "track.nmea", *map(FORMS["tag block"], range(9)))
        monkeypatch.setitem(sys.modules, "pyais", None)
        with pytest.raises(MissingExtraError, match=r"shoal\[maritime\]"):
            read_track(path)


class TestOwnShip:
    """The GPS of the ship that keeps the log; needs no library."""

    def test_its_track_is_read(self, tmp_path, monkeypatch):
        monkeypatch.setitem(sys.modules, "pyais", None)
        track = read_track(write(tmp_path, "track.log", *map(own, range(9))))
        assert track.start == "2020-01-01T00:00:00Z"
        assert np.diff(track.y) == pytest.approx(np.full(8, 55.66), abs=0.2)

    def test_beside_others_it_is_called_own(self, tmp_path):
        lines = [line for i in range(9) for line in (own(i), report(i, lat=55))]
        path = write(tmp_path, "track.nmea", *lines)
        assert "told apart by mmsi" in refusal(path)[1]
        assert read_track(path, track_id="mmsi=own").origin[1] == pytest.approx(54.002, abs=1e-6)


class TestRealLog:
    """29 s of all Norway."""

    def test_no_vessel_has_two_fixes(self):
        assert "told apart by mmsi, and no track has two fixes" in refusal(real(NORWAY_NMEA))[1]

    def test_every_report_is_where_the_decoded_file_says(self):
        pytest.importorskip("pyais")
        log = nmea_table(real(NORWAY_NMEA), Wanted(everything=True))
        vessels = [log.labels["mmsi"].values[code] for code in log.labels["mmsi"].codes]
        found = {
            mmsi: (time, round(lat, 6), round(lon, 6))
            for mmsi, time, lat, lon in zip(vessels, log.time, log.lat, log.lon, strict=True)
            if lat != 91
        }
        with real(NORWAY_DECODED).open() as file:
            rows = list(csv.DictReader(file))
        assert len(found) == len(rows) == 743
        for row in rows:
            time, lat, lon = found[row["mmsi"]]
            assert iso(float(time)) == row["time"]
            assert (lat, lon) == (float(row["lat"]), float(row["lon"]))
