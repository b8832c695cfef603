"""What chart plotters hear of a run: every buoy, every second, where it was."""

from datetime import UTC, datetime

import numpy as np
import pytest

from bulletins import FRAMES, bulletin
from plotters import Plotter, decoded
from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.core.geodesy import Frame
from shoal.record.voyage.anchor import anchor_of
from shoal.record.voyage.voyages import crafts_of
from shoal.run.simulation import Simulation
from shoal.viewer.broadcast import Broadcast
from shoal.viewer.chart import check_pace, follow, greeting, live_moments, play, recorded_moments
from voyages import ORIGIN, START, made_record

pytest.importorskip("pyais")
pyproj = pytest.importorskip("pyproj")

RESOLUTION = 0.19  # [m] of AIS: 1/10,000 minute of latitude
GEOD = pyproj.Geod(ellps="WGS84")


def anchor(chosen, **given):
    return anchor_of(chosen, **{"start": START, **given})


def distances(messages, x, y, origin=ORIGIN):
    """How far reports lie from local places [m], by a geodesic from the origin."""
    lon, lat, _ = GEOD.fwd(
        np.full(x.size, origin[0]), np.full(x.size, origin[1]), np.degrees(np.arctan2(x, y)), np.hypot(x, y)
    )
    return GEOD.inv(lon, lat, *np.array([(each.lon, each.lat) for each in messages]).T)[2]


class TestRecorded:
    def test_every_buoy_and_second_is_within_the_resolution_of_ais(self):
        record = made_record(range(0, 300, 5), counts=(15, 35), reach=2_000.0, changes={"network.neighbors": 20})
        frames = record.trajectories[0]
        with Broadcast("127.0.0.1", 0, greeting(crafts_of(record.facts, 1))) as broadcast:
            plotter = Plotter(broadcast.port)
            broadcast.wait_for_somebody()
            assert play(recorded_moments(record, 0, 1.0, anchor(record.scenario)), broadcast, 200.0) == 30
            broadcast.finish()
            assert broadcast.missed == 0
        messages = list(plotter.messages())
        names, reports = messages[:51], messages[51:]
        assert len({each.mmsi for each in names}) == len({each.shipname for each in names}) == 51
        assert [each.mmsi for each in reports] == [each.mmsi for each in names] * 30
        assert [each.second for each in reports] == np.repeat(np.arange(30), 51).tolist()
        x, y = (np.hstack(pair)[::2].ravel() for pair in ((frames.x, frames.target_x), (frames.y, frames.target_y)))
        assert distances(reports, x, y).max() < RESOLUTION

    def test_who_is_away_reports_nothing(self):
        record = made_record()
        record.trajectories[0].alive[1, 2] = False
        record.trajectories[0].target_present[2] = False
        numbers = [
            [each.mmsi % 1000 for each in decoded(message.split())]
            for _, message in recorded_moments(record, 0, 1.0, anchor(record.scenario))
        ]
        assert numbers == [[0, 1, 2, 3, 4, 0], [0, 1, 3, 4, 0], [0, 1, 2, 3, 4]]

    @pytest.mark.parametrize(
        ("every", "seconds"), [(0.1, [0.0, 0.1, 0.2, 1.0, 3.0]), (0.2, [0.0, 0.2, 1.0, 3.0]), (2.0, [0.0, 3.0])]
    )
    def test_moments_are_as_far_apart_as_asked_for_or_as_was_kept(self, every, seconds):
        record = made_record([0, 1, 2, 10, 30])
        moments = recorded_moments(record, 0, every, anchor(record.scenario))
        assert [round(now, 9) for now, _ in moments] == seconds


class TestLive:
    def test_a_simulation_is_heard_as_it_goes(self):
        chosen = scenario(changes={"steps": 25, "area.origin": list(ORIGIN)})
        frames = Simulation(chosen).advance(25, every=10)
        moments = list(live_moments(Simulation(chosen), 1.0, anchor(chosen)))
        assert [now for now, _ in moments] == [0.0, 1.0, 2.0]
        for at, (_, message) in enumerate(moments):
            reports = list(decoded(message.split(b"\r\n")[:-1]))
            x = np.append(frames.x[at], frames.target_x[at])
            y = np.append(frames.y[at], frames.target_y[at])
            assert distances(reports, x, y).max() < RESOLUTION
        way = np.hypot(np.diff(frames.target_x[1:, 0]), np.diff(frames.target_y[1:, 0]))  # of the target, in a second
        assert reports[-1].speed == pytest.approx(way * 3600 / 1852, abs=0.06)

    def test_goes_on_from_where_the_simulation_is_and_keeps_its_clock(self):
        chosen = scenario(changes={"steps": 25, "area.origin": list(ORIGIN)})
        simulation = Simulation(chosen)
        simulation.advance(20)
        late = datetime(2015, 11, 16, 6, 0, 59, tzinfo=UTC)
        ((now, message),) = live_moments(simulation, 0.55, anchor(chosen, start=late))
        assert now == 2.0
        assert {each.second for each in decoded(message.split())} == {1}


class TestAFleet:
    def test_is_heard_where_it_is_as_often_as_asked_for(self):
        said = [bulletin(0), None, bulletin(0), bulletin(1), bulletin(2), bulletin(frame=b"", busy="over")]
        with Broadcast("127.0.0.1", 0, b"") as broadcast:
            plotter = Plotter(broadcast.port)
            broadcast.wait_for_somebody()
            assert follow(iter(said), broadcast, 1.0, Frame(ORIGIN)) == 3  # step 0 was said twice
            broadcast.finish()
            assert broadcast.missed == 0
        reports = list(plotter.messages())
        assert len(reports) == 3 * 6
        x, y = (np.hstack(pair).ravel() for pair in ((FRAMES.x, FRAMES.target_x), (FRAMES.y, FRAMES.target_y)))
        assert distances(reports, x, y).max() < RESOLUTION
        way = np.hypot(np.diff(FRAMES.x[1:, 0]), np.diff(FRAMES.y[1:, 0]))  # of the first buoy, in a second
        assert reports[-6].speed == pytest.approx(way * 3600 / 1852, abs=0.06)

    def test_moments_that_are_too_close_are_left_out(self):
        with Broadcast("127.0.0.1", 0, b"") as broadcast:
            assert follow(iter([bulletin(at) for at in range(3)]), broadcast, 2.0, Frame(ORIGIN)) == 2


class TestPace:
    def test_a_moment_is_sent_when_it_is_due(self, monkeypatch):
        clock, sent = [100.0], []

        class Plotters:
            def wait(self, until):
                clock[0] = max(clock[0], until)

            def send(self, message):
                sent.append((clock[0], message))

        monkeypatch.setattr("shoal.viewer.chart.time.monotonic", lambda: clock[0])
        assert play(iter([(7.0, b"a"), (8.0, b"b"), (12.0, b"c")]), Plotters(), 2.0) == 3
        assert sent == [(100.0, b"a"), (100.5, b"b"), (102.5, b"c")]

    @pytest.mark.parametrize(("speed", "every"), [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0), (1.0, float("nan"))])
    def test_one_that_leads_nowhere_is_refused(self, speed, every):
        with pytest.raises(ScenarioError, match="give a number above 0"):
            check_pace(speed, every)
