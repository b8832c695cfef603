"""The thread that runs a session."""

import threading
import time

import pytest

from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation
from shoal.scenario.load import read_table, scenario_from
from shoal.viewer.requests import parse_request
from shoal.viewer.session import Session
from shoal.viewer.worker import PATIENCE, Watcher, Worker, next_due

SOON = 60.0  # [s] a busy machine may take that long


def session(**options):
    return Session([read_table("oceans2020")], **options)


def eventually(condition):
    begun = time.monotonic()
    while not condition():
        assert time.monotonic() - begun < SOON, "it never happened"
        time.sleep(0.005)


class Ears:
    """A watcher that remembers."""

    def __init__(self):
        self.changes, self.errors = 0, []
        self.watcher = Watcher(self._changed, self.errors.append)

    def _changed(self):
        self.changes += 1


class TestRunning:
    def test_it_runs_to_the_limit_and_says_so_once(self):
        done = []
        with Worker(session(limit=500, speed=1000), on_done=lambda: done.append(threading.get_ident())) as worker:
            eventually(lambda: done)
            assert worker.view.kept.step == 500
            worker.ask(parse_request('{"do": "play"}'), Ears().watcher)
            time.sleep(0.05)
        assert len(done) == 1
        assert done[0] != threading.get_ident()

    def test_a_run_with_watchers_who_never_look_is_the_run_without(self):
        one = session(limit=1000, speed=1000)
        done = threading.Event()
        with Worker(one, on_done=done.set) as worker:
            for _ in range(3):
                worker.watch(Ears().watcher)
            assert done.wait(SOON)
        alone = Simulation(scenario_from(read_table("oceans2020")))
        alone.advance(1000)
        watched = one.runs[0].simulation.state()
        assert all(watched[name].tobytes() == part.tobytes() for name, part in alone.state().items())

    def test_real_time_is_not_outrun(self):
        one = session(speed=1)
        begun = time.monotonic()
        with Worker(one):
            eventually(lambda: one.number >= 5)
        assert time.monotonic() - begun > 4 * 0.1

    def test_pause_stops_the_step(self):
        with Worker(session(speed=1000)) as worker:
            worker.ask(parse_request('{"do": "pause"}'), Ears().watcher)
            eventually(lambda: '"playing":false' in worker.view.status)
            step = worker.view.kept.step
            time.sleep(0.2)
            assert worker.view.kept.step == step

    def test_no_thread_is_left(self):
        before = threading.active_count()
        with Worker(session()) as worker:
            assert threading.active_count() == before + 1
        assert threading.active_count() == before
        worker.wait()

    def test_a_bug_reaches_whoever_waits(self, monkeypatch):
        one = session()
        monkeypatch.setattr(one, "play_on", lambda: 1 / 0)
        with Worker(one) as worker, pytest.raises(ZeroDivisionError):
            worker.wait()


class TestAsking:
    def test_a_refusal_is_told_to_who_asked_and_nobody_else(self):
        one, other = Ears(), Ears()
        with Worker(session()) as worker:
            worker.watch(one.watcher)
            worker.watch(other.watcher)
            worker.ask(parse_request('{"do": "kill", "agent": 99}'), one.watcher)
            eventually(lambda: one.errors)
        assert "from 0 to 49" in one.errors[0]
        assert other.errors == []

    def test_everybody_is_told_of_changes(self):
        one, other = Ears(), Ears()
        with Worker(session()) as worker:
            worker.watch(one.watcher)
            worker.watch(other.watcher)
            worker.ask(parse_request('{"do": "pause"}'), one.watcher)
            eventually(lambda: one.changes and other.changes)

    def test_who_left_hears_nothing(self):
        ears = Ears()
        with Worker(session(speed=1000, limit=2000)) as worker:
            worker.watch(ears.watcher)
            worker.leave(ears.watcher)
            heard = ears.changes
            eventually(lambda: worker.view.kept.step == 2000)
        assert ears.changes - heard <= 1  # one may have been under way

    def test_a_flood_is_refused(self):
        ears = Ears()
        worker = Worker(session())  # not started: nobody takes anything
        for _ in range(300):
            worker.ask(parse_request('{"do": "play"}'), ears.watcher)
        assert len(ears.errors) == 300 - 256

    def test_a_run_that_fails_pauses_and_says_why(self, monkeypatch):
        one, ears = session(), Ears()

        def fail():
            raise ScenarioError("strategy", "is wrong", "mend it")

        monkeypatch.setattr(one, "play_on", fail)
        worker = Worker(one)
        worker.watch(ears.watcher)
        with worker:
            eventually(lambda: ears.errors)
        assert ears.errors == ["strategy: is wrong\n  fix: mend it"]
        assert not one.playing


class TestNextDue:
    def test_frames_follow_each_other_at_the_speed(self):
        assert next_due(10.0, now=10.01, lasts=0.1) == pytest.approx(10.1)

    def test_a_short_delay_is_made_up_for(self):
        assert next_due(10.0, now=10.2, lasts=0.1) < 10.2

    def test_a_long_one_is_not(self):
        """An engine that cannot keep the speed is late, and does not hurry when it can again."""
        assert next_due(10.0, now=99.0, lasts=0.1) == pytest.approx(99.0 - PATIENCE + 0.1)
