"""Fleets that are watched from elsewhere: shoal watch --fleet, shoal chart --fleet."""

import json
import re
import signal
import subprocess
import sys
import threading
import time

import pytest

pytest.importorskip("zenoh", reason="zenoh is not installed")

from bulletins import FRAMES, bulletin
from commands import shoal
from frames import decode
from plotters import Plotter, free_port
from shoal.buoy.beacon import Beacon

HOST = "127.0.0.1"
SOON = 60.0


@pytest.fixture
def beacon():
    beacon = Beacon(HOST, 0)
    beacon.tell(bulletin(1).to_bytes())
    yield beacon
    beacon.close()


def test_a_page_shows_the_fleet_and_says_when_it_is_gone(beacon):
    connect = pytest.importorskip("websockets.sync.client").connect
    command = [sys.executable, "-m", "shoal", "watch", "--fleet", f"{HOST}:{beacon.port}", "--no-browser"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        try:
            address = re.search(r"http://\S+/", process.stderr.readline()).group()
            with connect(address.replace("http", "ws") + "live") as page:
                told, frame = [], None
                while frame is None or told[-1].get("busy") != "the fleet is gone":
                    message = page.recv(timeout=SOON)
                    if isinstance(message, bytes):
                        frame = decode(message)
                        beacon.close()
                    else:
                        told.append(json.loads(message))
            assert (told[0]["fleet"], frame.step) == (True, FRAMES.step[1])
            assert "the fleet is gone" in process.stderr.readline()
            process.send_signal(signal.SIGINT)
            assert (process.wait(SOON), process.stderr.read()) == (0, "")
        finally:
            process.kill()


def test_a_plotter_hears_the_fleet_until_it_is_gone(capsys, beacon):
    pytest.importorskip("pyais")
    pytest.importorskip("pyproj")
    plotter = Plotter(port := free_port())

    def fleet():
        until = time.monotonic() + SOON
        while not plotter.heard and time.monotonic() < until:
            time.sleep(0.05)
        beacon.tell(bulletin(2).to_bytes())
        while plotter.heard.count(b"\n") < 12 and time.monotonic() < until:
            time.sleep(0.05)
        beacon.close()

    threading.Thread(target=fleet).start()
    code, out, err = shoal(capsys, "chart", "--fleet", f"{HOST}:{beacon.port}", "--tcp", port)
    assert (code, out) == (0, "")
    assert "for 1 plotter" in err
    names = [each for each in plotter.messages() if each.msg_type in (5, 24)]
    assert len({each.mmsi for each in names}) == 6


def test_a_fleet_says_where_it_can_be_watched(capsys):
    code, _, err = shoal(capsys, "fleet", "oceans2020", "--steps", 5, "--mesh", "memory", "--listen", f"{HOST}:0")
    assert code == 0
    assert re.search(r"shoal watch --fleet 127\.0\.0\.1:[1-9][0-9]*", err)


@pytest.mark.parametrize(
    ("tokens", "words"),
    [
        (["watch", "--fleet", "nowhere"], "--fleet: is 'nowhere'"),
        (["watch", "--fleet", "127.0.0.1:1"], "--fleet 127.0.0.1:1: nobody answers there"),
        (["watch", "oceans2020", "--fleet", "127.0.0.1:1"], "leave out what would change it"),
        (["watch", "--fleet", "127.0.0.1:1", "--speed", "2"], "leave out what would change it"),
        (["chart", "--fleet", "127.0.0.1:1"], "--fleet 127.0.0.1:1: nobody answers there"),
        (["chart", "--fleet", "127.0.0.1:1", "--loop"], "leave out SOURCE, --run, --loop and --speed"),
        (["chart"], "SOURCE: is missing"),
        (["fleet", "oceans2020", "--listen", "here"], "--listen: is 'here'"),
        (["fleet", "oceans2020", "--listen", "192.0.2.1:0"], "--listen 192.0.2.1:0: cannot be had"),
    ],
)
def test_what_cannot_be_is_one_error(capsys, monkeypatch, tokens, words):
    monkeypatch.setattr("shoal.buoy.beacon.PATIENCE", 0.3)
    code, out, err = shoal(capsys, *tokens)
    assert (code, out, err.count("fix:")) == (2, "", 1)
    assert words in err


def test_a_fleet_without_a_place_needs_an_origin(capsys, beacon):
    beacon.tell(bulletin(origin=None).to_bytes())
    code, _, err = shoal(capsys, "chart", "--fleet", f"{HOST}:{beacon.port}")
    assert code == 2
    assert "has no place on Earth (area.origin)" in err
    assert "--origin=-1.3,50.8" in err
