"""A mesh of zenoh peers: no router, no broker. The only file that imports zenoh (extra: fleet)."""

import atexit
import json
import secrets
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from shoal.buoy.address import free_port, is_free
from shoal.buoy.mesh import MOST, awaited
from shoal.core.errors import FleetError, MissingExtraError

ANY = "shoal/*"  # the name of every mesh
_PATIENCE = 60_000  # milliseconds in which a busy machine may open a link
_ANSWERS = 1.0  # seconds in which who is asked answers
_BATCH = 2048  # bytes of a packet: each message that waits to be taken holds on to one
_BATCHES = 16  # packets that wait for a link, the most that zenoh can have: a step's reports of many buoys
_HOLD_UP = 20_000  # microseconds in which a busy link takes a message; then it is lost there, as are all until it does
_TRIES = 20  # to listen at a free port, which others may take first
_RETRY = {"period_init_ms": 200, "period_max_ms": 2_000, "period_increase_factor": 1.5}  # of links that broke, too


class ZenohMesh:
    """A node of a mesh over TCP: it listens, and connects to the nodes that it is told of, again when a link breaks.

    It hears and speaks from the start, and is there for the others when it joins.

    No node passes on what another says: each pair needs a link, so that one of the two is told of the other.

    Parameters
    ----------
    fleet : what the mesh is called; those of another name are not heard. ANY : of a guest, who hears all
    node : what this node is called; None: a guest, who is no node, and gives orders and hears answers only
    connect : addresses of nodes to connect to, such as tcp/127.0.0.1:7447; they need not be there yet
    listen : address to listen at; the default can be reached from this machine only, on a free port
    blocks : whether `publish` waits where a link is slow, so that nothing is lost; else it is lost there
    config : file of zenoh's own configuration, such as certificates; what is said above counts more
    hears : whether it listens to reports and orders; else it only speaks

    Attributes
    ----------
    place : where it listens, such as tcp/127.0.0.1:7447

    Raises
    ------
    MissingExtraError : zenoh is not installed
    FleetError : an address or the configuration cannot be used
    """

    def __init__(
        self,
        fleet: str,
        node: str | None,
        *,
        connect: Sequence[str] = (),
        listen: str = "tcp/127.0.0.1:0",
        blocks: bool = True,
        config: str | Path | None = None,
        hears: bool = True,
    ) -> None:
        zenoh = _zenoh("a mesh between processes")
        wanted: dict[str, Any] = {
            "connect/timeout_ms": -1,  # try for ever
            "connect/exit_on_failure": False,
            "open/return_conditions/connect_scouted": False,  # half a second, in which others wait for us
            "open/return_conditions/declares": False,
            "connect/retry": _RETRY,
            "transport/unicast/open_timeout": _PATIENCE,
            "transport/unicast/accept_timeout": _PATIENCE,
            "transport/link/tx/batch_size": _BATCH,
            "transport/link/tx/queue/size/real_time": _BATCHES,
            "transport/link/tx/queue/size/data": _BATCHES,
            "transport/link/tx/queue/congestion_control/drop/wait_before_drop": _HOLD_UP,
        }
        room = MOST if blocks else MOST // 4
        self._nodes: set[str] = set()
        self._order_key = f"{fleet}/orders"
        self._clocks, self._node = f"{fleet}/clock", node
        self._name = f"{fleet}/alive/{node}/{time.time_ns():020}-{secrets.token_hex(4)}"  # in order of time
        self._token: Any = None
        self._told = self._heard = None
        try:
            self._session, (self.place,) = _opened(zenoh, [listen], connect, wanted, config)
            atexit.register(self.close)  # Python would wait for its threads for ever
            if hears:
                self._told = self._session.declare_subscriber(self._order_key, zenoh.handlers.RingChannel(room))
            if hears and node is not None:
                self._heard = self._session.declare_subscriber(f"{fleet}/reports", zenoh.handlers.RingChannel(room))
            self._publisher = self._session.declare_publisher(
                f"{fleet}/reports",
                congestion_control=zenoh.CongestionControl.BLOCK if blocks else zenoh.CongestionControl.DROP,
                priority=zenoh.Priority.REAL_TIME,
                express=True,
            )
            self._watch = self._session.liveliness().declare_subscriber(
                f"{fleet}/alive/*/*", self._take_note, history=True
            )
        except zenoh.ZError as error:
            where = ", ".join([listen, *connect])
            problem = f"cannot be a mesh: {_words(error)}"
            raise FleetError(where, problem, "give addresses such as tcp/127.0.0.1:7447 that are free") from None

    def join(self) -> None:
        """Be there for the others, from now on."""
        if self._token is None:
            self._token = self._session.liveliness().declare_token(self._name)

    def _take_note(self, sample: Any) -> None:
        """Somebody came, or is gone."""
        name = str(sample.key_expr)
        if str(sample.kind).endswith("PUT"):
            self._nodes.add(name)
        else:
            self._nodes.discard(name)

    def publish(self, data: bytes) -> None:
        """Send a message to all who are there."""
        self._publisher.put(data)

    def take(self, timeout: float) -> list[bytes]:
        """Return what arrived since the last call, a batch at most; if nothing did, wait for it up to `timeout` [s]."""
        return awaited(lambda: _next_of(self._heard), timeout)

    def order(self, data: bytes) -> None:
        """Send an order, or an answer to one, to all who are there."""
        self._session.put(self._order_key, data)

    def orders(self, timeout: float) -> list[bytes]:
        """Return the orders and answers that arrived since the last call, as `take` does."""
        return awaited(lambda: _next_of(self._told), timeout)

    def fleets(self) -> set[str]:
        """Return the names of the meshes whose nodes are there."""
        return {name.partition("/alive/")[0] for name in self._nodes.copy()}

    def alive(self) -> int:
        """Return how many nodes are there, this one included."""
        return len(self.nodes())

    def nodes(self) -> set[str]:
        """Return who is there, this node included if it joined."""
        return {name.rsplit("/", 2)[1] for name in self._nodes.copy()}

    def namesakes(self) -> tuple[int, int]:
        """Return how many others of this node's name came before it, and after it: all before, if it did not join."""
        own = self._name.rpartition("/")[0] + "/"
        others = [name for name in self._nodes.copy() if name.startswith(own) and name != self._name]
        before = sum(self._token is None or name < self._name for name in others)
        return before, len(others) - before

    def answer(self, how: Callable[[], bytes]) -> None:
        """Answer whoever asks with what this function returns, in any thread."""
        where = f"{self._clocks}/{self._node}"
        self._clock = self._session.declare_queryable(where, lambda query: query.reply(query.key_expr, how()))

    def ask(self, node: str, answered: Callable[[bytes], None]) -> None:
        """Ask a node; its answer goes to this function, in any thread, if one ever comes."""

        def take(reply: Any) -> None:
            if reply.ok is not None:
                answered(bytes(reply.ok.payload))

        self._session.get(f"{self._clocks}/{node}", take, timeout=_ANSWERS)

    def close(self) -> None:
        """Leave."""
        atexit.unregister(self.close)
        if not self._session.is_closed():
            self._session.close()


def _next_of(heard: Any) -> bytes | None:
    sample = None if heard is None else heard.try_recv()
    return None if sample is None else bytes(sample.payload)


def open_peer(listen: Sequence[str], connect: Sequence[str], patience: float, purpose: str) -> tuple[Any, list[str]]:
    """Open a session of a peer that is no node of a mesh: nobody waits for it, and it passes nothing on.

    Parameters
    ----------
    listen, connect : addresses, such as tcp/127.0.0.1:7447
    patience : time that the others have to answer [s]
    purpose : what needs it, for the error of a missing library

    Returns
    -------
    the session, and where it listens

    Raises
    ------
    MissingExtraError : zenoh is not installed
    OSError : it cannot listen there, or nobody answers
    """
    zenoh = _zenoh(purpose)
    limit = round(1000 * patience)
    wanted = {
        "connect/timeout_ms": limit,
        "connect/exit_on_failure": True,
        "connect/retry": {**_RETRY, "period_max_ms": 500},
        "transport/unicast/open_timeout": limit,
    }
    try:
        session, places = _opened(zenoh, listen, connect, wanted)
    except zenoh.ZError as error:
        raise OSError(_words(error)) from None
    atexit.register(session.close)  # Python would wait for its threads for ever
    return session, places


def _opened(
    zenoh: Any, listen: Sequence[str], connect: Sequence[str], more: dict[str, Any], config: str | Path | None = None
) -> tuple[Any, list[str]]:
    """A session, and where it listens: for port 0 at a free one, and at another if somebody takes that meanwhile."""
    for left in reversed(range(_TRIES)):
        places = [_at_free_port(each) for each in listen]
        settings = _settings(places, connect, more, config)
        try:
            return zenoh.open(settings), places
        except zenoh.ZError:
            chosen = set(places) - set(listen)
            if left == 0 or all(is_free(*_host_and_port(each)) for each in chosen):
                raise
    raise AssertionError


def _at_free_port(place: str) -> str:
    host, port = _host_and_port(place)
    return place if port else f"{place.removesuffix('0')}{free_port(host)}"


def _host_and_port(place: str) -> tuple[str, int]:
    """Of tcp/[::1]:7447, ::1 and 7447; port 1 where there is none to choose."""
    host, _, port = place.partition("/")[2].rpartition(":")
    return host.strip("[]"), int(port) if port.isdecimal() else 1


def _zenoh(purpose: str) -> Any:
    try:
        import zenoh
    except ModuleNotFoundError:
        raise MissingExtraError.of("zenoh", "fleet", purpose) from None
    return zenoh


def _settings(
    listen: Sequence[str], connect: Sequence[str], more: dict[str, Any], config: str | Path | None = None
) -> Any:
    """The configuration of a peer that finds nobody by itself."""
    settings = _configured(config)
    wanted: dict[str, Any] = {
        "mode": "peer",
        "listen/endpoints": list(listen),
        "connect/endpoints": list(connect),
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": False,
        "transport/shared_memory/enabled": False,  # who is killed would leave it behind; a network is what is meant
        **more,
    }
    for path, value in wanted.items():
        settings.insert_json5(path, json.dumps(value))
    return settings


def _words(error: Exception) -> str:
    return " ".join(str(error).split())[:200]


def protocol_of(config: str | Path | None) -> str:
    """Return how the links of a mesh with this configuration go: by tls if it has certificates, else by tcp.

    Raises
    ------
    MissingExtraError : zenoh is not installed
    FleetError : the configuration cannot be used
    """
    _zenoh("a mesh between processes")
    if config is None:
        return "tcp"
    tls = json.loads(_configured(config).get_json("transport/link/tls")) or {}
    return "tls" if any(tls.get(f"{name}_certificate") for name in ("root_ca", "listen", "connect")) else "tcp"


def _configured(config: str | Path | None) -> Any:
    zenoh = _zenoh("a mesh between processes")
    if config is None:
        return zenoh.Config()
    try:
        return zenoh.Config.from_file(str(config))
    except zenoh.ZError as error:
        problem = f"is no configuration of zenoh: {' '.join(str(error).split())[:200]}"
        raise FleetError(str(config), problem, "see docs/how-to/fleet.md for one") from None
