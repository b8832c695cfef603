"""A bulletin: all that a watcher needs of a fleet at a time, as it goes over the mesh."""

import json
import struct
from collections.abc import Iterator
from typing import Any, NamedTuple, Protocol

from shoal.core.errors import MessageError
from shoal.record.voyage.voyages import Places
from shoal.run.facts import facts_told
from shoal.viewer.frame import places_of
from shoal.viewer.scene import as_json

FORMAT = 1
MOST = 1 << 20  # bytes of the words
_HEAD = struct.Struct("<BI")  # format, bytes of the words


class Bulletin(NamedTuple):
    """What a fleet says of itself.

    scene : as pages get it; origin : its center on Earth, longitude and latitude [deg], None where it has none
    speed : times real time; None where a step takes as long as it takes
    busy : a sentence while nothing goes on, such as that buoys start; None else
    frame : as pages get it; empty before the first
    """

    scene: dict[str, Any]
    origin: tuple[float, float] | None
    speed: float | None
    busy: str | None
    frame: bytes

    @property
    def step(self) -> int:
        """The step that the frame begins; 0 without a frame."""
        return int(self.places.step[0]) if self.frame else 0

    @property
    def places(self) -> Places:
        """Where everybody is in the frame."""
        return places_of(self.frame)

    def to_bytes(self) -> bytes:
        """As it goes over the mesh."""
        words = as_json({"scene": self.scene, "origin": self.origin, "speed": self.speed, "busy": self.busy}).encode()
        return _HEAD.pack(FORMAT, len(words)) + words + self.frame

    @classmethod
    def from_bytes(cls, data: bytes) -> "Bulletin":
        """Return what bytes say.

        Parameters
        ----------
        data : what `to_bytes` made

        Raises
        ------
        MessageError : no bulletin, or one of another version
        """
        try:
            version, size = _HEAD.unpack_from(data)
            if version != FORMAT or size > MOST:
                raise ValueError(f"it is of format {version}, not {FORMAT}")
            words, frame = json.loads(data[_HEAD.size : _HEAD.size + size]), data[_HEAD.size + size :]
            origin, speed, busy = words["origin"], words["speed"], words["busy"]
            read = cls(
                dict(words["scene"]),
                None if origin is None else (float(origin[0]), float(origin[1])),
                None if speed is None else float(speed),
                None if busy is None else str(busy),
                frame,
            )
            facts = facts_told(read.scene)
            if frame and (facts.agents, len(read.scene["targets"])) != (
                read.places.x.shape[1],
                read.places.target_x.shape[1],
            ):
                raise ValueError("its frame is not of its scene")
        except (ValueError, TypeError, KeyError, IndexError, OverflowError, RecursionError, struct.error) as error:
            fix = "watch with the same version of Shoal as the fleet's"
            raise MessageError("the fleet", f"says what cannot be read: {error}", fix) from None
        return read


class Lookout(Protocol):
    """What hears a fleet's beacon."""

    @property
    def over(self) -> bool:
        """Whether the beacon is gone, and everything that it told was taken."""

    def next(self, timeout: float) -> bytes | None:
        """Return the newest message, each once; None if there is none after `timeout` [s]."""


def bulletins(lookout: Lookout, timeout: float) -> Iterator[Bulletin | None]:
    """Yield what a fleet says until it is gone, and None whenever it says nothing for so long [s]; noise is dropped."""
    while not lookout.over:
        message = lookout.next(timeout)
        try:
            yield Bulletin.from_bytes(message) if message else None
        except MessageError:
            continue
