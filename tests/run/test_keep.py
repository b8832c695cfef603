"""Which frames are kept: as many as usual, unless agents are so many that those would not fit."""

from types import SimpleNamespace

import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.run import keep
from shoal.run.keep import Keep, check_room, frame_bytes
from shoal.run.simulate import simulate

FEW = scenario(changes={"steps": 20_000})


class TestKeep:
    def test_an_overview_and_the_end(self):
        kept = Keep(FEW, None, 1, None)
        assert (kept.every, kept.tail, kept.all_runs, kept.notes) == (40, 19_700, False, [])

    def test_fewer_of_both_where_they_are_too_large_and_says_so(self, monkeypatch):
        monkeypatch.setattr(keep, "ROOM", 80 * frame_bytes(FEW))
        kept = Keep(FEW, None, 1, None)
        assert (kept.every, kept.tail) == (400, 19_970)
        assert kept.frames == 50 + 30
        assert kept.notes == [
            "a frame of 50 agents takes 0.0 MB: 80 of the first run are kept; `--every n` keeps every n-th step of all"
        ]

    def test_however_large_they_are_two_are_kept(self, monkeypatch):
        monkeypatch.setattr(keep, "ROOM", 1)
        record = simulate(scenario(changes={"steps": 30}))
        assert record.trajectories[0].step.tolist() == [0, 15]
        assert len(record.provenance["notes"]) == 1

    def test_all_of_a_short_run_say_nothing(self, monkeypatch):
        short = scenario(changes={"steps": 30})
        monkeypatch.setattr(keep, "ROOM", 30 * frame_bytes(short))
        assert Keep(short, None, 1, None).notes == []

    def test_those_asked_for_are_kept_whatever_their_size(self, monkeypatch):
        monkeypatch.setattr(keep, "ROOM", 1)
        kept = Keep(FEW, 10, 3, None)
        assert (kept.every, kept.all_runs, kept.frames, kept.notes) == (10, True, 2000, [])


class TestRoom:
    def test_frames_are_as_large_as_they_are_in_a_record(self):
        frames = simulate(scenario(changes={"steps": 7}), every=1).trajectories[0]
        assert sum(each.nbytes for each in frames.arrays().values()) == 7 * frame_bytes(FEW)

    def test_frames_that_do_not_fit_into_memory_are_refused(self, monkeypatch):
        monkeypatch.setattr(keep, "_memory", lambda: 10**9)
        check_room(1000, 10**6, None)
        with pytest.raises(ScenarioError, match=r"keeps 1,001 frames of 1.0 MB: 1.0 GB.*in memory\n.*--out"):
            check_room(1001, 10**6, None)

    def test_nor_onto_the_disk_of_a_folder_that_is_not_there_yet(self, monkeypatch, tmp_path):
        asked = []
        monkeypatch.setattr(keep.shutil, "disk_usage", lambda where: asked.append(where) or SimpleNamespace(free=10))
        with pytest.raises(ScenarioError, match="on the disk"):
            check_room(2, 6, tmp_path / "a" / "b")
        assert asked == [tmp_path]
