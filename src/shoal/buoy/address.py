"""HOST:PORT, as commands take it."""

import re

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
