"""All buoys go by one clock, that of the lowest number, whatever their own say."""

import pytest

from shoal.buoy.clock import CommonClock, Quickest, clock_of, numbers
from shoal.buoy.mesh import MemoryMesh


class Away:
    """A clock that is off by some seconds against a time that all share."""

    def __init__(self, true, off=0.0):
        self.true, self.off = true, off

    def __call__(self):
        return self.true[0] + self.off


class Slow(MemoryMesh):
    """Answers take a second there, and one back."""

    def ask(self, node, answered):
        true = self.true

        def later(data):
            true[0] += 1.0
            answered(data)

        true[0] += 1.0
        super().ask(node, later)


@pytest.fixture
def four():
    """The time that all share, and the clocks and nodes of buoys 2, 5 and 7, of which 5 and 7 are off by 3 and -4 s."""
    true, nodes, found = [100.0], [], {}
    for id, off in ((2, 0.0), (5, 3.0), (7, -4.0)):
        found[id] = CommonClock(id, 0.5, Away(true, off)), Slow(nodes, str(id))
        found[id][1].true = true
        found[id][1].answer(found[id][0].answer)
    return true, found


def matched(found, id):
    clock, mesh = found[id]
    clock.match(mesh)
    clock.hear(numbers(mesh.nodes()))


def test_steps_begin_at_the_same_time_on_clocks_that_are_apart(four):
    true, found = four
    found[2][0].start(110.0)
    for id in (5, 7):
        matched(found, id)
    true[0] = 121.3
    assert [clock.step() for clock, _ in found.values()] == [22, 22, 22]
    assert [clock.elapsed() for clock, _ in found.values()] == pytest.approx([11.3] * 3)
    assert [clock.left(23) for clock, _ in found.values()] == pytest.approx([0.2] * 3)


def test_the_lowest_goes_by_nobody_and_where_it_is_gone_the_next_does(four):
    _, found = four
    for id, begin in ((2, 110.0), (5, 200.0)):
        found[id][0].start(begin)
    for id in (2, 5, 7):
        matched(found, id)
    assert [found[id][0].begin for id in (2, 5, 7)] == [110.0, 113.0, 106.0]
    found[2][1].close()
    found[5][0].start(213.0)
    for id in (5, 7):
        matched(found, id)
    assert [found[id][0].begin for id in (5, 7)] == [213.0, 206.0]


def test_a_clock_that_is_set_anew_is_followed_at_once_and_told(four):
    _, found = four
    found[2][0].start(110.0)
    for _ in range(20):
        matched(found, 7)
    assert found[7][0].furthest == 0.0
    found[7][0].now.off = 60.0
    matched(found, 7)
    matched(found, 7)
    assert found[7][0].begin == 170.0
    assert found[7][0].furthest == 64.0


def test_who_has_not_begun_is_known_and_not_followed(four):
    _, found = four
    clock, mesh = found[7]
    clock.ask(mesh, 2)
    clock.ask(mesh, 5)
    clock.hear([2, 5, 7])
    assert (clock.begin, clock.idle) == (None, {2, 5})
    clock.hear([5, 7])
    assert clock.idle == {5}
    assert clock.elapsed() == 0.0


def test_an_answer_that_is_none_is_not_heeded(four):
    _, found = four
    found[2][1].answer(lambda: b"soon")
    matched(found, 5)
    assert (found[5][0].begin, found[5][0].idle) == (None, set())


def test_the_quickest_answer_counts_until_it_is_the_tenth():
    quickest = Quickest()
    assert [quickest.add(way, said) for way, said in ((2.0, 10.9), (0.2, 10.0), (2.0, 9.1))] == [10.9, 10.0, 10.0]
    assert [quickest.add(1.0, 10.4) for _ in range(8)] == [10.0] * 7 + [10.4]


def test_in_trials_a_clock_is_off_of_those_who_are_named(monkeypatch):
    monkeypatch.setenv("SHOAL_CLOCK_OFF", "7:1000@0")
    assert 990.0 < clock_of([6, 7])() - clock_of([5])() < 1010.0


def test_watchers_are_no_buoys():
    assert numbers({"7", "sea", "12", "watch-1", ""}) == [7, 12]
