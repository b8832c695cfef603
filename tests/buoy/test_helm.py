"""A buoy at the helm: whatever its body, the swarm or its clock do, it goes on, and nothing moves that should not."""

import csv
import time

import pytest

pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")

from scenarios import small
from shoal.buoy.aboard import Aboard
from shoal.buoy.clock import CommonClock
from shoal.buoy.errors import UnreadyError
from shoal.buoy.helm import QUIET, Helm
from shoal.buoy.logbook import Logbook
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.twins import GRACE, NEW, Twins
from shoal.core.errors import FleetError, RecordError
from shoal.core.geodesy import Frame
from shoal.core.messages import Reading, Report
from shoal.core.orders import Answer, Order, opened
from shoal.scenario.load import load

PERIOD = 0.5
KEY = bytes(32)


class Air:
    """A mesh on which one other buoy may speak, and whose time passes while somebody listens."""

    def __init__(self, now):
        self.now, self.said, self.speaks, self.coming = now, [], True, []
        self.alike, self.ordered, self.answered = (0, 0), [], []

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
        found, self.ordered = self.ordered, []
        return found

    def order(self, data):
        self.answered.append(data)

    def namesakes(self):
        return self.alike

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
        swarm = self.swarm = small(2, 1, {"time_step": PERIOD})
        self.aboard = Aboard(swarm, [0], max_age=1)
        self.log = Logbook(folder, 0, Frame((5.3, 60.4)), lambda: 1.79e9 + self.now[0])
        self.told = []
        twins = Twins(self.air, 0, lambda: self.now[0], self.told.append)
        self.helm = Helm(self.aboard, self.air, self.boat, self.clock, self.log, twins, wait=self.wait)

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
    scene = Scene(tmp_path)
    yield scene
    scene.log.close()


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


def test_an_order_is_obeyed_also_by_one_that_does_not_know_its_place(scene):
    scene.aboard.orderbook = Orderbook(scene.swarm, "fleet", KEY, time.time() - 10.0)
    hold = Order("fleet", time.time_ns(), time.time() + 60.0, "hold").to_bytes(KEY)
    scene.boat.lost = True
    scene.events = {2: lambda: scene.air.ordered.append(hold), 5: lambda: setattr(scene.boat, "lost", False)}
    scene.run(10)
    (answer,) = [said for said, _ in (opened(data, KEY) for data in scene.air.answered) if isinstance(said, Answer)]
    assert (answer.obeyed, answer.step) == ((0,), 3)
    assert scene.boat.told == [(0.0, 0.0)] * 5 + ["stop"]
    assert "ordered from step 3 on: hold" in scene.rows()[2]["note"]


def test_one_that_warmed_up_sets_out_where_it_is_first_and_is_recalled_to_there(scene):
    scene.aboard.warm()
    scene.aboard.orderbook = Orderbook(scene.swarm, "fleet", KEY, time.time() - 10.0)
    recall = Order("fleet", time.time_ns(), time.time() + 60.0, "recall").to_bytes(KEY)
    scene.events = {5: lambda: scene.air.ordered.append(recall)}
    scene.run(10)  # from x = -4.9 on, 0.1 m a step
    assert all(told[0] < 0.0 for told in scene.boat.told[6:-1])


class TestTwins:
    """Another buoy of the same number."""

    def test_one_that_comes_when_this_is_under_way_is_told_of_and_stops_nothing(self, scene):
        late = round((NEW + 2.0) / PERIOD)
        scene.events = {
            late: lambda: setattr(scene.air, "alike", (1, 0)),
            late + 20: lambda: setattr(scene.air, "alike", (0, 0)),
        }
        scene.run(late + 30)
        assert scene.helm.counts == {"decided": late + 30, "twinned": 20}
        assert scene.told == [
            "buoy 0: there is another buoy 0 on the mesh; end one of them",
            "buoy 0: the other buoy 0 is gone",
        ]
        assert [int(row["step"]) for row in scene.rows() if row["note"]] == list(range(late, late + 20))

    def test_the_second_of_two_ends_when_it_finds_out_soon_and_the_first_stays(self, scene):
        scene.air.alike = (1, 0)
        with pytest.raises(FleetError, match="a buoy 0 is on the mesh already"):
            scene.run(100)
        assert GRACE <= scene.helm.counts["decided"] * PERIOD + 1.0 <= GRACE + 3.0

    def test_the_first_of_two_goes_on(self, scene):
        scene.air.alike = (0, 1)
        scene.run(100)
        assert scene.helm.counts == {"decided": 100, "twinned": 100}

    def test_one_that_is_only_heard_is_told_of_once(self, scene):
        def speak():
            step = scene.clock.step()
            scene.air.coming.append(Report(0, 9.0, 9.0, 0.0, 0.0, True, (), step * PERIOD).to_bytes())

        scene.events = dict.fromkeys((5, 6), speak)
        scene.run(10)
        assert scene.told == ["buoy 0: somebody else reports as buoy 0; end one of the two"]
        assert scene.aboard.inbox.foreign == 2
        assert scene.helm.counts == {"decided": 10, "twinned": 2}


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


def test_a_log_without_a_row_leaves_nothing_behind(tmp_path):
    reading = Reading(0.0, 0.0, 0.0, 0.0, False)
    Logbook(tmp_path / "new", 0, Frame((5.3, 60.4))).close()
    assert not (tmp_path / "new").exists()
    other, log = (Logbook(tmp_path / "log", id, Frame((5.3, 60.4))) for id in (1, 2))
    log.keep(0, reading, (0.0, 0.0), 0)
    log.close()
    other.close()
    assert list((tmp_path / "log").iterdir()) == [log.file]
