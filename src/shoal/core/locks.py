"""One process at a time in a folder: a lock that the operating system takes back however its holder ends."""

import os
from contextlib import suppress
from pathlib import Path
from typing import Any

NAME = ".shoal.lock"  # there while the lock is held, and after a kill until it is taken again

_fcntl: Any  # absent on Windows
try:
    import fcntl as _fcntl
except ImportError:
    _fcntl = None


class FolderIsLocked(Exception):  # noqa: N818  (the caller says what it means)
    """Somebody else holds the lock; its text says who."""


class NoLocks(OSError):  # noqa: N818
    """The file system refuses locks, as some network file systems do."""


class FolderLock:
    """The lock of a folder, from `take` to `release`."""

    def __init__(self, folder: Path) -> None:
        self._file = folder / NAME
        self._held: int | None = None

    def take(self) -> None:
        """Take the lock, without waiting.

        Raises
        ------
        FolderIsLocked : another process or thread holds it
        NoLocks : the file system has none
        OSError : the folder cannot be written
        """
        while True:
            held = _open(self._file)
            if _is_at(held, self._file):  # else its last holder removed it between our opening and locking it
                break
            os.close(held)
        self._held = held
        os.ftruncate(held, 0)
        os.write(held, f"process {os.getpid()}\n".encode())

    def release(self) -> None:
        """Give it back; nothing is left of it."""
        if self._held is not None:
            with suppress(OSError):
                self._file.unlink()  # while we hold it: nobody else can have taken it
            os.close(self._held)
            self._held = None


def _open(file: Path) -> int:
    if _fcntl is None:
        return _open_on_windows(file)
    held = os.open(file, os.O_RDWR | os.O_CREAT | getattr(os, "O_CLOEXEC", 0), 0o666)
    try:
        _fcntl.flock(held, _fcntl.LOCK_EX | _fcntl.LOCK_NB)
    except BlockingIOError:
        who = os.read(held, 100).decode(errors="replace").strip()
        os.close(held)
        raise FolderIsLocked(who or "another process") from None
    except OSError as error:
        os.close(held)
        with suppress(OSError):
            file.unlink()  # it is worth nothing here
        raise NoLocks(*error.args) from error
    except BaseException:
        os.close(held)
        raise
    return held


def _open_on_windows(file: Path) -> int:
    """A file that only one process can make, and that goes with it."""
    try:
        return os.open(file, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_TEMPORARY", 0))
    except (FileExistsError, PermissionError):
        raise FolderIsLocked("another process") from None


def _is_at(held: int, file: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(held), file.stat())
    except FileNotFoundError:
        return False
