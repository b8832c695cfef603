"""HOST:PORT, as commands take it, and ports that are free."""

import re
import socket
from contextlib import suppress

from shoal.core.errors import FleetError
from shoal.core.text import quoted


def host_and_port(text: str, option: str, *, free: bool = False) -> tuple[str, int]:
    """Return the parts of an address; IPv6 is in brackets, [::1]:7447.

    Parameters
    ----------
    text : HOST:PORT; option : of the command line, for errors
    free : whether port 0, a free one, is an address

    Raises
    ------
    FleetError : it is none
    """
    host, _, port = text.rpartition(":")
    bare = host[1:-1] if host.startswith("[") and host.endswith("]") else host
    named = re.fullmatch(r"[0-9A-Za-z._%-]+", host) or (bare != host and re.fullmatch(r"[0-9A-Fa-f:.%a-z]+", bare))
    if not named or not re.fullmatch(r"[0-9]{1,5}", port) or not (0 if free else 1) <= int(port) < 65536:
        raise FleetError(option, f"is {quoted(text)}", "give HOST:PORT, such as 127.0.0.1:7447")
    return bare, int(port)


def free_port(host: str) -> int:
    """Return a port that nobody listens at now, but may at any time; 0 where there can be none.

    Parameters
    ----------
    host : name or address of this machine
    """
    with suppress(OSError, UnicodeError), _bound(host, 0) as trial:
        return int(trial.getsockname()[1])
    return 0


def is_free(host: str, port: int) -> bool:
    """Return whether nobody has a port now.

    Parameters
    ----------
    host, port : name or address of this machine, and number of the port
    """
    with suppress(OSError, UnicodeError), _bound(host, port):
        return True
    return False


def _bound(host: str, port: int) -> socket.socket:
    family = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0][0]
    trial = socket.socket(family, socket.SOCK_STREAM)
    try:
        trial.bind((host, port))
    except OSError:
        trial.close()
        raise
    return trial
