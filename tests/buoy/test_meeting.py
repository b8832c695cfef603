"""Buoys wait for each other, and begin at the same time; who comes later joins in."""

import threading
import time

import pytest

from shoal.buoy.clock import CommonClock
from shoal.buoy.meeting import meet
from shoal.buoy.mesh import MemoryMesh
from shoal.buoy.twins import Twins


class Party:
    """Buoys whose clocks are off, each of which meets the others in a thread."""

    def __init__(self):
        self.nodes, self.meshes, self.clocks, self.said, self.threads = [], {}, {}, [], []

    def join(self, id, off, wanted):
        clock = self.clocks[id] = CommonClock(id, 0.5, lambda: time.monotonic() + off)
        mesh = self.meshes[id] = MemoryMesh(self.nodes, str(id))
        twins = Twins(mesh, id, time.monotonic, self.said.append)
        self.threads.append(
            threading.Thread(target=meet, args=(mesh, clock, id, wanted, 0.5, self.said.append, twins), daemon=True)
        )
        self.threads[-1].start()

    def begins(self):
        """When step 0 begins by the clocks of all, as if none were off."""
        for thread in self.threads:
            thread.join(20.0)
            assert not thread.is_alive()
        now = time.monotonic()
        return [clock.begin - clock.now() + now for clock in self.clocks.values()]

    def until(self, words):
        end = time.monotonic() + 20.0
        while words not in self.said:
            assert time.monotonic() < end, self.said
            time.sleep(0.01)


def test_nobody_begins_before_all_are_there_and_later_ones_join():
    party = Party()
    party.join(4, 0.0, 3)
    party.join(9, 5.0, 3)
    party.until("buoy 4: 2 of 3 buoys are here")
    assert party.clocks[4].begin is party.clocks[9].begin is None
    party.join(6, -2.0, 3)
    begins = party.begins()
    assert begins == pytest.approx([begins[0]] * 3, abs=0.5)  # by more if a clock that is off were believed
    party.join(1, 100.0, 3)  # which has the lowest number of all
    assert party.begins()[3] == pytest.approx(begins[0], abs=0.5)
    party.meshes[4].close()
    party.join(4, 50.0, 3)  # and one that was started anew
    assert party.begins() == pytest.approx([begins[0]] * 4, abs=0.5)


def test_one_may_begin_alone():
    party = Party()
    party.join(4, 0.0, 1)
    assert party.begins()[0] > 0.0
