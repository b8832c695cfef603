"""A mesh in memory brings everything to everybody who is there."""

from shoal.buoy.mesh import MemoryMesh


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
