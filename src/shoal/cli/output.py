"""The two streams: what cannot be told on stderr is left out; a result that cannot be printed is an error."""

import os
import sys
from contextlib import suppress

from shoal.core.text import plain

CANNOT_PRINT = 1


def tell(message: str) -> None:
    """Write a line to stderr; a full or closed one never costs a result."""
    try:
        sys.stderr.write(f"shoal: {plain(message, chr(10))}\n")
        sys.stderr.flush()
    except (OSError, ValueError, AttributeError):
        silence_stderr()


def silence_stderr() -> None:
    """Drop what would go to stderr from here on."""
    sys.stderr = open(os.devnull, "w")  # noqa: SIM115  (it stays open as long as the process)


def write(text: str) -> None:
    """Write a text to stdout, as it can be shown."""
    sys.stdout.write(plain(text, "\r\n\t"))


def drop_stdout() -> None:
    """Drop what would still go to stdout, lest Python's own flush at the end fails."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
