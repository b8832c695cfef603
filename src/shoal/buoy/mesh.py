"""A mesh: what one buoy, or a process of several, publishes reaches all others that are there, itself included."""

import time
from collections import deque
from collections.abc import Callable
from typing import Protocol

MOST = 16_384  # messages that wait to be taken; of more, the oldest are dropped
BATCH = 1024  # that are taken at a time, so that whoever takes them can look at the clock between two batches
_SHORTEST, _LONGEST = 1e-4, 2e-3  # [s] between two looks


class Mesh(Protocol):
    """What carries reports, and orders beside them.

    It promises nothing: what it brings may be late, repeated, reordered, damaged or lost.
    """

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call, a batch at most; if nothing did, wait for it up to `timeout` [s]."""

    def order(self, data: bytes) -> None:
        """Send an order, or an answer to one, to all who are there."""

    def orders(self, timeout: float) -> list[bytes]:
        """Return the orders and answers that arrived since the last call, as `take` does."""

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""

    def close(self) -> None:
        """Leave."""


class Peers(Mesh, Protocol):
    """A mesh whose nodes know each other by name, and ask each other the time."""

    def join(self) -> None:
        """Be there for the others, from now on."""

    def nodes(self) -> set[str]:
        """Return who is there, this node included if it joined."""

    def namesakes(self) -> tuple[int, int]:
        """Return how many others of this node's name came before it, and after it."""

    def answer(self, how: Callable[[], bytes]) -> None:
        """Answer whoever asks with what this function returns, in any thread."""

    def ask(self, node: str, answered: Callable[[bytes], None]) -> None:
        """Ask a node; its answer goes to this function, in any thread, if one ever comes."""


def awaited(next_one: Callable[[], bytes | None], timeout: float) -> list[bytes]:
    """Return a batch of what arrived; if nothing did, wait for it as long as `timeout` [s].

    It looks again and again: to be called by threads that bring messages would cost more, one by one, in a flood.

    Parameters
    ----------
    next_one : returns a message, each once; None if there is none
    """
    until, pause = time.monotonic() + timeout, _SHORTEST
    while (first := next_one()) is None:
        left = until - time.monotonic()
        if left <= 0.0:
            return []
        time.sleep(min(pause, left))
        pause = min(2 * pause, _LONGEST)
    found = [first]
    while len(found) < BATCH and (another := next_one()) is not None:
        found.append(another)
    return found


class MemoryMesh:
    """A mesh within one process, perfect as long as messages are taken.

    Parameters
    ----------
    nodes : all nodes of the mesh, a list that they share; this one adds itself
    name : what this node is called
    """

    def __init__(self, nodes: "list[MemoryMesh]", name: str = "") -> None:
        self.name = name
        self._how: Callable[[], bytes] | None = None
        self._nodes = nodes
        self._arrived: deque[bytes] = deque()
        self._orders: deque[bytes] = deque(maxlen=MOST)
        nodes.append(self)

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""
        for node in self._nodes:
            node._arrived.append(data)

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call; if nothing did, wait for it as long as `timeout` [s]."""
        return awaited(lambda: _next_of(self._arrived), timeout)

    def order(self, data: bytes) -> None:
        """Send an order, or an answer to one, to all who are there."""
        for node in self._nodes:
            node._orders.append(data)

    def orders(self, timeout: float) -> list[bytes]:
        """Return the orders and answers that arrived since the last call, as `take` does."""
        return awaited(lambda: _next_of(self._orders), timeout)

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""
        return len(self._nodes)

    def join(self) -> None:
        """Be there: it is."""

    def nodes(self) -> set[str]:
        """Return who is there, this node included."""
        return {node.name for node in self._nodes}

    def namesakes(self) -> tuple[int, int]:
        """Return how many others of this node's name came before it, and after it."""
        alike = [node for node in self._nodes if node.name == self.name]
        before = alike.index(self) if self in alike else len(alike)
        return before, max(0, len(alike) - before - 1)

    def answer(self, how: Callable[[], bytes]) -> None:
        """Answer whoever asks with what this function returns."""
        self._how = how

    def ask(self, node: str, answered: Callable[[bytes], None]) -> None:
        """Ask a node; its answer goes to this function, if it answers."""
        for each in self._nodes:
            if each.name == node and each._how is not None:
                answered(each._how())

    def close(self) -> None:
        """Leave."""
        if self in self._nodes:
            self._nodes.remove(self)


def _next_of(arrived: deque[bytes]) -> bytes | None:
    return arrived.popleft() if arrived else None
