"""Lines sent over TCP to all who listen: chart plotters that come and go, none of which holds up the others."""

import selectors
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType
from typing import Self

from shoal.viewer.address import listen

LONGEST = 3600.0  # [s] that the system is asked to wait at once
FAREWELL = 5.0  # [s] that a listener has to take what is left at the end


class Broadcast:
    """Sends each message whole to every listener that has taken the one before; the others miss it.

    All happens in `wait` and `send`, in the thread that calls them. Use it as a context.

    Parameters
    ----------
    host, port : where to listen; port 0 is a free one
    greeting : what a listener is sent first
    option : of the command line, for errors of the port

    Attributes
    ----------
    port : where it listens
    met, sent, missed : listeners so far, messages given to one, and messages that one missed

    Raises
    ------
    ShoalError : the address cannot be had
    """

    def __init__(self, host: str, port: int, greeting: bytes, option: str = "--tcp") -> None:
        self._greeting = greeting
        self._listener = listen(host, port, option)
        self._listener.setblocking(False)
        self.port: int = self._listener.getsockname()[1]
        self._waiting = selectors.DefaultSelector()
        self._waiting.register(self._listener, selectors.EVENT_READ)
        self._unsent: dict[socket.socket, bytes] = {}
        self.met = self.sent = self.missed = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for each in list(self._unsent):
            self._drop(each)
        self._waiting.close()
        self._listener.close()

    def wait_for_somebody(self) -> None:
        """Wait until somebody listens."""
        self._serve(lambda: bool(self._unsent))

    def wait(self, until: float) -> None:
        """Serve listeners until a time of `time.monotonic`; once, if that is past."""
        self._serve(lambda: False, until)

    def send(self, message: bytes) -> None:
        """Send a message to all who have taken the one before."""
        for listener, unsent in list(self._unsent.items()):
            if unsent:
                self.missed += 1
                continue
            self.sent += 1
            self._unsent[listener] = message
            self._push(listener)

    def finish(self) -> None:
        """Give listeners a while to take what is left."""
        self._serve(lambda: not any(self._unsent.values()), time.monotonic() + FAREWELL)

    def _serve(self, enough: Callable[[], bool], until: float | None = None) -> None:
        while not enough():
            left = None if until is None else min(max(0.0, until - time.monotonic()), LONGEST)
            for key, events in self._waiting.select(left):
                if key.fileobj is self._listener:
                    self._greet()
                    continue
                listener = key.fileobj
                assert isinstance(listener, socket.socket)
                if events & selectors.EVENT_READ:
                    self._hear(listener)
                if events & selectors.EVENT_WRITE and listener in self._unsent:
                    self._push(listener)
            if until is not None and time.monotonic() >= until:
                return

    def _greet(self) -> None:
        try:
            listener, _ = self._listener.accept()
        except OSError:  # it has left already
            return
        listener.setblocking(False)
        self.met += 1
        self._waiting.register(listener, selectors.EVENT_READ)
        self._unsent[listener] = self._greeting
        self._push(listener)

    def _hear(self, listener: socket.socket) -> None:
        """Drop what a listener says, and one that has left."""
        try:
            if listener.recv(4096):
                return
        except BlockingIOError:
            return
        except OSError:
            pass
        self._drop(listener)

    def _push(self, listener: socket.socket) -> None:
        """Send as much as a listener takes now."""
        try:
            taken = listener.send(self._unsent[listener])
        except BlockingIOError:
            taken = 0
        except OSError:
            self._drop(listener)
            return
        unsent = self._unsent[listener] = self._unsent[listener][taken:]
        self._waiting.modify(listener, selectors.EVENT_READ | (selectors.EVENT_WRITE if unsent else 0))

    def _drop(self, listener: socket.socket) -> None:
        del self._unsent[listener]
        self._waiting.unregister(listener)
        with suppress(OSError):
            listener.shutdown(socket.SHUT_RDWR)
        listener.close()
