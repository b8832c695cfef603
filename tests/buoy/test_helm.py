"""A buoy at the helm: whatever its body, the swarm or its clock do, it goes on, and nothing moves that should not."""

import csv

import pytest

pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[mavlink]'")

from scenarios import small
from shoal.buoy.aboard import Aboard
from shoal.buoy.clock import CommonClock
from shoal.buoy.errors import UnreadyError
from shoal.buoy.helm import QUIET, Helm
from shoal.buoy.logbook import Logbook
from shoal.core.errors import RecordError
from shoal.core.geodesy import Frame
from shoal.core.messages import Reading, Report
from shoal.scenario.load import load

PERIOD = 0.5


class Air:
    """A mesh on which one other buoy may speak, and whose time passes while somebody listens."""

    def __init__(self, now):
        self.now, self.said, self.speaks, self.coming = now, [], True, []

    def publish(self, data):
        self.said.append(Report.from_bytes(data))
        self.coming.append(data)
        if self.speaks:
            step = round(self.said[-1].time / PERIOD)
            self.coming.append(Report(1, 1.0, 0.0, 0.0, 0.0, True, (), step * PERIOD).to_bytes())

    def take(self, timeout):
        if not self.coming:
            self.now[0] += timeout
        self.now[0] += 0.01
        found, self.coming = self.coming, []
        return found

    def orders(self, timeout):
        return []

    def nodes(self):
        return {"0", "1"}

    def ask(self, node, answered):
        raise AssertionError("the lowest asks nobody")


class Boat:
    """A body that notes what it is told."""

    def __init__(self):
        self.told, self.lost, self.held, self.x = [], False, False, -5.0

    def read(self):
        if self.lost:
            raise UnreadyError("boat", "does not say where it is", "wait")
        self.x += 0.1
        return Reading(self.x, 0.0, 0.2, 0.0, False)

    def go(self, vx, vy):
        if self.held:
            raise UnreadyError("boat", "is in mode MANUAL", "wait")
        self.told.append((vx, vy))

    def stop(self):
        self.told.append("stop")


class Scene:
    """A helm, its air and boat, and things that happen when the time is there."""

    def __init__(self, folder):
        self.now, self.boat, self.events = [1000.0], Boat(), {}
        self.air, self.clock = Air(self.now), CommonClock(0, PERIOD, lambda: self.now[0])
        self.clock.start(1001.0)
        swarm = small(2, 1, {"time_step": PERIOD})
        self.aboard = Aboard(swarm, [0], max_age=1)
        self.log = Logbook(folder, 0, Frame((5.3, 60.4)), lambda: 1.79e9 + self.now[0])
        self.helm = Helm(swarm, self.aboard, self.air, self.boat, self.clock, self.log, wait=self.wait)

    def wait(self, seconds):
        assert seconds > 0.0
        self.now[0] += seconds
        for step in [step for step in self.events if self.clock.step() >= step]:
            self.events.pop(step)()

    def run(self, steps):
        self.helm.run(steps)
        self.log.close()

    @property
    def steps(self):
        """Of its reports."""
        return [round(report.time / PERIOD) for report in self.air.said]

    def rows(self):
        with self.log.file.open(encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def scene(tmp_path):
    return Scene(tmp_path)


def test_every_step_it_speaks_decides_and_goes(scene):
    scene.run(10)
    assert scene.steps == list(range(10))
    assert len(scene.boat.told) == 11
    assert scene.boat.told[-1] == "stop"
    assert all(vx > 0.0 for vx, _ in scene.boat.told[1:-1])  # to the other, which is on target
    assert scene.helm.counts == {"decided": 10}
    assert [(row["step"], row["heard"], row["note"]) for row in scene.rows()] == [(str(n), "1", "") for n in range(10)]


def test_what_it_goes_with_is_within_what_it_can_do(scene):
    scene.run(10)
    assert max(vx for vx, _ in scene.boat.told[:-1]) <= 1.0


def test_one_that_does_not_know_its_place_says_nothing_and_goes_on_later(scene):
    scene.events = {3: lambda: setattr(scene.boat, "lost", True), 6: lambda: setattr(scene.boat, "lost", False)}
    scene.run(10)
    assert scene.steps == [0, 1, 2, 6, 7, 8, 9]
    assert scene.helm.counts == {"decided": 7, "unready": 3}
    assert [row["note"] for row in scene.rows()][3:6] == ["does not say where it is"] * 3


def test_one_that_a_person_has_goes_on_reporting(scene):
    scene.events = {3: lambda: setattr(scene.boat, "held", True), 6: lambda: setattr(scene.boat, "held", False)}
    scene.run(10)
    assert scene.steps == list(range(10))
    assert scene.helm.counts == {"decided": 10, "disobeyed": 3}


def test_in_silence_it_stops_and_when_somebody_is_heard_it_goes_on(scene):
    scene.events = {5: lambda: setattr(scene.air, "speaks", False), 25: lambda: setattr(scene.air, "speaks", True)}
    scene.run(30)
    quiet = round((QUIET + 2 * PERIOD) / PERIOD)
    stops = [step for step, told in enumerate(scene.boat.told[:-1]) if told == "stop"]
    assert stops == list(range(stops[0], 25))
    assert 5 + quiet <= stops[0] <= 6 + quiet
    assert scene.steps == list(range(30))
    assert scene.helm.counts["silences"] == 1


def test_a_clock_that_jumps_ahead_skips_and_one_that_is_set_back_does_steps_anew(scene):
    scene.events = {5: lambda: scene.clock.start(scene.clock.begin - 10.0)}
    scene.helm.run(30)
    assert scene.steps == [*range(5), *range(25, 30)]
    assert scene.helm.counts["skipped"] == 20
    scene.air.said.clear()
    scene.events = {32: lambda: scene.clock.start(scene.clock.begin + 10.0)}
    scene.run(40)
    assert scene.steps == [30, 31, *range(12, 40)]


def test_who_comes_late_begins_where_the_others_are(scene):
    scene.now[0] += 20.3
    scene.run(45)
    assert scene.steps == list(range(38, 45))
    assert scene.helm.counts["skipped"] == 0


def test_a_log_is_a_track(scene):
    scene.events = {3: lambda: setattr(scene.boat, "lost", True), 6: lambda: setattr(scene.boat, "lost", False)}
    scene.run(40)
    found = load("oceans2020", target_track=str(scene.log.file))
    assert found.targets[0].kind == "track"
    assert len(scene.rows()) == 40


def test_a_log_that_cannot_be_is_one_sentence(tmp_path):
    (tmp_path / "file").write_text("mine", encoding="utf-8")
    with pytest.raises(RecordError, match="cannot be written"):
        Logbook(tmp_path / "file", 0, Frame((5.3, 60.4)))


def test_without_a_folder_nothing_is_kept():
    log = Logbook(None, 0, Frame((5.3, 60.4)))
    log.keep(1, Reading(0.0, 0.0, 0.0, 0.0, False), (0.0, 0.0), 0)
    log.lack(2, "nothing")
    log.close()
    assert log.file is None
