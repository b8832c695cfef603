"""What a sensor process may say, and for how long it counts."""

import json
import math
import socket

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shoal.buoy.detector import KEPT, RecordedTargets, SensorPort, no_detector, open_detector, parsed
from shoal.buoy.errors import BodyError
from shoal.scenario.load import load
from shoal.scenario.on_track import places_on_tracks


class TestMessage:
    @pytest.mark.parametrize(
        ("text", "said"),
        [
            ('{"on_target": true}', (True, 0.0)),
            ('{"on_target": false, "age": 1.5}\n', (False, 1.5)),
            ('{"on_target": true, "age": 1, "confidence": 0.8}', (True, 1.0)),
        ],
    )
    def test_says_whether_and_since_when(self, text, said):
        assert parsed(text.encode()) == said

    @pytest.mark.parametrize(
        "text",
        [
            "",
            "true",
            "[]",
            "{}",
            '{"on_target": 1}',
            '{"on_target": "true"}',
            '{"on_target": true, "age": -1}',
            '{"on_target": true, "age": true}',
            '{"on_target": true, "age": NaN}',
            '{"on_target": true, "age": Infinity}',
            '{"on_target": true, "age": 1e999}',
            '{"on_target": true, "age": null}',
            '{"on_target": true, "pad": "' + 1000 * "x" + '"}',
            "[" * 900,
        ],
    )
    def test_anything_else_says_nothing(self, text):
        assert parsed(text.encode()) is None

    @given(st.binary(max_size=60))
    def test_no_bytes_raise(self, data):
        assert parsed(data) is None or json.loads(data)["on_target"] in (True, False)


class TestPort:
    @pytest.fixture
    def made(self):
        time = [0.0]
        port = SensorPort("udp:127.0.0.1:0", clock=lambda: time[0])
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sensor:
            yield port, time, lambda text: sensor.sendto(text.encode(), port.place)
        port.close()

    def test_sees_nothing_before_the_first_message(self, made):
        assert made[0](0.0, 0.0) is False

    def test_the_newest_counts_until_it_is_old(self, made):
        port, time, say = made
        say('{"on_target": false}')
        say('{"on_target": true}')
        assert port(0.0, 0.0)
        time[0] += KEPT
        assert port(0.0, 0.0)
        time[0] += 0.001
        assert not port(0.0, 0.0)

    def test_what_is_older_than_the_newest_changes_nothing(self, made):
        port, _, say = made
        say('{"on_target": true, "age": 0.2}')
        say('{"on_target": false, "age": 0.9}')
        assert port(0.0, 0.0)

    def test_its_age_counts(self, made):
        port, _, say = made
        say(json.dumps({"on_target": True, "age": KEPT + 0.1}))
        assert not port(0.0, 0.0)

    def test_what_is_no_message_is_counted(self, made):
        port, _, say = made
        say('{"on_target": true}')
        say("rubbish")
        assert port(0.0, 0.0)
        assert (port.heard, port.refused) == (1, 1)


class TestRecorded:
    @pytest.fixture
    def scenario(self, tmp_path):
        track = tmp_path / "track.csv"
        rows = [f"2026-06-01T06:{minute:02}:00Z,{50.8 + 0.001 * minute:.6f},-1.3" for minute in range(10)]
        track.write_text("time,lat,lon\n" + "\n".join(rows) + "\n", encoding="utf-8")
        return load("oceans2020", target_track=str(track), **{"fleets.0.sensor_radius": 7.0})

    def test_is_seen_where_it_is_at_the_time(self, scenario):
        time = [0.0]
        detector = RecordedTargets(scenario, 0, lambda: time[0])
        ((x, y, radius),) = places_on_tracks(scenario)(120.0)
        assert not detector(x, y)
        time[0] = 120.0
        assert detector(x, y)
        assert radius > 0.0
        reach = radius + 7.0
        assert detector(x + 0.999 * reach, y)
        assert not detector(x + 1.001 * reach, y)

    def test_after_its_end_it_is_not_there(self, scenario):
        assert places_on_tracks(scenario)(1e6) == []
        assert not RecordedTargets(scenario, 0, lambda: 1e6)(0.0, 0.0)

    def test_a_scenario_without_one_is_refused(self):
        with pytest.raises(BodyError, match="needs a recorded target"):
            RecordedTargets("oceans2020", 0, lambda: 0.0)


class TestNames:
    def open(self, text):
        return open_detector(text, "oceans2020", 0, lambda: 0.0)

    def test_none_sees_nothing(self):
        assert self.open("none") is no_detector
        assert not no_detector(math.nan, 0.0)

    def test_a_port_is_listened_at(self):
        port = self.open("udp:127.0.0.1:0")
        assert isinstance(port, SensorPort)
        port.close()

    @pytest.mark.parametrize(
        "text", ["", "sonar", "udp:", "udp:127.0.0.1", "udp:127.0.0.1:99999", "track:", "udp:x y:1"]
    )
    def test_anything_else_is_one_error(self, text):
        with pytest.raises(BodyError, match=r"\n  fix: "):
            self.open(text)
