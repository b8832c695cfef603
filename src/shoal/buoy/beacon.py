"""A beacon tells everybody who listens the newest there is; a lookout listens to it, and never sends.

Both are peers of zenoh beside the mesh of the buoys: no buoy has a link to a lookout, so none can wait for one.
"""

import threading
from typing import Any

from shoal.buoy.zenoh_mesh import open_peer
from shoal.core.errors import FleetError

AGAIN = 0.5  # [s] after which the newest is told again, to those who came meanwhile
PATIENCE = 3.0  # [s] that an address has to answer
_NEWS, _ALIVE = "shoal/beacon/news", "shoal/beacon/alive"
_PURPOSE = "a mesh between processes"


class Beacon:
    """Tells the newest message to whoever listens, from a thread of its own; who is slow misses some.

    Parameters
    ----------
    host, port : where to listen; port 0 is a free one
    option : of the command line, for errors of the address

    Attributes
    ----------
    port : where it listens

    Raises
    ------
    FleetError : the address cannot be had
    MissingExtraError : zenoh is not installed
    """

    def __init__(self, host: str, port: int, option: str = "--listen") -> None:
        try:
            self._session, (place,) = open_peer([_endpoint(host, port)], [], PATIENCE, _PURPOSE)
        except OSError:
            raise FleetError(f"{option} {host}:{port}", "cannot be had", "name another HOST:PORT") from None
        self.port = int(place.rpartition(":")[2])
        self._publisher = self._session.declare_publisher(_NEWS)  # drops what a listener does not take
        self._token = self._session.liveliness().declare_token(_ALIVE)
        self._newest = b""
        self._news = threading.Event()
        self._over = False
        self._thread = threading.Thread(target=self._run, name="shoal-beacon", daemon=True)
        self._thread.start()

    def tell(self, message: bytes) -> None:
        """Tell this from now on; returns at once."""
        self._newest = message
        self._news.set()

    def close(self) -> None:
        """Tell the newest once more, and leave."""
        self._over = True
        self._news.set()
        self._thread.join(PATIENCE)
        self._session.close()

    def _run(self) -> None:
        over = False
        while not over:
            self._news.wait(AGAIN)
            self._news.clear()
            over = self._over
            if self._newest:
                self._publisher.put(self._newest)


class Lookout:
    """Hears a beacon.

    Parameters
    ----------
    host, port : where it is
    option : of the command line, for errors of the address

    Raises
    ------
    FleetError : there is none
    MissingExtraError : zenoh is not installed
    """

    def __init__(self, host: str, port: int, option: str = "--fleet") -> None:
        where, fix = f"{option} {host}:{port}", "name the address that `shoal fleet` says when it starts"
        try:
            self._session, _ = open_peer([], [_endpoint(host, port)], PATIENCE, _PURPOSE)
        except OSError:
            raise FleetError(where, "nobody answers there", f"start the fleet first, and {fix}") from None
        self._changed = threading.Condition()
        self._newest: bytes | None = None
        self._there = self._gone = False
        self._heard = self._session.declare_subscriber(_NEWS, self._take_in)
        self._watch = self._session.liveliness().declare_subscriber(_ALIVE, self._take_note, history=True)
        with self._changed:
            if not self._changed.wait_for(lambda: self._there, PATIENCE):
                self._session.close()
                raise FleetError(where, "is no fleet", fix)

    def next(self, timeout: float) -> bytes | None:
        """Return the newest message, each once; None if there is none after `timeout` [s]."""
        with self._changed:
            self._changed.wait_for(lambda: self._newest is not None or self._gone, timeout)
            message, self._newest = self._newest, None
            return message

    @property
    def over(self) -> bool:
        """Whether the beacon is gone, and everything that it told was taken."""
        return self._gone and self._newest is None

    def close(self) -> None:
        """Leave."""
        self._session.close()

    def _take_in(self, sample: Any) -> None:
        with self._changed:
            self._newest = bytes(sample.payload)
            self._changed.notify_all()

    def _take_note(self, sample: Any) -> None:
        with self._changed:
            if str(sample.kind).endswith("PUT"):
                self._there = True
            else:
                self._gone = True
            self._changed.notify_all()


def _endpoint(host: str, port: int) -> str:
    return f"tcp/[{host}]:{port}" if ":" in host else f"tcp/{host}:{port}"
