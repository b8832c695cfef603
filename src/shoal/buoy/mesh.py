"""A mesh: what one buoy, or a process of several, publishes reaches all others that are there, itself included."""

import queue
from collections.abc import Callable
from contextlib import suppress
from typing import Protocol


class Mesh(Protocol):
    """What carries reports, and orders beside them.

    It promises nothing: what it brings may be late, repeated, reordered, damaged or lost.
    """

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call; if nothing did, wait for it as long as `timeout` [s]."""

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

    def nodes(self) -> set[str]:
        """Return who is there, this node included."""

    def answer(self, how: Callable[[], bytes]) -> None:
        """Answer whoever asks with what this function returns, in any thread."""

    def ask(self, node: str, answered: Callable[[bytes], None]) -> None:
        """Ask a node; its answer goes to this function, in any thread, if one ever comes."""


def drained(arrived: "queue.SimpleQueue[bytes]", timeout: float) -> list[bytes]:
    """Return what is in a queue; if nothing is, wait for it as long as `timeout` [s].

    Only whoever has just found it empty may wait: of a queue whose lock is free, `get` takes the lock first, and if its
    time is over by then it waits for ever (CPython 3.11).
    """
    found = _in(arrived)
    if not found and timeout > 0.0:
        with suppress(queue.Empty):
            found.append(arrived.get(timeout=timeout))
            found += _in(arrived)
    return found


def _in(arrived: "queue.SimpleQueue[bytes]") -> list[bytes]:
    found: list[bytes] = []
    with suppress(queue.Empty):
        while True:
            found.append(arrived.get_nowait())
    return found


class MemoryMesh:
    """A mesh within one process, perfect.

    Parameters
    ----------
    nodes : all nodes of the mesh, a list that they share; this one adds itself
    name : what this node is called
    """

    def __init__(self, nodes: "list[MemoryMesh]", name: str = "") -> None:
        self.name = name
        self._how: Callable[[], bytes] | None = None
        self._nodes = nodes
        self._arrived: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        self._orders: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        nodes.append(self)

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""
        for node in self._nodes:
            node._arrived.put(data)

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call; if nothing did, wait for it as long as `timeout` [s]."""
        return drained(self._arrived, timeout)

    def order(self, data: bytes) -> None:
        """Send an order, or an answer to one, to all who are there."""
        for node in self._nodes:
            node._orders.put(data)

    def orders(self, timeout: float) -> list[bytes]:
        """Return the orders and answers that arrived since the last call, as `take` does."""
        return drained(self._orders, timeout)

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""
        return len(self._nodes)

    def nodes(self) -> set[str]:
        """Return who is there, this node included."""
        return {node.name for node in self._nodes}

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
