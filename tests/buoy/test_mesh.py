"""A mesh in memory brings everything to everybody who is there."""

import socket
import threading
import time

import pytest

from shoal.buoy.address import free_port
from shoal.buoy.mesh import BATCH, MemoryMesh
from shoal.buoy.zenoh_mesh import ZenohMesh
from shoal.core.errors import FleetError

SOON = 20.0  # [s] a busy machine may take that long


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


def test_it_waits_for_what_comes_as_long_as_is_said():
    nodes = []
    one, other = MemoryMesh(nodes), MemoryMesh(nodes)
    threading.Timer(0.05, other.publish, [b"late"]).start()
    assert one.take(0.0) == []
    assert one.take(60.0) == [b"late"]


def test_a_flood_is_taken_in_batches_so_that_whoever_takes_it_can_look_at_the_clock():
    mesh = MemoryMesh([])
    for number in range(2 * BATCH + 1):
        mesh.publish(number.to_bytes(4))
    batches = [mesh.take(0.0) for _ in range(4)]
    assert [len(each) for each in batches] == [BATCH, BATCH, 1, 0]
    assert [each for batch in batches for each in batch] == [number.to_bytes(4) for number in range(2 * BATCH + 1)]


def test_who_is_of_the_same_name_and_who_of_them_came_first():
    nodes = []
    one, _, third = MemoryMesh(nodes, "7"), MemoryMesh(nodes, "8"), MemoryMesh(nodes, "7")
    assert (one.namesakes(), third.namesakes()) == ((0, 1), (1, 0))
    one.close()
    assert third.namesakes() == (0, 0)


class TestZenoh:
    """A mesh between processes."""

    @pytest.fixture
    def opened(self):
        pytest.importorskip("zenoh", reason="the extra fleet is not installed")
        meshes = []

        def open_mesh(*about, joins=True, **more):
            meshes.append(ZenohMesh(*about, **more))
            if joins:
                meshes[-1].join()
            return meshes[-1]

        yield open_mesh
        for mesh in meshes:
            mesh.close()

    @staticmethod
    def until(so):
        end = time.monotonic() + SOON
        while not so():
            assert time.monotonic() < end
            time.sleep(0.02)

    def test_a_port_that_somebody_takes_first_is_left_to_them(self, opened, monkeypatch):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            ports = [taken.getsockname()[1]] * 3
            monkeypatch.setattr(
                "shoal.buoy.zenoh_mesh.free_port", lambda host: ports.pop() if ports else free_port(host)
            )
            mesh = opened("shoal/1", "a")
            assert mesh.place != f"tcp/127.0.0.1:{taken.getsockname()[1]}"
        other = opened("shoal/1", "b", connect=[mesh.place])
        self.until(lambda: mesh.alive() == other.alive() == 2)

    def test_a_port_that_is_asked_for_and_taken_is_one_error(self, opened):
        with socket.create_server(("127.0.0.1", 0)) as taken, pytest.raises(FleetError, match="cannot be a mesh"):
            opened("shoal/1", "a", listen=f"tcp/127.0.0.1:{taken.getsockname()[1]}")

    def test_of_more_than_there_is_room_for_the_newest_stay(self, opened, monkeypatch):
        monkeypatch.setattr("shoal.buoy.zenoh_mesh.MOST", 10)
        mesh = opened("shoal/1", "a")
        for number in range(100):
            mesh.publish(bytes([number]))
        time.sleep(0.1)
        found = mesh.take(SOON)
        assert (len(found), found[-1]) == (10, bytes([99]))

    def test_who_only_speaks_is_there_and_hears_nothing(self, opened):
        sea = opened("shoal/1", "sea", hears=False)
        mesh = opened("shoal/1", "7", connect=[sea.place])
        self.until(lambda: mesh.nodes() == sea.nodes() == {"7", "sea"})
        for each in (sea, mesh):
            each.publish(b"report")
            each.order(b"order")
        heard, told = [], []
        self.until(lambda: heard.extend(mesh.take(0.1)) or len(heard) == 2)
        self.until(lambda: told.extend(mesh.orders(0.1)) or len(told) == 2)
        assert (sea.take(0.0), sea.orders(0.0)) == ([], [])

    def test_two_of_one_name_know_of_each_other_and_who_came_first(self, opened):
        one = opened("shoal/1", "7")
        other = opened("shoal/1", "7", connect=[one.place], joins=False)
        self.until(lambda: other.namesakes() == (1, 0))
        assert one.namesakes() == (0, 0)
        other.join()
        self.until(lambda: one.namesakes() == (0, 1))
        assert (other.namesakes(), one.alive()) == ((1, 0), 1)
        one.close()
        self.until(lambda: other.namesakes() == (0, 0))
