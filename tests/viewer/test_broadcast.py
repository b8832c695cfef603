"""Broadcast: whole messages, in order, to all who listen; a slow one misses some and holds up nobody."""

import socket
import time

import pytest

from plotters import Plotter
from shoal.core.errors import ShoalError
from shoal.viewer.broadcast import Broadcast


def serving(greeting=b"hello\r\n"):
    return Broadcast("127.0.0.1", 0, greeting)


def met(broadcast, count):
    """Wait until so many have been greeted."""
    deadline = time.monotonic() + 30
    while broadcast.met < count:
        assert time.monotonic() < deadline
        broadcast.wait(time.monotonic() + 0.01)


class TestBroadcast:
    def test_everybody_is_greeted_and_hears_all_from_then_on(self):
        with serving() as broadcast:
            first = Plotter(broadcast.port)
            broadcast.wait_for_somebody()
            broadcast.send(b"1\r\n")
            broadcast.wait(0.0)
            second = Plotter(broadcast.port)
            met(broadcast, 2)
            broadcast.send(b"2\r\n")
            broadcast.finish()
            assert (broadcast.sent, broadcast.missed) == (3, 0)
        assert first.lines() == [b"hello", b"1", b"2"]
        assert second.lines() == [b"hello", b"2"]

    def test_a_slow_one_misses_whole_messages_and_holds_up_nobody(self):
        messages = [str(i).encode() * 200_000 + b"\r\n" for i in range(1, 10)] * 5
        with serving() as broadcast:
            slow = socket.create_connection(("127.0.0.1", broadcast.port))
            met(broadcast, 1)
            fast = Plotter(broadcast.port)
            met(broadcast, 2)
            for message in messages:
                before = len(fast.heard)
                broadcast.send(message)
                while len(fast.heard) < before + len(message):
                    broadcast.wait(0.0)
            assert broadcast.missed > 0
            taken = b""
            while not taken.endswith(b"\r\n") or len(taken) < 200_000:  # what was begun is finished, when it listens
                broadcast.wait(0.0)
                taken += slow.recv(65536)
            slow.close()
        assert fast.lines() == [b"hello", *(each[:-2] for each in messages)]
        known = {b"hello", *(each[:-2] for each in messages)}
        assert set(taken.split(b"\r\n")[:-1]) <= known

    def test_one_that_leaves_or_talks_is_no_trouble(self):
        with serving() as broadcast:
            gone = socket.create_connection(("127.0.0.1", broadcast.port))
            there = Plotter(broadcast.port)
            met(broadcast, 2)
            gone.sendall(b"GET / HTTP/1.1\r\n\r\n")
            gone.close()
            for _ in range(3):
                broadcast.send(b"x\r\n")
                broadcast.wait(time.monotonic() + 0.01)
            broadcast.finish()
        assert there.lines() == [b"hello", b"x", b"x", b"x"]

    def test_a_port_that_is_taken_is_one_error(self):
        with serving() as broadcast, pytest.raises(ShoalError, match=rf"--tcp {broadcast.port}: is in use\n  fix"):
            Broadcast("127.0.0.1", broadcast.port, b"")

    @pytest.mark.parametrize(
        ("host", "port", "words"), [("127.0.0.1", 99999, "--tcp: is 99999"), ("::nowhere", 0, "--host")]
    )
    def test_what_is_no_address_is_one_error(self, host, port, words):
        with pytest.raises(ShoalError, match=words):
            Broadcast(host, port, b"")
