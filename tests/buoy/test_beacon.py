"""A beacon is heard by whoever listens, whenever they come, and waits for nobody."""

import time

import pytest

pytest.importorskip("zenoh", reason="zenoh is not installed")

from plotters import free_port
from shoal.buoy.address import host_and_port
from shoal.buoy.beacon import Beacon, Lookout
from shoal.core.errors import FleetError

HOST = "127.0.0.1"
SOON = 30.0


@pytest.fixture
def beacon():
    beacon = Beacon(HOST, 0)
    yield beacon
    beacon.close()


def test_who_comes_late_hears_the_newest_and_then_what_is_new(beacon):
    beacon.tell(b"old")
    beacon.tell(b"new")
    lookout = Lookout(HOST, beacon.port)
    assert lookout.next(SOON) == b"new"
    beacon.tell(b"newer")
    assert b"newer" in (lookout.next(SOON), lookout.next(SOON))  # the new one may have been told again before
    lookout.close()


def test_one_that_takes_nothing_holds_up_nobody(beacon):
    hung, quick = Lookout(HOST, beacon.port), Lookout(HOST, beacon.port)
    hung._changed.acquire()  # its thread stops at the next message, and takes no more
    try:
        for number in range(50):
            beacon.tell(message := bytes(100_000) + bytes([number]))
            while quick.next(SOON) != message:
                continue
    finally:
        hung._changed.release()
    for each in (hung, quick):
        each.close()


def test_it_is_known_when_it_is_gone():
    beacon = Beacon(HOST, 0)
    beacon.tell(b"last")
    lookout = Lookout(HOST, beacon.port)
    beacon.close()
    heard, until = [], time.monotonic() + SOON
    while not lookout.over:
        assert time.monotonic() < until
        heard.append(lookout.next(0.1))  # nothing, where it takes longer than that
    assert next(each for each in heard if each is not None) == b"last"
    lookout.close()


def test_where_nobody_is_one_error_says_so(monkeypatch):
    monkeypatch.setattr("shoal.buoy.beacon.PATIENCE", 0.5)
    with pytest.raises(FleetError, match="nobody answers there"):
        Lookout(HOST, free_port())


def test_a_mesh_that_is_no_fleet_s_beacon_is_told_apart(monkeypatch):
    from shoal.buoy.zenoh_mesh import ZenohMesh

    monkeypatch.setattr("shoal.buoy.beacon.PATIENCE", 1.0)
    mesh = ZenohMesh("other", "node", listen=f"tcp/{HOST}:{(port := free_port())}")
    mesh.join()
    with pytest.raises(FleetError, match="is no fleet"):
        Lookout(HOST, port)
    mesh.close()


def test_a_port_that_is_taken_is_one_error(beacon):
    with pytest.raises(FleetError, match=r"--listen 127.0.0.1:[0-9]+: cannot be had"):
        Beacon(HOST, beacon.port)


class TestAddress:
    @pytest.mark.parametrize(
        ("text", "parts"),
        [("127.0.0.1:7447", (HOST, 7447)), ("[::1]:80", ("::1", 80)), ("buoy-7.sea:1", ("buoy-7.sea", 1))],
    )
    def test_is_a_host_and_a_port(self, text, parts):
        assert host_and_port(text, "--fleet") == parts

    @pytest.mark.parametrize(
        "text", ["", "x", ":1", "x:", "x:0", "x:65536", "x:1x", "a b:1", "tcp/x:1", "::1:80", "x:-1"]
    )
    def test_anything_else_is_refused(self, text):
        with pytest.raises(FleetError, match="--fleet: is"):
            host_and_port(text, "--fleet")

    def test_a_free_port_is_one_only_to_listen_at(self):
        assert host_and_port("x:0", "--listen", free=True) == ("x", 0)
