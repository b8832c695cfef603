"""A mesh: what one buoy, or a process of several, publishes reaches all others that are there, itself included."""

import queue
from typing import Protocol

_SOON = 1e-9


class Mesh(Protocol):
    """What carries reports. It promises nothing: what it brings may be late, repeated, reordered, damaged or lost."""

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call; if nothing did, wait for it as long as `timeout` [s]."""

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""

    def close(self) -> None:
        """Leave."""


def drained(arrived: "queue.SimpleQueue[bytes]", timeout: float) -> list[bytes]:
    """Return what is in a queue; if nothing is, wait for it as long as `timeout` [s]."""
    found: list[bytes] = []
    try:
        found.append(arrived.get(timeout=max(timeout, _SOON)))
        while True:
            found.append(arrived.get_nowait())
    except queue.Empty:
        return found


class MemoryMesh:
    """A mesh within one process, perfect.

    Parameters
    ----------
    nodes : all nodes of the mesh, a list that they share; this one adds itself
    """

    def __init__(self, nodes: "list[MemoryMesh]") -> None:
        self._nodes = nodes
        self._arrived: queue.SimpleQueue[bytes] = queue.SimpleQueue()
        nodes.append(self)

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""
        for node in self._nodes:
            node._arrived.put(data)

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call; if nothing did, wait for it as long as `timeout` [s]."""
        return drained(self._arrived, timeout)

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""
        return len(self._nodes)

    def close(self) -> None:
        """Leave."""
        if self in self._nodes:
            self._nodes.remove(self)
