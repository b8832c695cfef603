"""One process at a time in a folder."""

import errno
import os
import subprocess
import sys

import pytest

from shoal.core.locks import NAME, FolderIsLocked, FolderLock, NoLocks

HOLD = """
import sys, time
from pathlib import Path
from shoal.core.locks import FolderLock
FolderLock(Path(sys.argv[1])).take()
print("held", flush=True)
time.sleep(60)
"""


@pytest.fixture
def lock(tmp_path):
    lock = FolderLock(tmp_path)
    lock.take()
    yield lock
    lock.release()


def test_nobody_else_gets_it_and_all_are_told_who_has_it(tmp_path, lock):
    with pytest.raises(FolderIsLocked, match=f"^process {os.getpid()}$"):
        FolderLock(tmp_path).take()


def test_it_leaves_nothing_and_can_be_taken_again(tmp_path, lock):
    lock.release()
    assert list(tmp_path.iterdir()) == []
    other = FolderLock(tmp_path)
    other.take()
    other.release()


def test_one_who_opened_it_before_it_was_removed_does_not_hold_a_second_one(tmp_path, lock, monkeypatch):
    """Opened, then removed by its holder, then locked: what is locked is no longer the lock of the folder."""
    stat, late = os.fstat, []

    def removed_just_before(held):
        if not late:
            late.append((tmp_path / NAME).unlink())
        return stat(held)

    lock.release()
    monkeypatch.setattr(os, "fstat", removed_just_before)
    other = FolderLock(tmp_path)
    other.take()
    monkeypatch.undo()
    with pytest.raises(FolderIsLocked):
        FolderLock(tmp_path).take()
    other.release()


def test_that_of_a_killed_process_can_be_taken(tmp_path):
    holder = subprocess.Popen([sys.executable, "-c", HOLD, str(tmp_path)], stdout=subprocess.PIPE, text=True)
    assert holder.stdout.readline() == "held\n"
    with pytest.raises(FolderIsLocked, match=f"^process {holder.pid}$"):
        FolderLock(tmp_path).take()
    holder.kill()
    holder.communicate()
    mine = FolderLock(tmp_path)
    mine.take()
    mine.release()
    assert list(tmp_path.iterdir()) == []


def test_a_file_system_without_locks_says_so_and_keeps_nothing(tmp_path, monkeypatch):
    def refuse(held, how):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr("fcntl.flock", refuse)
    with pytest.raises(NoLocks, match="No locks available"):
        FolderLock(tmp_path).take()
    assert list(tmp_path.iterdir()) == []
