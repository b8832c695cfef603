"""What watchers of a fleet are told is what its log keeps, and telling it changes nothing."""

import numpy as np
import pytest

from frames import decode
from shoal.record.frames import trajectory_sha256
from shoal.run.fleet.run_fleet import Terms, run_fleet
from shoal.scenario.load import read_table, scenario_from
from shoal.viewer.feed import Feed
from shoal.viewer.live import LiveRun

STEPS = 20
SCENARIO = scenario_from({**read_table("oceans2020"), "steps": STEPS}, where="test")
TERMS = Terms(mesh="memory", kill=("7@10",))


@pytest.fixture(scope="module")
def watched():
    """A fleet whose every step was told: its record, and what was told."""
    told = []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shoal.viewer.feed.EVERY", 0.0)
        feed = Feed(SCENARIO, None, [told.append])
        feed.say("50 buoys start")
        record = run_fleet(SCENARIO, TERMS, onlooker=feed.see)
    return record, told


def test_every_frame_is_the_one_that_watching_the_simulator_shows(watched):
    table = {**read_table("oceans2020"), "losses": [{"step": 10, "agents": [7]}]}
    live = LiveRun(table)
    for step, bulletin in enumerate(watched[1][2:]):  # the first has no frame, the second is step 0 while buoys start
        assert bulletin.frame == live.frame(), step
        live.advance(1)
    assert step == STEPS - 1


def test_the_lost_are_not_there_from_their_step_on(watched):
    alive = {each.step: decode(each.frame).alive for each in watched[1] if each.frame}
    assert (alive[9][7], alive[10][7], sum(alive[19])) == (True, False, 49)


def test_the_sentence_stands_until_the_first_step_is_done(watched):
    assert [each.busy for each in watched[1][:4]] == ["50 buoys start"] * 3 + [None]
    assert not watched[1][0].frame


def test_a_fleet_that_is_watched_does_the_same(watched):
    alone = run_fleet(SCENARIO, TERMS)
    sums = [trajectory_sha256(each.trajectories[0], STEPS) for each in (alone, watched[0])]
    assert sums[0] == sums[1] is not None
    assert all(np.array_equal(one, other) for one, other in zip(alone.tallies[0], watched[0].tallies[0], strict=True))


def test_no_more_is_told_than_anybody_can_see(monkeypatch):
    clock, told = [100.0], []
    monkeypatch.setattr("shoal.viewer.feed.time.monotonic", lambda: clock[0])
    feed = Feed(SCENARIO, 1.0, [told.append])

    def see(*seen):
        feed.see(*seen)
        clock[0] += 0.013

    run_fleet(SCENARIO, TERMS, onlooker=see)
    assert [each.step for each in told] == [0, 3, 7, 11, 15, 19]
