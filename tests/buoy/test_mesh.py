"""A mesh in memory brings everything to everybody who is there."""

import queue
import threading

from shoal.buoy.mesh import MemoryMesh, drained


def test_everybody_hears_everybody_and_itself():
    nodes = []
    one, other = MemoryMesh(nodes), MemoryMesh(nodes)
    one.publish(b"a")
    other.publish(b"b")
    assert one.take(0.0) == other.take(0.0) == [b"a", b"b"]
    assert one.take(0.0) == []


def test_who_left_is_not_there():
    nodes = []
    one, other = MemoryMesh(nodes), MemoryMesh(nodes)
    assert one.alive() == 2
    other.close()
    one.publish(b"a")
    assert (one.alive(), other.take(0.0)) == (1, [])


def test_orders_go_beside_reports():
    nodes = []
    one, other = MemoryMesh(nodes), MemoryMesh(nodes)
    one.order(b"hold")
    other.publish(b"report")
    assert one.orders(0.0) == other.orders(0.0) == [b"hold"]
    assert one.take(0.0) == other.take(0.0) == [b"report"]
    assert one.orders(0.0) == []


def test_nobody_waits_for_ever_for_what_does_not_come():
    """At a queue that nobody has found empty yet, 1 of some 10,000 would."""

    def look():
        for _ in range(20_000):
            arrived = queue.SimpleQueue()
            assert drained(arrived, 1e-9) == []
            arrived.put(b"a")
            assert drained(arrived, 1e-9) == [b"a"]
            assert drained(arrived, 1e-9) == []

    looking = threading.Thread(target=look, daemon=True)
    looking.start()
    looking.join(60.0)
    assert not looking.is_alive()
