"""Buoys on vehicles: rovers that live in real time in a thread, and `shoal buoy` processes that steer them."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time
from contextlib import nullcontext

from rovers import Rover
from shoal.core.geodesy import Frame
from shoal.scenario.load import to_toml

ORIGIN = (5.3, 60.4)
TICK = 0.05


class Sea:
    """Rovers at places (x, y) [m], each of which speaks to a port of its own, `within` whatever network."""

    def __init__(self, places, ports, within=None):
        self.seen_from = None  # the port of the sensor that has a target
        self._sensor = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.frame = Frame(ORIGIN)
        self.rovers = []
        for place, port, network in zip(places, ports, within or [nullcontext()] * len(ports), strict=True):
            with network:
                self.rovers.append(Rover(("127.0.0.1", port), *self.frame.geographic(*place)))
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._live, daemon=True)
        self._thread.start()

    def _live(self):
        while not self._over.wait(TICK):
            for rover in self.rovers:
                rover.advance(TICK)
            if self.seen_from:
                self._sensor.sendto(b'{"on_target": true}', ("127.0.0.1", self.seen_from))

    def place(self, number):
        return self.frame.local(self.rovers[number].lon, self.rovers[number].lat)

    def close(self):
        self._over.set()
        self._thread.join()
        self._sensor.close()
        for rover in self.rovers:
            rover.socket.close()


class Buoys:
    """Processes of `shoal buoy`, one per vehicle; what they say is in the file said-ID of a folder.

    Without `bodies` they are points that no vehicle carries.
    """

    def __init__(self, folder, scenario, bodies, meshes, options=None, before=None):
        self.folder, self.bodies, self.meshes = folder, bodies, meshes
        self.file = folder / "fleet.toml"
        self.file.write_text(to_toml(scenario), encoding="utf-8")
        self.options, self.before = options or {}, before or {}
        self.processes = {}

    def start(self, place, id=None, **environment):
        """Start a buoy on the vehicle of a place; its number is that of the place, too, if not given."""
        command = [*self.before.get(place, []), sys.executable, "-m", "shoal", "buoy", str(self.file)]
        command += ["--id", str(place if id is None else id), "--connect", ",".join(self.meshes)]
        body = [f"mavlink:udp:{self.bodies[place]}", "--arm"] if self.bodies else ["simulated"]
        command += ["--listen", self.meshes[place], "--body", *body]
        command += ["--out", str(self.folder / "log"), "--plain"]
        with (self.folder / f"said-{place}").open("ab") as said:
            about = {**os.environ, "OPENBLAS_NUM_THREADS": "1", **environment}
            self.processes[place] = subprocess.Popen([*command, *self.options.get(place, [])], stderr=said, env=about)

    def said(self, id):
        return (self.folder / f"said-{id}").read_text(encoding="utf-8")

    def wait_for(self, words, ids=None, seconds=90.0):
        """Wait until all have said some words."""
        for id in ids if ids is not None else list(self.processes):
            wait_until(lambda id=id: words in self.said(id), lambda id=id: f"buoy {id} says {self.said(id)}", seconds)

    def interrupt(self, id):
        self.processes[id].send_signal(signal.SIGINT)
        return self.processes[id].wait(20.0)

    def kill(self, id):
        self.processes[id].kill()
        self.processes[id].wait()

    def rows(self, id):
        """The rows of the logs of a buoy, one log after the other, by field."""
        found = []
        for file in sorted((self.folder / "log").glob(f"buoy-{id}-*.csv")):
            text = file.read_text(encoding="utf-8")  # as far as it is written
            lines = [line.split(",", 13) for line in text[: text.rfind("\n") + 1].splitlines()]
            found += [dict(zip(lines[0], row, strict=True)) for row in lines[1:]]
        return found

    def close(self):
        for process in self.processes.values():
            process.kill()
            process.wait()


def wait_until(so, else_say=lambda: "", seconds=90.0):
    until = time.monotonic() + seconds
    while not so():
        assert time.monotonic() < until, else_say()
        time.sleep(0.05)


def free_ports(count, kind):
    found = []
    for _ in range(count):
        found.append(socket.socket(socket.AF_INET, kind))
        found[-1].bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in found]
    for each in found:
        each.close()
    return ports
