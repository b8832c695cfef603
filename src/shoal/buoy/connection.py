"""Bytes to and from an autopilot, over UDP, TCP or a serial port. What they say is mavlink.py's.

Addresses are spelt as pymavlink spells them. Its own connections are not used: they send to whoever sent last, print,
and wait.
"""

import socket
import time
from contextlib import suppress
from typing import Any, Protocol

from shoal.buoy.errors import BodyError
from shoal.core.errors import MissingExtraError, reason_of
from shoal.core.text import quoted

MOST = 1000  # messages taken at once: a flood must not keep the loop from its work
LARGEST = 65536  # [bytes] taken at once
DIAL_TIME, DIAL_AGAIN = 5.0, 5.0  # [s] to wait for a connection; between two tries
BAUD = 57600
KINDS = "udp:HOST:PORT (listens), udpout:HOST:PORT, tcp:HOST:PORT, or a serial port such as /dev/ttyACM0,115200"

Peer = Any  # whom a datagram came from, and goes to


class Connection(Protocol):
    """A way to an autopilot. Nothing here waits, but for the first connection."""

    whole: bool  # whether messages arrive whole, never in pieces

    def receive(self) -> list[tuple[bytes, Peer]]:
        """What arrived, and from whom; empty if nothing did."""

    def send(self, data: bytes, peer: Peer) -> None:
        """Send to somebody; where it cannot be sent, it is lost."""

    def close(self) -> None:
        """Let go of it."""


def connect(address: str) -> Connection:
    """Return the connection that an address names.

    Parameters
    ----------
    address : udp:HOST:PORT or udpin:HOST:PORT, which listen; udpout:HOST:PORT; tcp:HOST:PORT; DEVICE[,BAUD]

    Raises
    ------
    BodyError : it is not one of these, or cannot be had
    MissingExtraError : pyserial is not installed
    """
    kind, colon, rest = address.partition(":")
    try:
        if colon and kind in ("udp", "udpin"):
            return Datagrams(_host_and_port(address, rest), listens=True)
        if colon and kind == "udpout":
            return Datagrams(_host_and_port(address, rest), listens=False)
        if colon and kind == "tcp":
            return Stream(_host_and_port(address, rest))
        if address.startswith(("/dev/", "COM")):
            return Serial(address)
    except (OSError, UnicodeError, ValueError) as error:
        if isinstance(error, BodyError | MissingExtraError):
            raise
        problem = f"cannot be connected to: {reason_of(error)}"
        raise BodyError(address, problem, "check the address, and that nothing else has the port") from error
    raise BodyError("--body", f"{quoted(address)} is no address of an autopilot", f"write mavlink: and {KINDS}")


class Datagrams:
    """UDP: each datagram holds whole messages."""

    whole = True

    def __init__(self, place: tuple[str, int], listens: bool) -> None:
        family, _, _, _, resolved = socket.getaddrinfo(*place, type=socket.SOCK_DGRAM)[0]
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._connected = not listens
        try:
            self._socket.setblocking(False)
            if listens:
                self._socket.bind(resolved)
            else:
                self._socket.connect(resolved)  # the system drops what others send
        except OSError:
            self._socket.close()
            raise

    @property
    def place(self) -> tuple[str, int]:
        """Where it listens: host and port."""
        host, port = self._socket.getsockname()[:2]
        return str(host), int(port)

    def receive(self) -> list[tuple[bytes, Peer]]:
        """See Connection."""
        found: list[tuple[bytes, Peer]] = []
        for _ in range(MOST):
            try:
                found.append(self._socket.recvfrom(LARGEST))
            except BlockingIOError:
                break
            except OSError:  # nobody listens there yet
                continue
        return found

    def send(self, data: bytes, peer: Peer) -> None:
        """See Connection."""
        with suppress(OSError):
            if self._connected:
                self._socket.send(data)
            elif peer is not None:
                self._socket.sendto(data, peer)

    def close(self) -> None:
        """See Connection."""
        self._socket.close()


class Stream:
    """TCP, connected to again when it breaks."""

    whole = False

    def __init__(self, place: tuple[str, int]) -> None:
        self._place = place
        self._socket: socket.socket | None = self._dial()
        self._tried = time.monotonic()

    def _dial(self) -> socket.socket:
        dialed = socket.create_connection(self._place, timeout=DIAL_TIME)
        dialed.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        dialed.setblocking(False)
        return dialed

    def receive(self) -> list[tuple[bytes, Peer]]:
        """See Connection."""
        if self._socket is None and time.monotonic() - self._tried > DIAL_AGAIN:
            with suppress(OSError):
                self._socket = self._dial()
            self._tried = time.monotonic()
        if self._socket is None:
            return []
        try:
            data = self._socket.recv(LARGEST)
        except BlockingIOError:
            return []
        except OSError:
            data = b""
        if not data:
            self._hang_up()
            return []
        return [(data, None)]

    def send(self, data: bytes, peer: Peer) -> None:
        """See Connection."""
        if self._socket is not None:
            try:
                sent = self._socket.send(data)
            except BlockingIOError:
                return  # the line is full: this one is lost, whole
            except OSError:
                sent = -1
            if sent != len(data):  # broken, or a message was cut
                self._hang_up()

    def _hang_up(self) -> None:
        if self._socket is not None:
            self._socket.close()
            self._socket = None
            self._tried = time.monotonic()

    def close(self) -> None:
        """See Connection."""
        self._hang_up()


class Serial:
    """A serial port, by pyserial."""

    whole = False

    def __init__(self, address: str) -> None:
        device, comma, rate = address.partition(",")
        if comma and not (rate.isascii() and rate.isdigit() and 0 < int(rate) < 10_000_000):
            raise BodyError(address, f"{quoted(rate)} is no baud rate", f"write {device},115200")
        try:
            import serial
        except ImportError as error:
            raise MissingExtraError.of("pyserial", "mavlink", "a serial port") from error
        self._port: Any = serial.Serial(device, int(rate) if comma else BAUD, timeout=0, write_timeout=0)

    def receive(self) -> list[tuple[bytes, Peer]]:
        """See Connection."""
        try:
            data = bytes(self._port.read(LARGEST))
        except OSError:  # unplugged: pyserial's errors are of this kind
            return []
        return [(data, None)] if data else []

    def send(self, data: bytes, peer: Peer) -> None:
        """See Connection."""
        with suppress(OSError):
            self._port.write(data)

    def close(self) -> None:
        """See Connection."""
        self._port.close()


def _host_and_port(address: str, rest: str) -> tuple[str, int]:
    host, _, port = rest.rpartition(":")
    if not host or not (port.isascii() and port.isdigit() and 0 <= int(port) <= 65535):
        raise BodyError("--body", f"{quoted(address)} does not say host and port", f"write {KINDS}")
    return host.removeprefix("[").removesuffix("]"), int(port)
