"""The frames that a session keeps to go back to: the newest ones, within a number of bytes."""

from bisect import bisect_right
from collections import deque
from threading import Lock
from typing import NamedTuple

import numpy as np
import numpy.typing as npt


class Kept(NamedTuple):
    """What was shown at a step: for each run the messages that say its scene and its numbers, and its frame."""

    step: int
    scenes: tuple[str, ...]
    frames: tuple[bytes, ...]
    numbers: tuple[str, ...] = ()


class Ring:
    """Kept frames in the order of their steps; the oldest are dropped beyond `room` [bytes].

    One thread adds and looks back; `spread` may be called from others.
    """

    def __init__(self, room: int) -> None:
        self._room = room
        self._lock = Lock()
        self._bytes = 0
        self._kept: deque[Kept] = deque()

    def __len__(self) -> int:
        return len(self._kept)

    @property
    def oldest(self) -> Kept:
        """The first that is left."""
        return self._kept[0]

    @property
    def newest(self) -> Kept:
        """The last one added."""
        return self._kept[-1]

    def add(self, kept: Kept) -> None:
        """Keep a frame, instead of the newest if that is of the same step."""
        with self._lock:
            if self._kept and self.newest.step == kept.step:
                self._bytes -= _size(self._kept.pop())
            self._kept.append(kept)
            self._bytes += _size(kept)
            while self._bytes > self._room and len(self._kept) > 1:
                self._bytes -= _size(self._kept.popleft())

    def at(self, step: int) -> Kept:
        """The frame at or before a step; the oldest if all are later."""
        return self._kept[max(0, self._place(step))]

    def beside(self, step: int, frames: int) -> Kept:
        """The frame that lies a number of frames after (before, if negative) the one at a step."""
        return self._kept[min(max(0, self._place(step) + frames), len(self._kept) - 1)]

    def spread(self, frames: int) -> list[Kept]:
        """At most `count` of the frames, spread evenly over their steps, the oldest and the newest among them."""
        with self._lock:
            kept = list(self._kept)
        steps = np.fromiter((each.step for each in kept), np.int64, len(kept))
        return [kept[place] for place in evenly(steps, frames)]

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._kept.clear()
            self._bytes = 0

    def _place(self, step: int) -> int:
        return bisect_right(self._kept, step, key=lambda kept: kept.step) - 1


def evenly(steps: npt.NDArray[np.int64], frames: int) -> npt.NDArray[np.int64]:
    """Indices of at most `count` frames spread evenly in time, given the steps of all in order (K,)."""
    if steps.size <= frames:
        return np.arange(steps.size)
    wanted = np.linspace(steps[0], steps[-1], frames)
    return np.unique(np.searchsorted(steps, wanted, side="right") - 1)


def _size(kept: Kept) -> int:
    return sum(map(len, (*kept.frames, *kept.numbers)))
