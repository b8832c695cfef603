"""Reports as rows of numbers, many at once: what a process of buoys reads from the mesh, keeps and hands to its minds.

A row is 8 bytes for each of x, y, vx, vy [m, m/s], time [s], id, on_target, and each field told, in this order.
"""

import struct
import zlib
from collections.abc import Sequence
from functools import cache

import numpy as np
import numpy.typing as npt

from shoal.core.messages import Report
from shoal.core.wire import VERSION, told_class, wire_bytes

TIME, ID, ON_TARGET, TOLD = 4, 5, 6, 7  # columns; what is told begins at the last
_FIELDS = ((slice(TIME), "motion"), (TIME, "time"), (ID, "id"), (ON_TARGET, "on_target"), (slice(TOLD, None), "told"))

_WHOLE = 0x2144DF1C  # the CRC-32 of whatever ends with its own CRC-32

Floats = npt.NDArray[np.float64]


def read(messages: Sequence[bytes], told: tuple[str, ...]) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """Read messages that came over the air, by the rules of Report.from_bytes.

    Parameters
    ----------
    messages : m of them; told : names of the fields that reports tell

    Returns
    -------
    (m, 7 + T) numbers of each, zeros where it is damaged; (m,) whether it is a report
    """
    size, count = wire_bytes(len(told)), len(messages)
    nothing = bytes(size)
    fitting = [data if len(data) == size else nothing for data in messages]
    said = np.frombuffer(b"".join(fitting), _layout(len(told)))
    whole = np.fromiter(map(zlib.crc32, fitting), np.int64, count) == _WHOLE
    numbers = np.empty((count, TOLD + len(told)))
    for columns, name in _FIELDS:
        numbers[:, columns] = said[name]
    sound = whole & (said["version"] == VERSION) & np.isfinite(numbers).all(axis=1)
    if not sound.all():
        numbers[~sound] = 0.0
    return numbers, sound


def write(numbers: Floats, told: tuple[str, ...]) -> list[bytes]:
    """Write reports as they go over the air, as Report.to_bytes does.

    Parameters
    ----------
    numbers : (m, 7 + T) of them, all finite; told : names of the fields that they tell
    """
    said = np.empty(len(numbers), _layout(len(told)))
    said["version"] = VERSION
    for columns, name in _FIELDS:
        said[name] = numbers[:, columns]
    whole, size = said.tobytes(), said.itemsize
    bodies = [whole[begin : begin + size - 4] for begin in range(0, len(whole), size)]
    return [body + zlib.crc32(body).to_bytes(4, "little") for body in bodies]


def row_of(report: Report) -> bytes:
    """The row of a report."""
    id, x, y, vx, vy, on_target, told, time, _ = report
    return _numbers(TOLD + len(told)).pack(x, y, vx, vy, time, id, on_target, *told)


def table(rows: Sequence[bytes], told: tuple[str, ...]) -> Floats:
    """Rows as numbers, (m, 7 + T)."""
    return np.frombuffer(b"".join(rows)).reshape(len(rows), TOLD + len(told))


def report_of(numbers: Sequence[float], told: tuple[str, ...]) -> Report:
    """The report that a row's numbers (7 + T,) are of."""
    x, y, vx, vy, time, id, on_target, *rest = numbers
    return Report(int(id), x, y, vx, vy, on_target > 0.0, told_class(told)(*rest), time)


@cache
def _layout(told: int) -> np.dtype[np.void]:
    """That of core/wire.py, with all of the motion, and all that is told, in one field."""
    motion, tells = ("motion", "<f8", 4), ("told", "<f8", told)
    return np.dtype(
        [("version", "u1"), ("id", "<u4"), ("time", "<f8"), motion, ("on_target", "u1"), tells, ("checksum", "<u4")]
    )


@cache
def _numbers(count: int) -> struct.Struct:
    return struct.Struct(f"{count}d")
