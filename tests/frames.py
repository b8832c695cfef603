"""Frames of the viewer, decoded by the letter of docs/reference/view-protocol.md and nothing of Shoal's."""

import math
import struct
from types import SimpleNamespace

GAUGES = ("time_on_target", "recent", "xi", "xi_now", "engaged")


def decode(data):
    """The frame at the beginning of some bytes; `size` is where it ends."""
    version, run, epoch, step, agents, targets, link_bytes, fields = struct.unpack_from("<BBHIIIHH", data)
    assert version in (3, 4)
    detailed = agents if version == 4 else 0
    place = struct.calcsize("<BBHIIIHH")

    def take(letter, count):
        nonlocal place
        values = struct.unpack_from(f"<{count}{letter}", data, place)
        place += struct.calcsize(f"<{count}{letter}")
        return list(values)

    numbers = take("f", 16)
    frame = SimpleNamespace(run=run, epoch=epoch, step=step, **dict(zip(GAUGES, numbers, strict=False)))
    frame.phi = numbers[5:]
    frame.x, frame.y = take("f", agents), take("f", agents)
    frame.vx, frame.vy, frame.repulsion = (take("f", detailed) for _ in range(3))
    frame.memory = [take("f", agents) for _ in range(fields)]
    frame.target_x, frame.target_y = take("f", targets), take("f", targets)
    frame.degree = take("H", detailed)
    bits = take("B", agents)
    frame.on_target, frame.alive = [bool(each & 1) for each in bits], [bool(each & 2) for each in bits]
    frame.silent = [bool(each & 4) for each in bits]
    frame.present = [bool(each & 1) for each in take("B", targets)]
    rows = [take("B", link_bytes) for _ in range(agents)]
    frame.hears = [[bool(row[j // 8] >> (j % 8) & 1) for j in range(agents)] for row in rows] if link_bytes else None
    frame.size = place
    return frame


def decode_all(data):
    """Frames one behind the other."""
    frames, place = [], 0
    while place < len(data):
        frames.append(decode(data[place:]))
        place += frames[-1].size
    return frames


def same_number(one, other):
    """Equal to the precision of a float32, or both no number."""
    return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-6) or (math.isnan(one) and math.isnan(other))
