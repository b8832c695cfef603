"""Who compiles which part in a cold start: nobody what another has taken, and nobody waits for one that died."""

import os
import time

import pytest

from shoal.engine import ahead, phases


class Made:
    """A part that is there once it is compiled, here or, at a later look, by another process."""

    def __init__(self, name, log, looks=None):
        self.name, self.log, self.looks = name, log, looks

    def is_kept(self):
        if self.looks is not None:
            self.looks -= 1
        return self.name in self.log or (self.looks is not None and self.looks <= 0)

    def address(self):
        self.log.append(self.name)


class Others:
    """Other processes."""

    def __init__(self, folder, lives):
        self.folder, self.lives = folder, lives

    def are_there(self):
        self.lives -= 1
        return self.lives > 0


@pytest.fixture
def started(monkeypatch):
    """Start processes that live for so many looks."""

    def start(folder, lives):
        monkeypatch.setattr(ahead, "_started", [Others(folder, lives)])

    monkeypatch.setattr(ahead, "_under_way", [])
    monkeypatch.setattr(ahead, "_started", [])
    return start


def test_alone_all_is_compiled_here_the_longest_first(started):
    log = []
    parts = [Made(name, log) for name in ("settle", "link", "move_agents", "measure")]
    ahead._under_way[:] = parts
    assert ahead.how_far() == (0, 4)
    ahead.compile_all(parts)
    assert log == ["move_agents", "link", "measure", "settle"]
    assert ahead.how_far() is None


def test_few_parts_are_left_to_the_caller(started):
    log = []
    ahead.compile_ahead([Made("link", log), Made("settle", log)])
    ahead.compile_all([Made("link", log)])
    assert log == []


def test_what_another_has_taken_is_waited_for(started, tmp_path):
    log = []
    started(tmp_path, 10**6)
    taken = Made("link", log, looks=5)
    (tmp_path / "link").touch()
    ahead.compile_all([taken, Made("settle", log)])
    assert log == ["settle"]
    assert taken.looks <= 0


def test_but_not_of_one_that_died(started, tmp_path):
    log = []
    started(tmp_path, 3)
    (tmp_path / "link").touch()
    ahead.compile_all([Made("link", log), Made("settle", log)])
    assert log == ["settle"]


def test_nor_for_ever(started, tmp_path, monkeypatch):
    log = []
    started(tmp_path, 10**6)
    monkeypatch.setattr(ahead, "PATIENCE", 0.05)
    (tmp_path / "link").touch()
    ahead.compile_all([Made("link", log)])
    assert log == []


def test_another_process_compiles_what_nobody_has_taken_and_the_last_one_clears_up(tmp_path, monkeypatch):
    log, folder = [], tmp_path / "compiling-1"
    folder.mkdir()
    (folder / "link").touch()
    for name in ("link", "settle", "measure"):
        monkeypatch.setattr(phases, name, Made(name, log))
    ahead.help_compiling(str(folder), ["link", "settle"], 2)
    assert log == ["settle"]
    assert folder.is_dir()
    monkeypatch.setattr(os, "getpid", lambda: 1)
    ahead.help_compiling(str(folder), ["measure"], 2)
    assert log == ["settle", "measure"]
    assert not folder.exists()
    ahead.help_compiling(str(folder), ["link"], 1)  # nobody waits
    assert log == ["settle", "measure"]


def test_one_cold_start_at_a_time_and_what_a_killed_one_left_is_removed(tmp_path, monkeypatch):
    monkeypatch.setattr(ahead, "cache_folder", lambda: tmp_path)
    assert not ahead._others_are_at_it()
    (tmp_path / "compiling-1").mkdir()
    assert ahead._others_are_at_it()
    old = time.time() - ahead.LONGEST - 1.0
    os.utime(tmp_path / "compiling-1", (old, old))
    assert not ahead._others_are_at_it()
    assert not list(tmp_path.iterdir())
