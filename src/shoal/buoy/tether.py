"""What a stand-in sea and the buoys in it say to each other, as bytes: instruments and engines, no radio.

A tick goes to a process: what the instruments of its buoys say at a step, who of the swarm is there, and whom each
hears where the scenario limits radios. Commands come back: what each buoy wants, and what it remembers, for the record.
"""

import json
import struct
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import MessageError
from shoal.core.messages import Reading

READINGS = np.dtype(
    [
        ("id", "<i4"),
        *((name, "<f8") for name in ("x", "y", "vx", "vy")),
        ("on_target", "?"),
        ("drift_x", "<f8"),
        ("drift_y", "<f8"),
        ("aground", "?"),
    ]
)
_TICK, _COMMANDS, _NOTE = b"TCN"
_HEAD = struct.Struct("<BIIIII")  # kind, step, turn, and three numbers
BEGIN = 2**32 - 1  # the turn of a tick that asks buoys to set up their memories


class Tick(NamedTuple):
    """Step `step` begins for the n buoys of a process that are there; N agents.

    turn : 0, or how often this step was begun again because a buoy was lost in it
    readings : (n,) of READINGS; alive : (N,) who of the swarm is there
    hears : (n, N) whom each hears; None: whomever its reports reach
    """

    step: int
    turn: int
    readings: npt.NDArray[Any]
    alive: npt.NDArray[np.bool_]
    hears: npt.NDArray[np.bool_] | None = None

    def of(self, ids: Any) -> "Tick":
        """The part of a tick that concerns some buoys."""
        wanted = np.zeros(len(self.alive), bool)
        wanted[list(ids)] = True
        mine = wanted[self.readings["id"]]
        return self._replace(readings=self.readings[mine], hears=None if self.hears is None else self.hears[mine])

    def to_bytes(self) -> bytes:
        """As it goes to a process."""
        head = _HEAD.pack(
            _TICK, self.step, self.turn, len(self.readings), len(self.alive), 0 if self.hears is None else 1
        )
        parts = [head, np.packbits(self.alive).tobytes(), np.ascontiguousarray(self.readings).tobytes()]
        if self.hears is not None:
            parts.append(np.packbits(self.hears).tobytes())
        return b"".join(parts)


class Commands(NamedTuple):
    """What n buoys want at a step: velocities (n, 2) [m/s] before their limits, and what they remember, (n, M).

    heard : (n, N) whom each heard when it decided, for the record; None: as the sea has it
    """

    step: int
    turn: int
    ids: npt.NDArray[np.int32]
    wants: npt.NDArray[np.float64]
    memory: npt.NDArray[np.float64]
    heard: npt.NDArray[np.bool_] | None = None

    def to_bytes(self) -> bytes:
        """As they go to the sea."""
        agents = 0 if self.heard is None else self.heard.shape[1]
        head = _HEAD.pack(_COMMANDS, self.step, self.turn, len(self.ids), self.memory.shape[1], agents)
        parts = [self.ids, self.wants, self.memory, *([] if self.heard is None else [np.packbits(self.heard)])]
        return b"".join([head, *(np.ascontiguousarray(each).tobytes() for each in parts)])


class Note(NamedTuple):
    """Anything else that is said, once in a while: a word, and facts about it."""

    word: str
    facts: dict[str, Any]

    def to_bytes(self) -> bytes:
        """As it goes either way."""
        return bytes([_NOTE]) + json.dumps([self.word, self.facts]).encode()


def from_bytes(data: bytes) -> Tick | Commands | Note:
    """Return what bytes say.

    Raises
    ------
    MessageError : nothing that a sea and its buoys say
    """
    try:
        if data[0] == _NOTE:
            word, facts = json.loads(data[1:])
            return Note(str(word), dict(facts))
        kind, step, turn, count, width, more = _HEAD.unpack_from(data)
        rest = memoryview(data)[_HEAD.size :]
        if kind == _TICK:
            return _tick(step, turn, count, width, more, rest)
        if kind == _COMMANDS:
            sizes = 4 * count, 16 * count, 8 * count * width, -(-count * more // 8)
            if len(rest) != sum(sizes):
                raise ValueError("it has another length")
            ids = np.frombuffer(rest[: sizes[0]], "<i4")
            wants = np.frombuffer(rest[sizes[0] : sizes[0] + sizes[1]], "<f8").reshape(count, 2)
            memory = np.frombuffer(rest[sizes[0] + sizes[1] : sum(sizes[:3])], "<f8").reshape(count, width)
            bits = np.unpackbits(np.frombuffer(rest[sum(sizes[:3]) :], np.uint8), count=count * more)
            heard = bits.astype(bool).reshape(count, more) if more else None
            return Commands(step, turn, ids, wants, memory, heard)
        raise ValueError("it is of no kind")
    except (ValueError, TypeError, IndexError, struct.error, RecursionError) as error:
        raise MessageError("tether", f"brought what is no message: {error}", "connect buoys and seas only") from error


def _tick(step: int, turn: int, count: int, agents: int, limited: int, rest: memoryview) -> Tick:
    there = -(-agents // 8)
    readings = there + READINGS.itemsize * count
    hears = -(-count * agents // 8) if limited else 0
    if len(rest) != readings + hears:
        raise ValueError("it has another length")
    alive = np.unpackbits(np.frombuffer(rest[:there], np.uint8), count=agents).astype(bool)
    links = np.unpackbits(np.frombuffer(rest[readings:], np.uint8), count=count * agents) if limited else None
    return Tick(
        step,
        turn,
        np.frombuffer(rest[there:readings], READINGS),
        alive,
        None if links is None else links.astype(bool).reshape(count, agents),
    )


def numbers_of(tick: Tick) -> npt.NDArray[np.float64]:
    """What the instruments of a tick say as numbers, (n, 8), in the order of a Reading's fields."""
    return np.array([tick.readings[name] for name in Reading._fields], float).T.copy()


def readings_of(tick: Tick) -> list[tuple[int, Reading]]:
    """What the instruments of a tick say, as buoys take it, each with its buoy."""
    return [(id, Reading(*rest)) for id, *rest in tick.readings.tolist()]
