"""Every word of the instruments is answered, whatever the clock says, and once."""

from multiprocessing import Pipe
from threading import Thread

import numpy as np
import pytest

from shoal.buoy.inbox import Inbox
from shoal.buoy.mesh import MemoryMesh
from shoal.buoy.paced import Paced
from shoal.buoy.tether import READINGS, Commands, Note, Tick, from_bytes


class Crew:
    """Decides nothing, and notes in which steps it was asked to."""

    ids, orderbook = (0,), None

    def __init__(self):
        self.steps, self.inbox = [], Inbox(1, (), 1.0, 2)

    def speak(self, tick):
        return []

    def hear(self, messages, step):
        pass

    def attend(self, messages, tick, now):
        return []

    def links(self, ids):
        return None

    def missing(self, tick):
        return set()

    def heard(self, tick):
        return {}

    def spoken(self, step):
        return step

    def act(self, tick):
        self.steps.append(tick.step)
        nobody = np.zeros(0)
        return Commands(tick.step, 0, nobody.astype(np.int32), nobody.reshape(0, 2), nobody.reshape(0, 0))


@pytest.fixture
def tied():
    """A process by a clock of the tests' own, its crew, its time in a list, and its sea's end of the tether."""
    sea, tether = Pipe()
    crew, now = Crew(), [1000.0]
    driver = Paced(crew, MemoryMesh([]), tether, 1.0, 1)
    driver._now = lambda: now[0]
    thread = Thread(target=driver.run, daemon=True)
    thread.start()
    yield sea, crew, now
    sea.send_bytes(Note("over", {}).to_bytes())
    thread.join(10.0)
    assert not thread.is_alive()
    sea.close()
    tether.close()


def answered(sea, step):
    sea.send_bytes(Tick(step, 0, np.zeros(0, READINGS), np.ones(1, bool)).to_bytes())
    assert sea.poll(10.0), f"step {step} is not answered"
    return from_bytes(sea.recv_bytes()).step


@pytest.mark.parametrize("ahead", [0.0, 0.4, 1.0, 2.7, 20.0])
def test_a_clock_that_is_ahead_costs_no_decision(tied, ahead):
    sea, crew, now = tied
    sea.send_bytes(Note("clock", {"begin": 1000.0 - ahead}).to_bytes())
    for step in range(8):
        assert answered(sea, step) == step + int(ahead)
        now[0] += 1.0
    assert crew.steps == list(range(int(ahead), int(ahead) + 8))


def test_one_that_is_behind_goes_by_the_sea(tied):
    sea, _, now = tied
    sea.send_bytes(Note("clock", {"begin": 1005.0}).to_bytes())
    for step in range(4):
        assert answered(sea, step) == step
        now[0] += 1.0


def test_one_that_is_set_back_goes_on_at_the_step_that_it_is(tied):
    sea, crew, now = tied
    sea.send_bytes(Note("clock", {"begin": 980.0}).to_bytes())
    assert answered(sea, 0) == 20
    now[0] += 1.0
    sea.send_bytes(Note("clock", {"begin": 1000.0}).to_bytes())
    assert answered(sea, 1) == 1
    assert crew.steps == [20, 1]


def test_the_time_is_said_to_who_asks(tied):
    sea, _, _ = tied
    sea.send_bytes(Note("ping", {"sent": 7.0}).to_bytes())
    assert sea.poll(10.0)
    assert from_bytes(sea.recv_bytes()) == Note("pong", {"sent": 7.0, "here": 1000.0})
