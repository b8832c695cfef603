"""A vehicle at the other end of a connection: what it said last, and words to it. It has no clock of its own."""

import math

from shoal.buoy.connection import Connection, Peer
from shoal.buoy.mavlink import (
    ARM,
    CUSTOM_MODE,
    GUIDED,
    MODES,
    NO_AUTOPILOT,
    POSITION,
    SET_INTERVAL,
    SET_MODE,
    Answer,
    Fix,
    Heartbeat,
    Mavlink,
    Message,
    Notice,
)
from shoal.core.text import quoted

LOST = 4.0  # [s] without a heartbeat: three are missed
STALE = 2.0  # [s] an older position is none
DRIFT = 1e-3  # [1] two clocks may go apart by so much of the time
RESTARTED = 10.0  # [s] by which its clock must fall back for it to have been started anew

Problem = tuple[str, str]  # what is wrong, and what to do about it


class Vehicle:
    """The first rover or boat on a connection, and nobody else.

    Parameters
    ----------
    name : what errors call it: its address
    connection : the way to it
    mavlink : what turns bytes into messages
    system : its number; default: any

    Attributes
    ----------
    heartbeat, fix : what it said last; None before
    stranger : who else is on the line: somebody that is no rover and no boat of ArduPilot's
    answers : {command: result} of what it was asked
    notices : its last texts for people
    ignored : how many messages came from others than the vehicle, or late
    """

    def __init__(self, name: str, connection: Connection, mavlink: Mavlink, system: int | None = None) -> None:
        self.name = name
        self._connection = connection
        self._mavlink = mavlink
        self._system = system
        self._peer: Peer = None
        self._heard_at = self._fixed_at = -math.inf
        self._offset = math.inf  # of our clock against its, the way of the quickest message in it [s]
        self.heartbeat: Heartbeat | None = None
        self.fix: Fix | None = None
        self.stranger: Heartbeat | None = None
        self.answers: dict[int, int] = {}
        self.notices: list[str] = []
        self.ignored = 0

    @property
    def damaged(self) -> int:
        """How many messages were none."""
        return self._mavlink.damaged

    def silent(self, now: float) -> float:
        """For how long it has not been heard [s]; infinite before the first time."""
        return now - self._heard_at

    def age(self, now: float) -> float:
        """How old its position is [s]; infinite where there is none."""
        return now - self._fixed_at

    def listen(self, now: float) -> None:
        """Take what arrived until now [s]."""
        for data, peer in self._connection.receive():
            for message in self._mavlink.heard(data):
                self._take(message, peer, now)

    def _take(self, message: Message, peer: Peer, now: float) -> None:
        if isinstance(message, Heartbeat):
            self._greet(message, peer, now)
        elif self.heartbeat is None or message.system != self.heartbeat.system or peer != self._peer:
            self.ignored += 1
        elif isinstance(message, Fix):
            self._locate(message, now)
        elif isinstance(message, Answer):
            self.answers[message.command] = message.result
        elif isinstance(message, Notice):
            self.notices = [*self.notices[-4:], message.text]

    def _locate(self, message: Fix, now: float) -> None:
        """Keep a position, with the time at which it was so: by the vehicle's clock and the quickest message so far."""
        since = message.clock - self.fix.clock if self.fix is not None else -math.inf
        if -RESTARTED < since <= 0.0:
            self.ignored += 1
            return
        offset = now - message.clock
        self._offset = min(offset, self._offset + DRIFT * since) if since > 0.0 else offset
        self.fix, self._fixed_at = message, message.clock + self._offset

    def _greet(self, message: Heartbeat, peer: Peer, now: float) -> None:
        """Heed the vehicle; from another address only after it was silent at the old one."""
        known = self.heartbeat
        if message.autopilot == NO_AUTOPILOT:  # a ground station, a camera
            return
        if known is None:
            if self._system not in (None, message.system):
                self.ignored += 1
                return
            if not message.surface:
                self.stranger = message
                return
            self._mavlink.on_board(message.system)
        elif (known.system, known.component) != (message.system, message.component) or not message.surface:
            return
        elif peer != self._peer and self.silent(now) <= LOST:
            self.ignored += 1
            return
        if peer != self._peer:  # it may be another, or have been started anew
            self.fix, self._fixed_at = None, -math.inf
        self.heartbeat, self._peer, self._heard_at = message, peer, now

    @property
    def mode(self) -> str:
        """The name of its mode; empty before it is heard."""
        return MODES.get(self.heartbeat.mode, str(self.heartbeat.mode)) if self.heartbeat else ""

    @property
    def armed(self) -> bool:
        """Whether its motors may turn."""
        return self.heartbeat is not None and self.heartbeat.armed

    def unheard(self, now: float) -> Problem | None:
        """Why nothing is known of it now, and what to do; None if it is heard."""
        if self.heartbeat is None:
            fix = "check the address, and that the autopilot sends there: docs/how-to/ardupilot.md"
            return "no vehicle is heard", fix
        if self.silent(now) > LOST:
            return f"was not heard for {self.silent(now):.1f} s", "check the connection; without it the vehicle stops"
        return None

    def nowhere(self, now: float) -> Problem | None:
        """Why it is not known where it is, and what to do; None if it is known."""
        age = self.age(now)
        if age == math.inf:
            return "does not say where it is", "wait for its satellite receiver, and check that it has one"
        return (f"said {age:.1f} s ago where it is", "wait; check connection and receiver") if age > STALE else None

    def not_guided(self, now: float) -> Problem | None:
        """Why it does not heed set-points, and what to do; None if it does."""
        if self.mode == MODES[GUIDED]:
            return None
        return f"is in mode {self.mode}: a person, or a failsafe, has it{self._said}", "switch it to GUIDED to go on"

    def not_armed(self, now: float) -> Problem | None:
        """Why its motors do not turn, and what to do; None if they may."""
        return None if self.armed else (f"is not armed{self._said}", "mend what it names, and arm it, or ask for it")

    @property
    def _said(self) -> str:
        return f"; it says {quoted(' / '.join(self.notices))}" if self.notices else ""

    def greet(self) -> None:
        """Tell the line that the buoy is there."""
        self._connection.send(self._mavlink.heartbeat(), self._peer)

    def ask_mode(self, number: int) -> None:
        """Ask it to change its mode."""
        self._command(SET_MODE, CUSTOM_MODE, number)

    def ask_to_arm(self) -> None:
        """Ask it to let its motors turn."""
        self._command(ARM, 1)

    def ask_to_disarm(self) -> None:
        """Ask it to let its motors turn no more."""
        self._command(ARM, 0)

    def ask_positions(self, every: float) -> None:
        """Ask it to say where it is, every so often [s]: by itself it need not."""
        self._command(SET_INTERVAL, POSITION, every * 1e6)

    def steer(self, east: float, north: float) -> None:
        """Tell it to go with this velocity over ground, true [m/s]; (0, 0): to lie still."""
        if self.heartbeat is not None:
            self._connection.send(self._mavlink.velocity(self.heartbeat, east, north), self._peer)

    def close(self) -> None:
        """Let go of the connection."""
        self._connection.close()

    def _command(self, number: int, *values: float) -> None:
        if self.heartbeat is not None:
            self._connection.send(self._mavlink.command(self.heartbeat, number, *values), self._peer)
