"""The two streams: what cannot be told on stderr is left out; a result that cannot be printed is an error."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from typing import Any, TextIO, cast

from shoal.core.text import plain

CANNOT_PRINT = 1
_SPELLED = str.maketrans({"\u039e": "Xi", "\u03c6": "phi", "\u2212": "-", "\u2013": "-", "²": "^2", "³": "^3"})


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


def encodable(text: str, encoding: str) -> str:
    """The text as an encoding can hold it: signs that it lacks are spelled, in letters or as question marks."""
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return text.translate(_SPELLED).encode(encoding, "replace").decode(encoding)
    return text


class CannotPrintError(Exception):
    """A result that stdout does not take; it says why."""


class _Guarded:
    """stdout, with an error of its own: a disk may be full elsewhere, too."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        with _own_error():
            return self._stream.write(encodable(text, self._stream.encoding or "utf-8"))

    def flush(self) -> None:
        with _own_error():
            self._stream.flush()


@contextmanager
def guarded_stdout() -> Iterator[None]:
    """Let what cannot be printed raise `CannotPrintError`; a reader that leaves is still a BrokenPipeError."""
    if sys.stdout is None:
        raise CannotPrintError("standard output is closed")
    with redirect_stdout(cast(TextIO, _Guarded(sys.stdout))):
        yield
        sys.stdout.flush()


@contextmanager
def _own_error() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise CannotPrintError(error.strerror or str(error)) from error


def drop_stdout() -> None:
    """Drop what would still go to stdout, lest Python's own flush at the end fails."""
    with suppress(OSError, ValueError, AttributeError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
