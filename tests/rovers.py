"""A rover that speaks real MAVLink over UDP, in a time of the tests' own, and the hand of a clock that moves both."""

import math
import random
import socket

from pymavlink.dialects.v20 import ardupilotmega as words
from pyproj import Geod

EARTH = Geod(ellps="WGS84")
LAG = 0.5  # [s] in which most of a change of velocity is done
TIMEOUT = 3.0  # [s] GUID_TIMEOUT


class Rover:
    """A boat of ArduPilot's: it heeds set-points in GUIDED, armed, for three seconds each; else it lies still.

    It says nothing of its place before it is asked to, is armed only in GUIDED, and drops what `lost` says.
    """

    def __init__(self, to, lon, lat, *, kind=words.MAV_TYPE_SURFACE_BOAT, system=1, lost=0.0):
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.setblocking(False)
        self.to = to
        self.lon, self.lat, self.east, self.north = lon, lat, 0.0, 0.0
        self.kind, self.autopilot = kind, words.MAV_AUTOPILOT_ARDUPILOTMEGA
        self.mode, self.armed, self.prearm = words.ROVER_MODE_MANUAL, False, ""
        self.line = words.MAVLink(None, system, 1)
        self.line.robust_parsing = True
        self.chance, self.lost = random.Random(1), lost
        self.time, self.beat_at, self.fix_at, self.interval = 0.0, 0.0, 0.0, None
        self.delay, self.queue = 0.0, []  # [s] on the way to the body
        self.mute = self.blind = False  # says nothing at all; says nothing of its place
        self.setpoint, self.set_at, self.setpoints, self.heard = (0.0, 0.0), -math.inf, [], []

    def say(self, message):
        data = message.pack(self.line)
        self.line.seq = (self.line.seq + 1) % 256
        if not self.mute and self.chance.random() >= self.lost:
            self.queue.append((self.time + self.delay, data))
        while self.queue and self.queue[0][0] <= self.time:
            self.socket.sendto(self.queue.pop(0)[1], self.to)

    def listen(self):
        while True:
            try:
                data = self.socket.recv(4096)
            except BlockingIOError:
                return
            if self.chance.random() < self.lost:
                continue
            for message in self.line.parse_buffer(data) or []:
                self.heard.append(message.get_type())
                if message.get_type() == "COMMAND_LONG":
                    self.obey(message)
                elif message.get_type() == "SET_POSITION_TARGET_LOCAL_NED":
                    self.setpoints.append((self.time, message))
                    if self.mode == words.ROVER_MODE_GUIDED:
                        assert message.coordinate_frame == words.MAV_FRAME_LOCAL_NED
                        self.setpoint, self.set_at = (message.vy, message.vx), self.time

    def obey(self, message):
        result = words.MAV_RESULT_ACCEPTED
        if message.command == words.MAV_CMD_DO_SET_MODE:
            self.mode = int(message.param2)
        elif message.command == words.MAV_CMD_COMPONENT_ARM_DISARM:
            if message.param1 == 0:
                self.armed = False
            elif self.mode != words.ROVER_MODE_GUIDED or self.prearm:
                result = words.MAV_RESULT_FAILED
                self.say(words.MAVLink_statustext_message(2, f"Arm: {self.prearm or 'mode'}".encode()))
            else:
                self.armed = True
        elif message.command == words.MAV_CMD_SET_MESSAGE_INTERVAL:
            assert message.param1 == words.MAVLINK_MSG_ID_GLOBAL_POSITION_INT
            self.interval = message.param2 * 1e-6
        self.say(words.MAVLink_command_ack_message(message.command, result))

    def advance(self, dt):
        self.listen()
        self.time += dt
        steered = self.armed and self.mode == words.ROVER_MODE_GUIDED and self.time - self.set_at < TIMEOUT
        east, north = self.setpoint if steered else (0.0, 0.0)
        share = 1.0 - math.exp(-dt / LAG)
        self.east += share * (east - self.east)
        self.north += share * (north - self.north)
        way, bearing = math.hypot(self.east, self.north) * dt, math.degrees(math.atan2(self.east, self.north))
        self.lon, self.lat, _ = EARTH.fwd(self.lon, self.lat, bearing, way)
        if self.time >= self.beat_at:
            self.beat_at = self.time + 1.0
            base = 1 + 128 * self.armed
            self.say(words.MAVLink_heartbeat_message(self.kind, self.autopilot, base, self.mode, 4, 3))
        if self.interval and not self.blind and self.time >= self.fix_at:
            self.fix_at = self.time + self.interval
            place = (round(self.lat * 1e7), round(self.lon * 1e7), 0, 0)
            velocity = (round(self.north * 100), round(self.east * 100), 0)
            self.say(words.MAVLink_global_position_int_message(round(self.time * 1e3), *place, *velocity, 65535))


class Hand:
    """Moves the time of a rover and a body: seconds pass at once."""

    def __init__(self):
        self.now, self.movers, self.bodies = 100.0, [], []

    def clock(self):
        return self.now

    def wait(self, seconds):
        self.now += seconds
        for each in self.movers:
            each.advance(seconds)

    def run(self, seconds, each_step=lambda: None, step=0.1):
        for _ in range(round(seconds / step)):
            self.wait(step)
            each_step()
            for body in self.bodies:
                body.tick()
