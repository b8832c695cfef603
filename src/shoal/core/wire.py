"""A report as bytes: what goes over the air, and how it is read back.

Little-endian, without padding: version (1 byte), id (4), time (8), x, y, vx, vy (8 each), on_target (1), one number (8)
for each field of `told`, and the CRC-32 of all that (4): 50 bytes, and 8 for each field told.
"""

import math
import struct
import zlib
from collections import namedtuple
from functools import cache
from typing import Any

from shoal.core.errors import MessageError

VERSION = 1
_CHECK = struct.Struct("<I")


def wire_bytes(told: int) -> int:
    """Size of a report that tells this many numbers [B]."""
    return _body(told).size + _CHECK.size


def pack(report: Any) -> bytes:
    """A report as bytes; see `unpack`.

    Raises
    ------
    MessageError : a number is not finite, or the id is not one of 32 bits
    """
    number, x, y, vx, vy, on_target, told, time, _ = report
    try:
        body = _body(len(told)).pack(VERSION, number, time, x, y, vx, vy, bool(on_target), *told)
    except struct.error as error:
        raise MessageError("report", f"cannot be written: {error}", "give an id of 32 bits, and numbers") from error
    _check_finite(report, told)
    return body + _CHECK.pack(zlib.crc32(body))


def unpack(data: Any, told: tuple[str, ...], report: type[Any]) -> Any:
    """The report in some bytes.

    Parameters
    ----------
    data : bytes, as `pack` writes them
    told : names of the fields that the swarm's strategies tell, in their order
    report : the class to make

    Raises
    ------
    MessageError : too few or too many bytes, of another version, or damaged
    """
    try:
        data = bytes(memoryview(data))
    except TypeError:
        raise MessageError("report", f"is {type(data).__name__}, not bytes", "give what to_bytes returned") from None
    size = wire_bytes(len(told))
    if len(data) != size:
        fields = f" with {', '.join(told)}" if told else ""
        raise MessageError("report", f"has {len(data)} bytes, but one{fields} has {size}", "drop it")
    body = data[: -_CHECK.size]
    if _CHECK.unpack_from(data, len(body))[0] != zlib.crc32(body):
        raise MessageError("report", "is damaged: its checksum does not match", "drop it; the next comes in a step")
    version, number, time, x, y, vx, vy, on_target, *rest = _body(len(told)).unpack(body)
    if version != VERSION:
        problem = f"is of version {version} of the format, this is version {VERSION}"
        raise MessageError("report", problem, "give all buoys the same version of Shoal")
    numbers = told_class(told)(*rest)
    read = report(number, x, y, vx, vy, bool(on_target), numbers, time)
    _check_finite(read, numbers)
    return read


def wire_dtype(told: tuple[str, ...] = ()) -> Any:
    """The same layout as a NumPy dtype, to read a log of many reports at once: np.frombuffer(log, wire_dtype())."""
    import numpy as np

    numbers = [(name, "<f8") for name in told]
    return np.dtype(
        [
            ("version", "u1"),
            ("id", "<u4"),
            *((name, "<f8") for name in ("time", "x", "y", "vx", "vy")),
            ("on_target", "?"),
            *([("told", numbers)] if told else []),
            ("checksum", "<u4"),
        ]
    )


@cache
def _body(told: int) -> struct.Struct:
    return struct.Struct(f"<BIdddddB{told}d")


@cache
def told_class(told: tuple[str, ...]) -> type[Any]:
    """NamedTuple of what is told."""
    return namedtuple("Told", told)


def _check_finite(report: Any, told: tuple[float, ...]) -> None:
    _, x, y, vx, vy, _, _, time, _ = report
    if not all(map(math.isfinite, (x, y, vx, vy, time, *told))):
        raise MessageError("report", f"of agent {report.id} holds a number that is not finite", "drop it")
