"""Buoys on vehicles of their own: processes that meet on a mesh and steer rovers that speak MAVLink, in real time."""

import math
import os
import random
import re
import signal
import socket
from datetime import datetime

import pytest

from certificates import certificates
from commands import shoal
from scenarios import fleets, scenario

pytest.importorskip("pymavlink", reason="pymavlink is not installed: pip install '.[mavlink]'")
pytest.importorskip("pyproj", reason="pyproj is not installed: pip install '.[maritime]'")
pytest.importorskip("zenoh", reason="the extra fleet is not installed")

from shoal.buoy.sail import Gear, mesh_of, others_of
from shoal.buoy.trust import key_in
from shoal.buoy.zenoh_mesh import ZenohMesh
from shoal.scenario.load import to_toml
from vehicles import ORIGIN, Buoys, Sea, free_ports, wait_until

PLACES = [(-30.0, 0.0), (0.0, 30.0), (30.0, 0.0)]
STEP = 0.2


def afloat(**more):
    changes = {
        **more,
        "fleets": fleets((3, 2.0)),
        "network.neighbors": 2,
        "area": {"width": 200.0, "height": 200.0, "agent_margin": 10.0, "origin": list(ORIGIN)},
        "time_step": STEP,
        "steps": 5000,
    }
    return scenario("oceans2020", changes)


@pytest.fixture
def fleet(tmp_path):
    *ports, sensor = free_ports(4, socket.SOCK_DGRAM)
    sea = Sea(PLACES, ports)
    meshes = [f"127.0.0.1:{port}" for port in free_ports(3, socket.SOCK_STREAM)]
    bodies = [f"127.0.0.1:{port}" for port in ports]
    buoys = Buoys(tmp_path, afloat(), bodies, meshes, {2: ["--sensor", f"udp:127.0.0.1:{sensor}"]})
    buoys.sea, buoys.sensor = sea, sensor
    yield buoys
    buoys.close()
    sea.close()


def test_three_buoys_meet_steer_and_outlive_what_befalls_them(fleet):
    rovers = fleet.sea.rovers

    def hears(id, others):
        rows = fleet.rows(id)
        return bool(rows) and rows[-1]["heard"] == str(others)

    def apart():
        """How far apart in time two buoys did the last step that both did [s]."""
        first, second = ({row["step"]: datetime.fromisoformat(row["time"]) for row in fleet.rows(id)} for id in (0, 2))
        last = max(first.keys() & second.keys(), key=int)
        return abs((first[last] - second[last]).total_seconds())

    fleet.start(0, SHOAL_CLOCK_OFF="0:100@0")
    fleet.start(1)
    fleet.wait_for("buoy 0: 2 of 3 buoys are here", [0])
    assert not any(rover.setpoints for rover in rovers)  # nobody moves before all are there
    fleet.start(2, SHOAL_CLOCK_OFF="2:-3@0")
    fleet.wait_for("step 0 of 5,000")
    wait_until(lambda: all(hears(id, 2) for id in range(3)))
    assert all(rover.armed for rover in rovers)
    wait_until(lambda: apart() < STEP)

    fleet.sea.seen_from = fleet.sensor  # buoy 2 sees a target, and tells
    before = fleet.sea.place(0)[0]
    wait_until(lambda: fleet.sea.place(0)[0] > before + 1.0 and fleet.sea.place(1)[1] < PLACES[1][1])

    stranger = ZenohMesh(mesh_of(afloat()), "stranger", connect=[f"tcp/{each}" for each in fleet.meshes])
    stranger.join()
    wait_until(lambda: stranger.alive() == 4)
    chance = random.Random(7)
    for _ in range(3000):
        stranger.publish(chance.randbytes(chance.randrange(100)))
    stranger.close()

    fleet.kill(1)
    wait_until(lambda: hears(0, 1) and hears(2, 1))
    fleet.start(1)  # it rejoins
    wait_until(lambda: all(hears(id, 2) for id in range(3)))
    assert fleet.said(1).count(" of 5,000") == 2

    os.kill(fleet.processes[2].pid, signal.SIGSTOP)
    wait_until(lambda: rovers[2].time - rovers[2].set_at > 3.0)  # it lies still
    assert hears(0, 1)
    os.kill(fleet.processes[2].pid, signal.SIGCONT)
    wait_until(lambda: all(hears(id, 2) for id in range(3)))
    wait_until(lambda: apart() < STEP)

    fleet.kill(1)
    fleet.kill(2)
    wait_until(lambda: fleet.rows(0)[-1]["note"] == "stopped: nobody is heard")
    assert rovers[0].armed
    assert fleet.interrupt(0) == 130
    assert not rovers[0].armed
    last = fleet.said(0).splitlines()[-2]
    assert last.startswith("shoal: buoy 0 stopped its vehicle; decided in ")
    assert last.endswith(".csv")
    assert int(last.split(" of no use")[0].split()[-1].replace(",", "")) >= 2000


def test_vehicles_obey_who_has_key_and_certificate_and_nobody_else(tmp_path, capsys):
    ours, theirs = certificates(tmp_path)
    key, wrong = tmp_path / "key", tmp_path / "wrong"
    key_in(key), key_in(wrong)
    ports = free_ports(4, socket.SOCK_DGRAM)
    sea = Sea([*PLACES, (60.0, 0.0)], ports)
    meshes = [f"127.0.0.1:{port}" for port in free_ports(4, socket.SOCK_STREAM)]
    options = ["--mesh-config", str(ours), "--command-key", str(key)]
    scenario = afloat(strategy="random-walk")  # of which nobody lies still by itself
    fleet = Buoys(tmp_path, scenario, [f"127.0.0.1:{port}" for port in ports], meshes, dict.fromkeys(range(4), options))

    def command(*words, key=key, config=ours, wait=20):
        more = ["--mesh-config", config] if config else []
        return shoal(capsys, "command", meshes[0], *words, "--key", key, *more, "--wait", wait)

    def wants(id):
        row = fleet.rows(id)[-1]
        return row["want_x"] + " " + row["want_y"]

    def lies_still(id):
        return wants(id) == "0.000 0.000"

    try:
        for id in range(3):
            fleet.start(id)
        fleet.wait_for("step 0 of 5,000")
        wait_until(lambda: all(len(fleet.rows(id)) > 5 and not lies_still(id) for id in range(3)))

        sea.rovers[1].blind = True  # it does not know its place, and is a buoy all the same
        wait_until(lambda: "where it is" in fleet.rows(1)[-1]["note"])
        code, out, err = command("hold")
        assert (code, err) == (0, "")
        assert sorted(int(id) for line in out.splitlines() for id in _numbers(line)) == [0, 1, 2]
        sea.rovers[1].blind = False
        wait_until(lambda: all(lies_still(id) for id in range(3)))
        wait_until(lambda: all(math.hypot(rover.east, rover.north) < 0.01 for rover in sea.rovers[:3]))

        for who, words in (
            ({"key": wrong}, "no buoy of "),
            ({"config": theirs}, "no fleet is there"),
            ({"config": None}, "no fleet is there"),
        ):
            code, out, err = command("resume", **who, wait=1)
            assert (code, out, words in err, err.count("\n")) == (2, "", True, 2)

        sea.rovers[1].lon, sea.rovers[1].lat = sea.frame.geographic(5.0, 30.0)  # a current sets it off
        away = math.dist(sea.place(1), PLACES[1])
        assert command("recall", "--buoy", 1)[:2] == (0, command_said(fleet, 1, "recall"))
        wait_until(lambda: math.dist(sea.place(1), PLACES[1]) < away - 1.0)
        assert lies_still(0)
        assert command("set", "area.width=100")[0] == 2  # no field that may change on the way
        assert command("set", "neighbors=1")[0] == 0
        assert command("resume")[0] == 0
        wait_until(lambda: not any(lies_still(id) for id in range(3)))

        fleet.start(3, id=1)  # on another vehicle, under a number that is there
        assert fleet.processes[3].wait(60.0) == 2
        assert "--id: is 1, but a buoy 1 is on the mesh already" in fleet.said(3)
        assert not sea.rovers[3].heard  # it did not touch its vehicle
        assert fleet.rows(1)[-1]["heard"] == "2"
        assert fleet.interrupt(1) == 130
    finally:
        fleet.close()
        sea.close()


def _numbers(line):
    """Of `obeyed from step 7 on: buoys 0-1`, 0 and 1."""
    for part in re.split(r": buoys? ", line)[-1].split(", "):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def command_said(fleet, id, words):
    """What `shoal command` must have printed of one buoy that obeys, by its log."""
    wait_until(lambda: any(f"on: {words}" in row["note"] for row in fleet.rows(id)))
    note = next(row["note"] for row in fleet.rows(id) if f"on: {words}" in row["note"])
    return f"obeyed from step {note.split('ordered from step ')[1].split(' on:')[0]} on: buoy {id}\n"


def test_one_list_of_addresses_does_for_all():
    told = ["10.0.0.1:7447", "10.0.0.2:7447", "10.0.0.3:7447"]
    assert [others_of(Gear("", listen=each, connect=told)) for each in told] == [[], told[:1], told[:2]]
    assert others_of(Gear("", listen="10.0.0.9:7447", connect=told)) == told


HERE = ["--body", "mavlink:udp:127.0.0.1:1"]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--id", "1"], "--connect: is not given, and no --body"),
        (["--id", "1", "--arm", "--connect", "127.0.0.1:1"], "--arm: is for a buoy with a --body"),
        (["--id", "1", "--wait", "2", "--connect", "127.0.0.1:1"], "--wait: is for a buoy with a --body"),
        (["--id", "1,2", *HERE], "names several buoys"),
        (["--id", "50", *HERE], "id: is 50"),
        (["--id", "1", *HERE], "area.origin: is not given"),
        (["--id", "1", *HERE, "--listen", "7447"], "--listen: is '7447'"),
        (["--id", "1", *HERE, "--connect", "a:1,b"], "--connect: is 'b'"),
        (["--id", "1", *HERE, "--body-key", "nowhere"], "nowhere: cannot be read"),
        (["--id", "1", *HERE, "--wait", "0"], "--wait: is 0"),
    ],
)
def test_what_cannot_be_is_one_sentence(capsys, options, words):
    code, out, err = shoal(capsys, "buoy", "oceans2020", *options)
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert words in err


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--body", "boat:1"], "'boat:1' is no kind of body"),
        ([*HERE, "--sensor", "sonar"], "'sonar' is no kind of sensor"),
        ([*HERE, "--sensor", "track"], "track needs a recorded target"),
        ([*HERE, "--out", "/dev/null/log"], "cannot be written"),
        (["--body", "mavlink:udp:300.0.0.1:1"], "cannot be connected to"),
    ],
)
def test_a_body_or_sensor_that_cannot_be_had_is_one_too(capsys, tmp_path, monkeypatch, options, words):
    monkeypatch.setattr("shoal.buoy.aboard.Aboard.warm", lambda self: None)
    (tmp_path / "mine.toml").write_text(to_toml(afloat()), encoding="utf-8")
    code, out, err = shoal(capsys, "buoy", tmp_path / "mine.toml", "--id", 1, *options)
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert words in err


def test_waiting_is_said_and_a_failed_start_leaves_no_log(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("shoal.buoy.aboard.Aboard.warm", lambda self: None)
    monkeypatch.setattr("shoal.buoy.mavlink_body.PATIENCE", 0.2)
    (tmp_path / "mine.toml").write_text(to_toml(afloat()), encoding="utf-8")
    (port,) = free_ports(1, socket.SOCK_DGRAM)
    body = f"mavlink:udp:127.0.0.1:{port}"
    code, _, err = shoal(capsys, "buoy", tmp_path / "mine.toml", "--id", 1, "--body", body, "--out", tmp_path / "log")
    said = f"shoal: buoy 1: waits for a vehicle at udp:127.0.0.1:{port}, for its position and for GUIDED, 0.2 s at most"
    assert (code, err.splitlines()[0]) == (2, f"{said} for each")
    assert "no vehicle is heard" in err
    assert not (tmp_path / "log").exists()


def test_two_on_a_desk_move_without_a_vehicle(tmp_path):
    meshes = [f"127.0.0.1:{port}" for port in free_ports(2, socket.SOCK_STREAM)]
    desk = Buoys(tmp_path, afloat(strategy="random-walk"), [], meshes, {id: ["--wait", "2"] for id in range(2)})
    try:
        for id in range(2):
            desk.start(id)
        wait_until(lambda: all(len(desk.rows(id)) > 10 and float(desk.rows(id)[-1]["vx"]) for id in range(2)))
        assert all(math.hypot(float(row["vx"]), float(row["vy"])) < 2.0 + 1e-3 for row in desk.rows(0))
    finally:
        desk.close()
