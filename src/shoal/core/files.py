"""Files and folders that are complete or absent, and nothing of somebody else's that is lost for them.

What is written lies under a name that no two writers share, and takes its own when complete.
"""

import os
import re
import shutil
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import TracebackType
from typing import Self
from uuid import uuid4

from shoal.core.errors import RecordError
from shoal.core.locks import NAME as LOCK
from shoal.core.locks import FolderIsLocked, FolderLock, NoLocks

MARK = b"shoal"  # is near the begin or the end of every picture, film and page that we make
_PARTIAL = ".shoal-{}.partial"  # with a uuid
_OF_NOBODY = ("lost+found", ".DS_Store")  # a new file system is empty, too


# --- files ---


def check_file(path: str | Path, *, new: bool = False, ours: bool = False) -> Path:
    """Return where a file is written, links followed; to be called before the work whose result it holds.

    Parameters
    ----------
    new : refuse a name that is taken; else a file of this name will be replaced
    ours : refuse to replace a file that Shoal did not make

    Raises
    ------
    RecordError : none can be written there: no such folder, a folder of this name, no right or room to write
    """
    where = str(path)
    try:
        place = Path(os.path.realpath(path))
        if place.is_dir():
            raise RecordError(where, "cannot be written: it is a folder", "name a file in it")
        if not place.parent.is_dir():
            problem = f"cannot be written: there is no folder {Path(path).parent}"
            raise RecordError(where, problem, "make the folder first, or name another")
        if new and os.path.lexists(path):
            raise RecordError(where, "exists already", "name another one, or remove this one first")
        if place.exists() and not place.is_file():
            raise RecordError(where, "cannot be written: it is not a regular file", "name a file")
        if ours and place.exists() and not _is_marked(place):
            raise RecordError(
                where, "exists already, and was not made by Shoal", "name another file, or remove this one first"
            )
        with (trial := _beside(place)).open("xb"):
            trial.unlink()
    except (OSError, ValueError) as error:
        if isinstance(error, RecordError):
            raise
        raise _unwritable(where, error) from error
    return place


def _is_marked(file: Path) -> bool:
    with file.open("rb") as stream:
        head = stream.read(2**20)
        stream.seek(max(0, file.stat().st_size - 2**16))
        return MARK in (head + stream.read()).lower()


@contextmanager
def atomic_file(path: str | Path, *, new: bool = False, ours: bool = False) -> Iterator[Path]:
    """Yield a place to write to; what it holds at the end becomes the file.

    If anything else ends the block, an interrupt too, nothing is left and what was there before is untouched.

    Parameters
    ----------
    new, ours : as `check_file`

    Raises
    ------
    RecordError : as `check_file`, or the operating system refuses
    """
    place = check_file(path, new=new, ours=ours)
    partial = _beside(place)
    try:
        yield partial
        if new:
            check_file(path, new=True)  # nobody took the name meanwhile
        partial.replace(place)
    except OSError as error:
        raise _unwritable(str(path), error) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def write_atomic(path: str | Path, content: bytes, *, ours: bool = False) -> None:
    """Write a file that is either complete or absent; `ours` as `check_file`.

    Raises
    ------
    RecordError : it cannot be written
    """
    with atomic_file(path, ours=ours) as partial:
        partial.write_bytes(content)


# --- folders ---


class OwnFolder:
    """A folder that we alone write into, from `claim` to `release`; made if there is none.

    Parameters
    ----------
    path : where; a symbolic link to a folder, a mount point and "." are folders like any other
    must_lock : refuse a file system without locks; else trust that the name is ours
    """

    def __init__(self, path: str | Path, *, must_lock: bool = False) -> None:
        self._where = str(path)
        self._must_lock = must_lock
        self._made: list[Path] = []
        self._lock: FolderLock | None = None
        self.place = Path()

    def claim(self) -> None:
        """Make the folder, if need be, and keep everybody else out.

        Raises
        ------
        RecordError : it is a file, another process writes it, or the operating system refuses
        """
        try:
            self.place = Path(os.path.realpath(self._where))
            if self.place.exists() and not self.place.is_dir():
                raise RecordError(self._where, "exists already", "name another folder, or remove this one first")
            for folder in reversed([self.place, *self.place.parents]):
                if folder.exists() and not folder.is_dir():
                    raise RecordError(self._where, f"cannot be written: {folder.name} is a file", "name another folder")
                if not folder.is_dir():
                    folder.mkdir()
                    self._made.append(folder)
            lock = FolderLock(self.place)
            try:
                lock.take()
                self._lock = lock
            except FolderIsLocked as held:
                fix = "wait until it ends, or use another folder"
                raise RecordError(self._where, f"is being written by {held}", fix) from None
            except NoLocks as error:
                if self._must_lock:
                    problem = f"is on a file system that does not lock files ({error.strerror or error})"
                    raise RecordError(self._where, problem, "use a folder on a local disk") from error
        except BaseException as error:
            self.release()
            if isinstance(error, (OSError, ValueError)) and not isinstance(error, RecordError):
                raise _unwritable(self._where, error) from error
            raise

    def content(self) -> list[str]:
        """Names of what is in it, less what a writer of ours that was killed may have left."""
        return sorted(each.name for each in self.place.iterdir() if each.name not in _OF_NOBODY and not _is_ours(each))

    def clean(self) -> None:
        """Remove what writers of ours that were killed left; where locks are refused, one may live: refuse that.

        Raises
        ------
        RecordError : somebody may be writing
        """
        left = [each for each in self.place.iterdir() if _is_ours(each) and each.name != LOCK]
        if left and self._lock is None:
            problem = f"holds {left[0].name}, of a process that writes there or was killed"
            raise RecordError(self._where, problem, "name another folder, or remove this one first")
        _remove(left)

    def release(self) -> None:
        """Let others write; a folder that we made and left empty goes."""
        if self._lock is not None:
            self._lock.release()
            self._lock = None
        for folder in reversed(self._made):
            with suppress(OSError):
                folder.rmdir()
        self._made = []


def check_folder(path: str | Path, known: Iterable[str]) -> None:
    """Refuse, before the work that goes there, a folder that cannot be written, or that holds nothing but other things.

    Parameters
    ----------
    known : names of what we put there; one of them in it makes the folder ours

    Raises
    ------
    RecordError : it is somebody else's, is being written by another process, or the operating system refuses
    """
    own = OwnFolder(path)
    own.claim()
    try:
        content = own.content()
    finally:
        own.release()
    if content and not set(content) & set(known):
        raise RecordError(str(path), "is not empty, and not of this command", "name a new or empty folder")


class AtomicFolder:
    """A folder that is complete, or holds nothing of ours: write into `partial`, and `finish`.

    Parameters
    ----------
    path : where; it must be absent or empty
    last : what in it makes it valid, such as record.json: that gets its place after all else has

    Raises
    ------
    RecordError : something is there, another process writes it, or the operating system refuses
    """

    def __init__(self, path: str | Path, *, last: str) -> None:
        self._where = str(path)
        self._last = last
        self._own = OwnFolder(path)
        self._moved: list[Path] = []
        self._partial: Path | None = None

    @property
    def partial(self) -> Path:
        """The folder to write into."""
        assert self._partial is not None  # within the context
        return self._partial

    def __enter__(self) -> Self:
        self._own.claim()
        try:
            self._refuse_content(self._own.content())
            self._own.clean()
            self._partial = self._own.place / _PARTIAL.format(uuid4().hex)
            self._partial.mkdir()
        except BaseException as error:
            _remove([self._partial] if self._partial else [])
            self._own.release()
            if isinstance(error, OSError):
                raise _unwritable(self._where, error) from error
            raise
        return self

    def finish(self) -> None:
        """Give everything its place.

        Raises
        ------
        RecordError : somebody else wrote there meanwhile, or the operating system refuses
        """
        try:
            for each in sorted(self.partial.iterdir(), key=lambda each: (each.name == self._last, each.name)):
                place = self._own.place / each.name
                if os.path.lexists(place):
                    self._refuse_content([each.name])
                each.rename(place)
                self._moved.append(place)
            self.partial.rmdir()
        except OSError as error:
            raise _unwritable(self._where, error) from error
        self._moved = []

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        _remove([*reversed(self._moved), self.partial])
        self._own.release()
        if isinstance(error, OSError):
            raise _unwritable(self._where, error) from error

    def _refuse_content(self, names: list[str]) -> None:
        if names:
            raise RecordError(self._where, "exists already", "name another folder, or remove this one first")


def _remove(places: Iterable[Path]) -> None:
    for each in places:
        if each.is_dir() and not each.is_symlink():
            shutil.rmtree(each, ignore_errors=True)
        else:
            with suppress(OSError):
                each.unlink(missing_ok=True)


def _is_ours(place: Path) -> bool:
    return place.name == LOCK or re.fullmatch(r"\.shoal-[0-9a-f]{32}\.partial", place.name) is not None


def _beside(place: Path) -> Path:
    return place.with_name(_PARTIAL.format(uuid4().hex))


def _unwritable(where: str, error: Exception) -> RecordError:
    """The one error for every reason that the operating system gives."""
    reason = getattr(error, "strerror", None) or error
    return RecordError(where, f"cannot be written: {reason}", "free space, or name a place that you may write")
