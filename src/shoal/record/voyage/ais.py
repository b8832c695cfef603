"""Positions and names as the AIS messages that chart plotters show (ITU-R M.1371-5, in NMEA 0183 sentences).

A buoy sends position reports of class B (type 18) and its name (type 24 A), a target those of class A (types 1 and
5). Their numbers are such as no ship has: buoy i is 979000000 + i, of the block of autonomous maritime radio devices
(ITU-R M.585), target j is 799000000 + j, of a country that does not exist.
"""

import math
import unicodedata
from collections.abc import Iterator
from functools import reduce
from operator import xor
from typing import Any

from shoal.core.errors import MissingExtraError
from shoal.record.voyage.voyages import KNOT, Craft, Voyages

BUOYS, TARGETS = 979_000_000, 799_000_000
LONGEST_NAME = 20
FASTEST = 102.2  # [kn] and faster
NO_SPEED, NO_COURSE, NO_HEADING = 102.3, 360.0, 511
UNTOLD = {"status": 15, "turn": -128}  # of class A: how it is under way, and how it turns
ALPHABET = "ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^- !\"#$%&'()*+,-./0123456789:;<=>?"


def mmsi_of(craft: Craft) -> int:
    """Return the number of a craft."""
    return (BUOYS if craft.kind == "buoy" else TARGETS) + craft.number


def names(crafts: list[Craft]) -> Iterator[str]:
    """Yield the sentences that say who is who.

    Raises
    ------
    MissingExtraError : pyais is not installed
    """
    for craft in crafts:
        about = {"type": 24, "partno": 0} if craft.kind == "buoy" else {"type": 5}
        yield from _sentences({**about, "mmsi": mmsi_of(craft), "shipname": ship_name(craft)})


def positions(voyages: Voyages, at: int) -> Iterator[str]:
    """Yield a sentence per craft that is there at one of the times.

    Raises
    ------
    MissingExtraError : pyais is not installed
    """
    second = int(voyages.times[at] // 1_000_000 % 60)
    columns = (voyages.lon, voyages.lat, voyages.speed, voyages.course, voyages.heading)
    rows = zip(voyages.crafts, voyages.there[at].tolist(), *(each[at].tolist() for each in columns), strict=True)
    for craft, there, lon, lat, speed, course, heading in rows:
        if not there:
            continue
        report = {"type": 18 if craft.kind == "buoy" else 1, "mmsi": mmsi_of(craft), "lon": lon, "lat": lat}
        if craft.kind == "target":
            report |= UNTOLD
        report |= {"speed": _knots(speed), "course": _course(course), "heading": _heading(heading), "second": second}
        yield from _sentences(report)


def tagged(sentence: str, microseconds: int, *, fine: bool) -> str:
    r"""Return a sentence behind a tag block with its Unix time, \c:1447653600*5A\!AIVDM..., in ms if `fine`."""
    tag = f"c:{microseconds // (1_000 if fine else 1_000_000)}"
    return f"\\{tag}*{reduce(xor, tag.encode()):02X}\\{sentence}"


def ship_name(craft: Craft) -> str:
    """Return its name in the 64 letters and 20 places of AIS; its number is never cut off."""
    letters = unicodedata.normalize("NFKD", craft.fleet or craft.kind).encode("ascii", "ignore").decode().upper()
    known = "".join(letter if letter in ALPHABET else "?" for letter in letters)
    return f"{known[: LONGEST_NAME - 1 - len(str(craft.number))].strip()} {craft.number}".strip()


def _knots(speed: float) -> float:
    return NO_SPEED if math.isnan(speed) else min(round(speed / KNOT, 1), FASTEST)


def _course(course: float) -> float:
    return NO_COURSE if math.isnan(course) else round(course, 1) % 360.0


def _heading(heading: float) -> int:
    return NO_HEADING if math.isnan(heading) else round(heading) % 360


def _sentences(message: dict[str, Any]) -> list[str]:
    try:
        from pyais.encode import encode_dict
    except ImportError as error:
        raise MissingExtraError.of("pyais", "maritime", "writing AIS") from error
    sentences: list[str] = encode_dict(message, talker_id="AI", sentence_type="VDM")
    return sentences
