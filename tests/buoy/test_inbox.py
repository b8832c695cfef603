"""An inbox takes whatever a mesh brings, keeps each report once, and counts the rest."""

import random

import pytest

from shoal.buoy.inbox import Inbox
from shoal.buoy.rows import row_of
from shoal.core.messages import Report


def report(id, step, x=0.0, time_step=0.1):
    return Report(id, x, 0.0, 0.0, 0.0, False, (), step * time_step)


def inbox(kept=3):
    return Inbox(agents=5, told=(), time_step=0.1, kept=kept)


def test_a_report_is_there_for_its_step():
    mine = inbox()
    mine.put([report(3, 7, x=1.5).to_bytes()], 7)
    assert mine.of(7) == {3: row_of(report(3, 7, x=1.5))}
    assert mine.of(6) == {}
    assert mine.missing(7, [1, 3]) == {1}


@pytest.mark.parametrize("time_step", [0.1, 1 / 3, 15.0, 1e-3])
def test_a_step_survives_the_way_through_seconds(time_step):
    mine = Inbox(agents=5, told=(), time_step=time_step, kept=0)
    for step in (0, 1, 99_999, 10**9):
        mine.put([report(0, step, time_step=time_step).to_bytes()], step)
        assert mine.of(step)


@pytest.mark.parametrize(
    ("arrives", "word"),
    [
        (report(3, 7).to_bytes(), "duplicate"),
        (report(2, 6).to_bytes(), "late"),
        (report(2, 13).to_bytes(), "early"),
        (report(5, 10).to_bytes(), "strange"),
        (report(2, 10.4).to_bytes(), "strange"),
        (report(2, -1).to_bytes(), "strange"),
        (Report(2, 0.0, 0.0, 0.0, 0.0, False, (), 1e300).to_bytes(), "strange"),
        (report(2, 10).to_bytes()[:-1] + b"!", "damaged"),
        (report(2, 10).to_bytes() + b"!", "damaged"),
        (b"", "damaged"),
    ],
)
def test_what_is_of_no_use_is_counted_and_dropped(arrives, word):
    mine = inbox()
    mine.put([report(3, 7).to_bytes()], 7)
    before = {step: dict(mine.of(step)) for step in range(20)}
    assert mine.put([arrives, report(4, 10).to_bytes()], 10) == [word, "new"]
    assert mine.counts == {"new": 2, word: 1}
    del mine._said[10][4]
    assert {step: dict(mine.of(step)) for step in range(20)} == before


def test_it_says_of_each_what_it_is_and_of_whom_and_when():
    mine, said = inbox(), report(3, 7).to_bytes()
    assert mine.put([said, said, report(3, 7, x=9.0).to_bytes(), report(3, 2).to_bytes(), b""], 7) == [
        "new",
        "duplicate",
        "changed",
        "late",
        "damaged",
    ]
    assert mine.source(said) == (3, 7)
    assert mine.put([], 7) == []


def test_an_older_one_after_a_newer_one_is_kept_and_counted():
    mine = inbox()
    mine.put([report(1, 9).to_bytes(), report(1, 8).to_bytes()], 9)
    assert mine.counts["reordered"] == 1
    assert mine.counts["new"] == 2
    assert mine.of(8) == {1: row_of(report(1, 8))}


def test_the_newest_of_each_no_older_than_allowed():
    mine = inbox()
    for id, step in ((0, 5), (0, 6), (1, 5), (2, 4)):
        mine.put([report(id, step).to_bytes()], 6)
    assert mine.newest(6, 1) == {0: row_of(report(0, 6)), 1: row_of(report(1, 5))}
    assert mine.when(6, 1) == {0: 6, 1: 5}
    assert set(mine.newest(6, 0)) == set(mine.when(6, 0)) == {0}


def test_what_nobody_asks_for_is_forgotten():
    mine = inbox(kept=2)
    for step in range(100):
        mine.put([report(0, step).to_bytes()], step)
        mine.forget(step)
    assert [step for step in range(100) if mine.of(step)] == [97, 98, 99]


def test_noise_is_survived():
    chance, mine = random.Random(1), inbox()
    whole = report(1, 5).to_bytes()
    for _ in range(2000):
        noise = bytearray(whole if chance.random() < 0.5 else chance.randbytes(chance.randrange(120)))
        if noise:
            noise[chance.randrange(len(noise))] ^= 1 << chance.randrange(8)
        mine.put([bytes(noise)], 5)
    assert mine.counts["new"] == 0
    assert sum(mine.counts.values()) == 2000


def test_who_was_ahead_says_the_same_step_again_and_that_counts():
    mine = inbox()
    for data, word in (
        (report(3, 9, x=1.0), "new"),
        (report(3, 9, x=2.0), "changed"),
        (report(3, 9, x=2.0), "duplicate"),
    ):
        before = mine.counts[word]
        mine.put([data.to_bytes()], 7)
        assert mine.counts[word] == before + 1
    assert mine.of(9) == {3: row_of(report(3, 9, x=2.0))}


def test_what_was_heard_by_a_clock_that_was_ahead_is_forgotten_when_it_is_set_back():
    mine = inbox()
    mine.put([report(3, 40).to_bytes()], 40)
    mine.forget(12)
    assert mine.of(40) == {}


def test_what_others_say_under_a_number_of_ours_is_counted():
    mine, own = inbox(), report(3, 7).to_bytes()
    mine.put([report(3, 7, x=2.0).to_bytes()], 7)  # before it spoke itself, it may be of its life before
    mine.spoke(3, 7, own)
    for data in (own, own, report(3, 6).to_bytes(), report(2, 7).to_bytes()):
        mine.put([data], 7)
    assert mine.foreign == 0
    mine.put([report(3, 7, x=2.0).to_bytes()], 7)
    assert mine.foreign == 1
    mine.forget(30)
    mine.put([report(3, 7, x=3.0).to_bytes()], 30)
    assert mine.foreign == 1
