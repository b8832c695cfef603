"""What `--body` may say."""

import re
import socket
import sys
import threading
import time
import types
from pathlib import Path

import pytest

from shoal.buoy.body import open_body
from shoal.buoy.connection import Stream, connect
from shoal.buoy.errors import BodyError
from shoal.buoy.mavlink import MODES
from shoal.core.errors import MissingExtraError, ScenarioError
from shoal.scenario.load import load, read_table, to_toml

ROOT = Path(__file__).resolve().parents[2]
AT_SEA = {"area": {"width": 400.0, "height": 200.0, "origin": (5.3, 60.4)}}


class TestNames:
    @pytest.mark.parametrize(
        ("text", "said"),
        [
            ("", "'' is no kind of body"),
            ("sea", "'sea' is no kind of body"),
            ("mavlnk:udp:127.0.0.1:1", "did you mean 'mavlink'? there are: mavlink, simulated"),
            ("mavlink", "'' is no address of an autopilot"),
            ("mavlink:udp:127.0.0.1", "does not say host and port"),
            ("mavlink:udp:127.0.0.1:port", "does not say host and port"),
            ("mavlink:tcp:127.0.0.1:70000", "does not say host and port"),
            ("mavlink:udp:no such host:14550", "cannot be connected to"),
            ("mavlink:log.bin", "'log.bin' is no address"),
            ("mavlink:/dev/null,fast", "'fast' is no baud rate"),
            ("mavlink:udp:127.0.0.1:0#300", "'300' is no number of a system"),
            ("mavlink:udp:127.0.0.1:0#", "'' is no number of a system"),
        ],
    )
    def test_what_is_none_is_one_error(self, text, said):
        pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")
        with pytest.raises(BodyError, match=r"\n  fix: ") as error:
            open_body(text, {**read_table("oceans2020"), **AT_SEA}, 0)
        assert said in str(error.value)

    def test_others_may_be_named_and_are_listed(self):
        assert open_body("sea:3", "oceans2020", 0, others={"sea": lambda rest: rest}) == "3"
        with pytest.raises(BodyError, match="there are: mavlink, simulated, sea"):
            open_body("see", "oceans2020", 0, others={"sea": str})

    def test_a_scenario_that_is_nowhere_on_earth_is_refused(self):
        with pytest.raises(ScenarioError, match=r"area.origin: is not given"):
            open_body("mavlink:udp:127.0.0.1:0", "oceans2020", 0)

    def test_a_key_of_another_length_is_refused(self):
        with pytest.raises(BodyError, match="has 6 bytes"):
            open_body("mavlink:udp:127.0.0.1:0", {**read_table("oceans2020"), **AT_SEA}, 0, key=b"sesame")

    def test_a_port_that_somebody_has_is_one_error(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
            taken.bind(("127.0.0.1", 0))
            with pytest.raises(BodyError, match="cannot be connected to"):
                connect(f"udp:127.0.0.1:{taken.getsockname()[1]}")

    def test_nobody_at_a_tcp_port_is_one_error(self):
        with socket.socket() as quiet:
            quiet.bind(("127.0.0.1", 0))  # and does not listen
            with pytest.raises(BodyError, match="cannot be connected to"):
                connect(f"tcp:127.0.0.1:{quiet.getsockname()[1]}")

    @pytest.mark.parametrize(
        ("library", "text"),
        [("pymavlink.dialects.v20", "mavlink:udp:127.0.0.1:0"), ("serial", "mavlink:/dev/ttyACM0,115200")],
    )
    def test_without_a_library_it_says_which(self, monkeypatch, library, text):
        pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")
        monkeypatch.setitem(sys.modules, library, None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[mavlink\]'"):
            open_body(text, {**read_table("oceans2020"), **AT_SEA}, 0)


class TestWhole:
    """From the words of the command line to a boat that goes, in real time."""

    @pytest.fixture
    def sailing(self):
        """A rover that sails twenty times as fast as time, and the port that it speaks to."""
        pytest.importorskip("pymavlink", reason="pymavlink is not installed: pip install '.[mavlink]'")
        from rovers import Rover

        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            place = free.getsockname()
        rover, done = Rover(place, 5.3, 60.4, system=3), threading.Event()

        def sail():
            while not done.wait(0.005):
                rover.advance(0.1)

        sailor = threading.Thread(target=sail)
        sailor.start()
        yield rover, place[1]
        done.set()
        sailor.join()
        rover.socket.close()

    def test_a_body_is_begun_beats_by_itself_and_holds_at_the_end(self, sailing):
        rover, port = sailing
        scenario = {**read_table("oceans2020"), **AT_SEA}
        body = open_body(f"mavlink:udp:127.0.0.1:{port}#3", scenario, 0, arm=True)
        body.go(1.0, 0.0)
        sent = len(rover.setpoints)
        while len(rover.setpoints) < sent + 3:  # the thread of the body says them
            time.sleep(0.01)
        assert body.read().x > 0.0
        body.close()
        assert MODES[rover.mode] == "HOLD"
        assert not [each for each in threading.enumerate() if each.name == f"shoal udp:127.0.0.1:{port}"]

    def test_the_code_of_the_page_steers_it(self, sailing, tmp_path, monkeypatch):
        rover, port = sailing
        monkeypatch.chdir(tmp_path)
        scenario = load({**read_table("oceans2020"), **AT_SEA}, steps=8, strategy="random-walk")
        (tmp_path / "mine.toml").write_text(to_toml(scenario), encoding="utf-8")
        page = (ROOT / "docs/how-to/ardupilot.md").read_text(encoding="utf-8")
        code = re.findall(r"```python\n(.*?)```", page, re.DOTALL)[0]
        changed = code.replace("14550", str(port))
        assert changed.count(str(port)) == 1
        exec(changed, {})
        assert MODES[rover.mode] == "HOLD"
        assert any(message.vx or message.vy for _, message in rover.setpoints)


class TestSerial:
    class Port:
        """What pyserial's Serial does, with its errors."""

        def __init__(self, device, rate, **options):
            self.made, self.written, self.unplugged = (device, rate, options), [], False

        def read(self, size):
            if self.unplugged:
                raise OSError("device reports readiness to read but returned no data")
            return b"abc"

        def write(self, data):
            if self.unplugged:
                raise OSError("write failed")
            self.written.append(data)

        def close(self):
            self.unplugged = True

    def test_is_read_and_written_without_waiting_and_may_be_unplugged(self, monkeypatch):
        monkeypatch.setitem(sys.modules, "serial", types.SimpleNamespace(Serial=self.Port))
        line = connect("/dev/ttyACM0,115200")
        assert line._port.made == ("/dev/ttyACM0", 115200, {"timeout": 0, "write_timeout": 0})
        assert line.receive() == [(b"abc", None)]
        line.send(b"xyz", None)
        assert line._port.written == [b"xyz"]
        line.close()
        assert line.receive() == []
        line.send(b"xyz", None)

    def test_without_a_rate_it_has_that_of_telemetry_radios(self, monkeypatch):
        monkeypatch.setitem(sys.modules, "serial", types.SimpleNamespace(Serial=self.Port))
        assert connect("COM3")._port.made[:2] == ("COM3", 57600)


class TestStream:
    def test_a_broken_line_is_quiet_and_is_dialed_again(self, monkeypatch):
        monkeypatch.setattr("shoal.buoy.connection.DIAL_AGAIN", 0.0)
        with socket.create_server(("127.0.0.1", 0)) as server:
            line = Stream(server.getsockname())
            first, _ = server.accept()
            first.sendall(b"one")
            assert arrived(line) == b"one"
            first.close()
            while line._socket is not None:  # until the end is seen
                line.receive()
            line.send(b"lost", None)
            again = threading.Thread(target=line.receive)
            again.start()
            second, _ = server.accept()
            again.join()
            with second:
                line.send(b"two", None)
                assert second.recv(10) == b"two"
            line.close()


def arrived(line):
    while not (found := line.receive()):
        pass
    return b"".join(data for data, _ in found)
