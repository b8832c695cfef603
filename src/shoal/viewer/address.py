"""Where the server is reached: the socket it listens on, and the names under which browsers may ask for it."""

import errno
import ipaddress
import os
import re
import socket
from typing import Any

from shoal.core.errors import ShoalError

LOCAL = "127.0.0.1"
_HOST = re.compile(r"(?:\[(?P<inside>[^\[\]]+)\]|(?P<name>[^\[\]:]+))(?::[0-9]{1,5})?")  # a Host header
ANYWHERE = {"0.0.0.0": LOCAL, "::": "::1"}  # to listen at all addresses of this machine, and one of them


class Guard:
    """Lets requests in that name an address we serve on, and WebSockets of pages that came from there.

    The first keeps out names that an attacker points at this machine (DNS rebinding), the second other pages.
    """

    def __init__(self, app: Any, names: frozenset[str] | None) -> None:
        self._app = app
        self._names = names

    async def __call__(self, scope: Any, receive: Any, send: Any) -> None:
        """Pass a request on, or answer 403."""
        headers = {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}
        host, origin = headers.get("host", ""), headers.get("origin")
        if self._knows(host) and (origin is None or origin == f"http://{host}"):
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await send({"type": "websocket.close", "code": 1008})  # before it is accepted: answers 403
        else:
            plain = [(b"content-type", b"text/plain")]
            await send({"type": "http.response.start", "status": 403, "headers": plain})
            await send({"type": "http.response.body", "body": b"not served under this name\n"})

    def _knows(self, host: str) -> bool:
        parts = _HOST.fullmatch(host)
        if not parts:
            return False
        name = (parts["inside"] or parts["name"]).lower()
        return name in self._names if self._names is not None else name == "localhost" or _is_address(name)


def names_of(host: str) -> frozenset[str] | None:
    """Names under which a server on `host` may be asked; None: any IP address, since it serves on all of ours."""
    if host in ANYWHERE:
        return None
    return frozenset([host.lower(), *(["localhost", LOCAL, "::1"] if is_local(host) else [])])


def reachable(host: str) -> str:
    """How an address of this machine spells where a server on `host` is."""
    name = ANYWHERE.get(host, host)
    return f"[{name}]" if ":" in name else name


def is_local(host: str) -> bool:
    """Whether only this machine can reach a server on `host`."""
    return host.lower() == "localhost" or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def listen(host: str, port: int, option: str = "--port") -> socket.socket:
    """Return a socket that listens at an address; port 0 is a free one. `option` says what the user calls the port.

    Raises
    ------
    ShoalError : the address cannot be had
    """
    if not 0 <= port <= 65535:
        raise ShoalError(option, f"is {port}", "give a number from 0 (a free one) to 65535")
    try:
        family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
    except (OSError, UnicodeError):
        raise ShoalError("--host", f"{host!r} is not an address of this machine", f"leave it out for {LOCAL}") from None
    listener = socket.socket(family, socket.SOCK_STREAM)
    try:
        if os.name == "posix":  # elsewhere it would share the port with whoever has it
            listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        listener.bind((host, port))
        listener.listen(64)
    except OSError as error:
        listener.close()
        if error.errno == errno.EADDRNOTAVAIL:
            raise ShoalError(
                "--host", f"{host!r} is not an address of this machine", f"leave it out for {LOCAL}"
            ) from None
        problem = "is in use" if error.errno == errno.EADDRINUSE else f"cannot be had: {error.strerror}"
        raise ShoalError(f"{option} {port}", problem, "name another, or 0 for a free one") from None
    return listener
