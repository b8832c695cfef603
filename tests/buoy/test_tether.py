"""Ticks, commands and notes survive the way through bytes; anything else is one error."""

import random

import numpy as np
import pytest

from shoal.buoy.tether import READINGS, Commands, Note, Tick, from_bytes, readings_of
from shoal.core.errors import MessageError
from shoal.core.messages import Reading


def tick(limited):
    chance = np.random.default_rng(1)
    readings = np.zeros(3, READINGS)
    readings["id"] = [2, 5, 9]
    for name in ("x", "y", "vx", "vy", "drift_x", "drift_y"):
        readings[name] = chance.normal(size=3)
    readings["on_target"][1] = readings["aground"][2] = True
    hears = chance.random((3, 11)) < 0.5 if limited else None
    return Tick(7, 1, readings, chance.random(11) < 0.8, hears)


def commands(width, agents=0):
    chance = np.random.default_rng(2)
    wants, memory = chance.normal(size=(2, 2)), chance.normal(size=(2, width))
    heard = chance.random((2, agents)) < 0.5 if agents else None
    return Commands(7, 0, np.array([2, 5], np.int32), wants, memory, heard)


def same(one, other):
    return type(one) is type(other) and all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


@pytest.mark.parametrize("message", [tick(True), tick(False), commands(0), commands(3), commands(3, 11)])
def test_there_and_back(message):
    back = from_bytes(message.to_bytes())
    assert same(back, message)
    assert [each.dtype for each in back if isinstance(each, np.ndarray)] == [
        each.dtype for each in message if isinstance(each, np.ndarray)
    ]


def test_a_note():
    note = Note("hello", {"ids": [1, 2], "x": 0.1})
    assert from_bytes(note.to_bytes()) == note


def test_the_part_of_a_tick_for_some_buoys():
    part = tick(True).of((5, 9))
    assert part.readings["id"].tolist() == [5, 9]
    assert np.array_equal(part.hears, tick(True).hears[1:])
    assert part.alive.size == 11


def test_a_reading_as_a_buoy_takes_it():
    row = tick(False).readings[1]
    id, reading = readings_of(tick(False))[1]
    assert id == row["id"]
    assert reading == Reading(*(row[name] for name in Reading._fields))
    assert [type(each) for each in reading] == [float] * 4 + [bool] + [float] * 2 + [bool]


def test_anything_else_is_one_error():
    chance = random.Random(1)
    whole = tick(True).to_bytes()
    for length in [0, 1, len(whole) - 1, len(whole) + 1, *(chance.randrange(200) for _ in range(500))]:
        noise = (whole + b"!")[:length] if chance.random() < 0.5 else chance.randbytes(length)
        if noise != whole:
            with pytest.raises(MessageError):
                from_bytes(noise)
