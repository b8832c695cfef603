"""Fixes of an NMEA log: AIS position reports of other vessels (AIVDM), and the own ship's GPS (RMC)."""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from functools import reduce
from operator import xor
from pathlib import Path
from typing import Any, NamedTuple

from shoal.core.errors import MissingExtraError, TrackError
from shoal.tracks.points import Points
from shoal.tracks.table import Table
from shoal.tracks.wanted import Wanted, column_of, refuse_several

OWN = "own"  # the mmsi of the ship that keeps the log, which GPS sentences do not say
MMSI = "mmsi"
POSITION_REPORTS = "1239BCK"  # first character of the payload of types 1, 2, 3, 9, 18, 19 and 27
SENTENCE = re.compile(
    r"(?P<before>.*?)(?P<sentence>[!$][A-Z]{2}[A-Z]{3},[^*\\\s]*)(?:\*(?P<sum>[0-9A-Fa-f]{2}))?(?P<after>.*)"
)
TAGGED_TIME = re.compile(r"(?:\\|,)c:(\d{10,13})")
TIME = re.compile(
    r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(?:[.,]\d+)?\s?(?:Z|UTC|[+-]\d\d:?\d\d)?|\d{8}[T_]\d{6}Z?"
    r"|(?<![\d.])1\d{12}(?!\d)|(?<![\d.])\d{9,10}(?:\.\d+)?(?![\d.])"
)
UNTIMED = r"an AIS message says the second only: log with tag blocks (\c:1565218798*53\) or a time before each sentence"


class _Sentence(NamedTuple):
    line: int
    time: str  # "" where nothing on the line says when
    text: str  # without its checksum
    fields: list[str]


def nmea_table(path: Path, wanted: Wanted) -> Table:
    """Return the position reports of a log; `mmsi` tells vessels apart, the own ship's is "own".

    A report's time is that of its tag block, or stands before or behind it on its line, or else is that of the
    last RMC sentence.

    Raises
    ------
    TrackError : there is no position report, or none is of the vessel that is wanted
    MissingExtraError : pyais is not installed
    """
    if wanted.column:
        column_of(path, (MMSI,), wanted)
    log = _Log(path)
    points = Points((MMSI,))
    counts: Counter[str] = Counter()
    several = not (wanted.column or wanted.everything)
    clock = ""
    for sentence in log.sentences():
        kind = sentence.fields[0][3:]
        if kind == "RMC" and len(sentence.fields) > 9:
            clock, lat, lon = _own_fix(sentence.fields)
            found = (OWN, clock, lat, lon) if sentence.fields[2] == "A" else None
        elif kind in ("VDM", "VDO"):
            found = log.report(sentence, clock, wanted, counts, several)
        else:
            continue
        if found:
            mmsi, time, lat, lon = found
            counts[mmsi] += mmsi == OWN
            if wanted.everything or several or wanted.matches(mmsi):
                points.add(time, lat, lon, sentence.line, {MMSI: mmsi})
    if not counts:
        raise TrackError(str(path), "holds no AIS position report and no RMC sentence", "log AIVDM or GPRMC sentences")
    if several and len(counts) > 1:
        refuse_several(path, "the file", MMSI, counts)
    table = points.table(path, (MMSI,), untimed=UNTIMED, notes=log.notes())
    label = table.labels[MMSI]
    others = [mmsi for mmsi in counts if mmsi not in label.values]
    return replace(table, labels={MMSI: label._replace(values=[*label.values, *others])})


class _Log:
    """The sentences of a file, messages of several sentences put together."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.parts: dict[tuple[str, ...], list[_Sentence]] = {}
        self.wrong = 0

    def sentences(self) -> Iterator[_Sentence]:
        with self.path.open(encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                found = SENTENCE.match(line)
                if not found:
                    continue
                text = found["sentence"]
                if found["sum"] and int(found["sum"], 16) != reduce(xor, text[1:].encode(), 0):
                    self.wrong += 1
                    continue
                tagged = TAGGED_TIME.search(found["before"])
                time = tagged[1] if tagged else _time_in(found["before"]) or _time_in(found["after"])
                yield _Sentence(number, time, text, text.split(","))

    def report(
        self, last: _Sentence, clock: str, wanted: Wanted, counts: Counter[str], several: bool
    ) -> tuple[str, str, str, str] | None:
        """mmsi, time, lat and lon of a position report that is wanted, as soon as it is complete."""
        fields = last.fields
        if len(fields) < 7 or not (fields[1].isdigit() and fields[2].isdigit()):
            self.wrong += 1
            return None
        message = [last]
        if int(fields[1]) > 1:
            key = (fields[0], fields[1], fields[3], fields[4])
            message = [*self.parts.pop(key, []), last] if fields[2] != "1" else [last]
            if int(message[0].fields[2]) != 1 or len(message) != int(fields[2]):
                return None
            if len(message) < int(fields[1]):
                self.parts[key] = message
                return None
        payload = message[0].fields[5]
        if payload[:1] not in POSITION_REPORTS or len(payload) < 7:
            return None
        mmsi = str(_mmsi(payload))
        counts[mmsi] += 1
        if (wanted.column and not wanted.matches(mmsi)) or (several and len(counts) > 1):
            return None
        position = self._decoded(message)
        time = next((each.time for each in message if each.time), clock)
        return (mmsi, time, *position) if position else None

    def _decoded(self, message: list[_Sentence]) -> tuple[str, str] | None:
        decode = _pyais().decode
        try:
            report = decode(*(f"{each.text}*00" for each in message))
            return str(report.lat), str(report.lon)
        except Exception:  # damaged bits make it raise whatever they lead to
            self.wrong += 1
            return None

    def notes(self) -> list[str]:
        return [f"Sentences skipped because they are damaged: {self.wrong}."] if self.wrong else []


def _pyais() -> Any:
    try:
        import pyais
    except ImportError as error:
        raise MissingExtraError.of("pyais", "maritime", "reading raw AIS") from error
    return pyais


def _mmsi(payload: str) -> int:
    """Bits 8 to 37: enough to leave alone the messages of others, which are most of a log."""
    bits = 0
    for character in payload[:7]:
        value = ord(character) - 48
        bits = (bits << 6) | ((value - 8 if value > 40 else value) & 63)
    return (bits >> 4) & (2**30 - 1)


def _time_in(text: str) -> str:
    found = TIME.search(text)
    return found[0] if found else ""


def _own_fix(fields: list[str]) -> tuple[str, str, str]:
    """Time, lat and lon of $GPRMC,hhmmss,A,ddmm.mm,N,dddmm.mm,W,speed,course,ddmmyy."""
    clock, date = fields[1], fields[9]
    when = (
        f"20{date[4:6]}-{date[2:4]}-{date[:2]}T{clock[:2]}:{clock[2:4]}:{clock[4:]}Z"
        if len(date) == 6 and len(clock) > 5
        else ""
    )
    return when, _degrees(fields[3], fields[4]), _degrees(fields[5], fields[6])


def _degrees(text: str, side: str) -> str:
    before, _, _ = text.partition(".")
    if not 3 <= len(before) <= 5 or not text.replace(".", "", 1).isdecimal():
        return ""
    degrees = int(before[:-2]) + float(text[len(before) - 2 :]) / 60.0
    return f"{-degrees if side in ('S', 'W') else degrees:.9f}"
