"""MAVLink, the language of autopilots: bytes in, what they say out, and the few things that a buoy says.

The only file that imports pymavlink, and of it only the message set `common`: its connections (mavutil) send to whoever
sent last, print, wait, and take 24 MB more.
"""

import hashlib
import math
import struct
import time
from types import ModuleType
from typing import Any, NamedTuple

from shoal.core.errors import MissingExtraError

# MAVLink's `common` messages; https://mavlink.io/en/messages/common.html
ROVER, BOAT = 10, 11  # MAV_TYPE
ARDUPILOT, NO_AUTOPILOT = 3, 8  # MAV_AUTOPILOT
ONBOARD_COMPUTER, ONBOARD_CONTROLLER = 191, 18  # MAV_COMPONENT, MAV_TYPE: what a buoy is on its vehicle
LOCAL_NED = 1  # MAV_FRAME
ARMED, CUSTOM_MODE = 128, 1  # MAV_MODE_FLAG
SET_MODE, ARM, SET_INTERVAL = 176, 400, 511  # MAV_CMD
POSITION = 33  # GLOBAL_POSITION_INT
# POSITION_TARGET_TYPEMASK: ignore x, y, z (1 + 2 + 4), accelerations (64 + 128 + 256), yaw (1024), its rate (2048).
VELOCITY = 0x0DC7
STANDSTILL = 0x05C7  # no turn either: a rate of 0; of the velocity (0, 0) ArduPilot would make the heading north
SLOWEST = 0.01  # [m/s] what is slower is a standstill: it would only turn the vehicle
# ArduPilot Rover's modes, which boats have, too; https://ardupilot.org/rover/docs/rover-control-modes.html
MODES = {
    0: "MANUAL",
    1: "ACRO",
    3: "STEERING",
    4: "HOLD",
    5: "LOITER",
    6: "FOLLOW",
    7: "SIMPLE",
    8: "DOCK",
    9: "CIRCLE",
    10: "AUTO",
    11: "RTL",
    12: "SMART_RTL",
    15: "GUIDED",
    16: "INITIALIZING",
}
HOLD, GUIDED = 4, 15

_EPOCH = 1420070400  # [s] of 2015-01-01, from which signatures count in 10 us


class Heartbeat(NamedTuple):
    """Who is on the line: a vehicle of some kind, in a mode."""

    system: int
    component: int
    kind: int
    autopilot: int
    mode: int
    armed: bool

    @property
    def surface(self) -> bool:
        """Whether ArduPilot steers it, and it is a rover or a boat."""
        return self.autopilot == ARDUPILOT and self.kind in (ROVER, BOAT)

    @property
    def words(self) -> str:
        """What it is, such as "surface boat of ardupilotmega, system 1"."""
        return f"{_name('MAV_TYPE', self.kind)} of {_name('MAV_AUTOPILOT', self.autopilot)}, system {self.system}"


class Fix(NamedTuple):
    """Where a vehicle is [deg], how it moves over ground [m/s], true; `clock` [s] of its own, since it was started."""

    system: int
    lon: float
    lat: float
    east: float
    north: float
    clock: float


class Answer(NamedTuple):
    """What a vehicle said to a command: 0 is yes."""

    system: int
    command: int
    result: int


class Notice(NamedTuple):
    """A text of the vehicle for people, such as why it cannot be armed."""

    system: int
    text: str


Message = Heartbeat | Fix | Answer | Notice


class Mavlink:
    """Reads and writes MAVLink 2, and reads MAVLink 1.

    Parameters
    ----------
    system : number of the vehicle that the buoy is on board of
    whole : each piece of data holds whole messages, so that a damaged one spoils no other
    key : 32 bytes that sign every message; unsigned ones are not heard then

    Attributes
    ----------
    damaged : how many messages were none

    Raises
    ------
    MissingExtraError : pymavlink is not installed
    """

    def __init__(self, system: int = 1, *, whole: bool = True, key: bytes | None = None) -> None:
        self._dialect = dialect()
        self._whole = whole
        self._line = self._dialect.MAVLink(None, system, ONBOARD_COMPUTER)
        self._line.robust_parsing = True  # or it raises on noise
        self.damaged = 0
        if key is not None:
            signing = self._line.signing
            signing.secret_key, signing.sign_outgoing = key, True
            signing.link_id, signing.timestamp = 0, int((time.time() - _EPOCH) * 1e5)

    def on_board(self, system: int) -> None:
        """Say from now on that the buoy is on board of this vehicle."""
        self._line.srcSystem = system

    def heard(self, data: bytes) -> list[Message]:
        """Return what some bytes say, as far as a buoy cares."""
        if self._whole:
            self._line.buf, self._line.buf_index = bytearray(), 0
        found: list[Message] = []
        try:
            messages = self._line.parse_buffer(data) or []
        except (struct.error, IndexError, ValueError, TypeError):
            messages = []
            self.damaged += 1
            self._line.buf, self._line.buf_index = bytearray(), 0
        for message in messages:
            understood = self._understood(message)
            if understood is not None:
                found.append(understood)
        return found

    def _understood(self, message: Any) -> Message | None:
        kind = message.get_type()
        if kind == "BAD_DATA":
            self.damaged += 1
            return None
        system = message.get_srcSystem()
        if kind == "HEARTBEAT":
            armed = bool(message.base_mode & ARMED)
            component = message.get_srcComponent()
            return Heartbeat(system, component, message.type, message.autopilot, message.custom_mode, armed)
        if kind == "GLOBAL_POSITION_INT":
            lon, lat = message.lon * 1e-7, message.lat * 1e-7
            valid = (message.lon, message.lat) != (0, 0) and abs(lon) <= 180.0 and abs(lat) < 90.0
            clock = message.time_boot_ms * 1e-3
            return Fix(system, lon, lat, message.vy * 0.01, message.vx * 0.01, clock) if valid else None
        if kind == "COMMAND_ACK":
            return Answer(system, message.command, message.result)
        if kind == "STATUSTEXT":
            text = message.text
            return Notice(system, text if isinstance(text, str) else text.decode("ascii", "replace"))
        return None

    def _bytes(self, message: Any) -> bytes:
        data = bytes(message.pack(self._line))
        self._line.seq = (self._line.seq + 1) % 256
        return data

    def heartbeat(self) -> bytes:
        """The buoy is there."""
        say = self._line.heartbeat_encode
        return self._bytes(say(ONBOARD_CONTROLLER, NO_AUTOPILOT, 0, 0, 4))  # MAV_STATE_ACTIVE

    def command(self, to: Heartbeat, number: int, *values: float) -> bytes:
        """A command with up to seven values."""
        padded = (*values, *(0.0,) * (7 - len(values)))
        return self._bytes(self._line.command_long_encode(to.system, to.component, number, 0, *padded))

    def velocity(self, to: Heartbeat, east: float, north: float) -> bytes:
        """Go with this velocity over ground, true [m/s]; lie still where it is next to none."""
        if math.hypot(east, north) < SLOWEST:
            east = north = 0.0
        mask = VELOCITY if east or north else STANDSTILL
        say = self._line.set_position_target_local_ned_encode
        place, others = (0.0,) * 3, (0.0,) * 5
        return self._bytes(say(0, to.system, to.component, LOCAL_NED, mask, *place, north, east, 0.0, *others))


def key_of(text: str) -> bytes:
    """Return the 32 bytes of a pass phrase: its SHA-256, as ground stations make it."""
    return hashlib.sha256(text.encode()).digest()


def dialect() -> ModuleType:
    """Return pymavlink's `common` messages.

    Raises
    ------
    MissingExtraError : it is not installed
    """
    try:
        from pymavlink.dialects.v20 import common
    except ImportError as error:
        raise MissingExtraError.of("pymavlink", "mavlink", "a body that speaks MAVLink") from error
    return common  # type: ignore[no-any-return]


def _name(enum: str, number: int) -> str:
    """The name of a number of MAVLink's in small letters."""
    entry = dialect().enums[enum].get(number)
    return entry.name.removeprefix(f"{enum}_").replace("_", " ").lower() if entry else f"{enum} {number}"
