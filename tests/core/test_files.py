"""Files and folders are whole or not there, and nothing of others is lost for them."""

import errno
import os
from pathlib import Path

import pytest

from shoal.core.errors import RecordError
from shoal.core.files import AtomicFolder, OwnFolder, atomic_file, check_file, check_folder, write_atomic


def left_in(folder):
    return sorted(path.name for path in folder.iterdir())


def refusal(action, *args, **options):
    """(where, problem) of the error."""
    with pytest.raises(RecordError) as caught:
        action(*args, **options)
    return caught.value.args[:2]


def no_locks(held, how):
    raise OSError(errno.ENOLCK, "No locks available")


class TestWriteWhole:
    """At once, or not at all."""

    def test_it_replaces_a_file_of_its_name(self, tmp_path):
        file = tmp_path / "run.html"
        file.write_text("old")
        write_atomic(file, b"new")
        assert file.read_text() == "new"
        assert list(tmp_path.iterdir()) == [file]

    def test_behind_a_link_too(self, tmp_path):
        (tmp_path / "file").write_text("old")
        (tmp_path / "link").symlink_to("file")
        write_atomic(tmp_path / "link", b"new")
        assert (tmp_path / "link").is_symlink()
        assert (tmp_path / "file").read_text() == "new"

    @pytest.mark.parametrize("end", [KeyboardInterrupt, ValueError])
    def test_whatever_ends_the_writing_leaves_what_was_there(self, tmp_path, end):
        file = tmp_path / "run.mp4"
        file.write_text("old")

        def interrupted():
            with atomic_file(file) as partial:
                partial.write_text("half")
                raise end

        with pytest.raises(end):
            interrupted()
        assert file.read_text() == "old"
        assert list(tmp_path.iterdir()) == [file]

    def test_a_name_that_somebody_took_meanwhile_is_theirs(self, tmp_path):
        def taken_meanwhile():
            with atomic_file(tmp_path / "swarm.nc", new=True) as partial:
                partial.write_text("ours")
                (tmp_path / "swarm.nc").write_text("theirs")

        assert refusal(taken_meanwhile)[1] == "exists already"
        assert (tmp_path / "swarm.nc").read_text() == "theirs"
        assert left_in(tmp_path) == ["swarm.nc"]

    def test_two_writers_of_one_name_do_not_mix(self, tmp_path):
        with atomic_file(tmp_path / "x") as one, atomic_file(tmp_path / "x") as two:
            assert one != two
            one.write_text("one")
            two.write_text("two")
        assert (tmp_path / "x").read_text() in ("one", "two")


class TestCheckFile:
    """Where nothing can be written is known before the work."""

    def test_places(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)
        (tmp_path / "folder").mkdir()
        (tmp_path / "link").symlink_to("folder")
        (tmp_path / "file").write_text("mine")
        os.mkfifo(tmp_path / "pipe")
        for place, problem in {
            "": "it is a folder", ".": "it is a folder", "/": "it is a folder", "..": "it is a folder",
            "folder": "it is a folder", "link": "it is a folder", "nowhere/x.png": "there is no folder nowhere",
            "file/x.png": "there is no folder file", "pipe": "it is not a regular file",
            "/dev/null": "it is not a regular file",
            "x" * 300: "File name too long", "x" * 5000: "File name too long", "a\0b": "null", "/proc/x.png": "",
        }.items():  # fmt: skip
            where, said = refusal(check_file, Path(place))
            assert where == str(Path(place))
            assert said.startswith("cannot be written: ")
            assert problem in said
        assert left_in(tmp_path) == ["file", "folder", "link", "pipe"]

    def test_a_good_place_stays_as_it_is(self, tmp_path):
        for name in ("x.png", "x" * 255, "ü.png"):
            check_file(tmp_path / name)
        (tmp_path / "dangling").symlink_to("target")
        assert check_file(tmp_path / "dangling") == tmp_path / "target"
        assert left_in(tmp_path) == ["dangling"]

    def test_only_files_of_shoal_are_replaced_where_that_is_asked_for(self, tmp_path):
        (tmp_path / "photo.png").write_bytes(b"of my dog" * 10)
        assert refusal(check_file, tmp_path / "photo.png", ours=True)[1] == "exists already, and was not made by Shoal"
        (tmp_path / "old.png").write_bytes(b"\x89PNG Software Shoal 0.1" + bytes(2_000_000))
        (tmp_path / "old.pdf").write_bytes(b"%PDF" + bytes(2_000_000) + b"Creator (shoal 0.1)")
        check_file(tmp_path / "old.png", ours=True)
        check_file(tmp_path / "old.pdf", ours=True)


def write(path):
    with AtomicFolder(path, last="b") as folder:
        for name in "abc":
            (folder.partial / name).write_text(name)
        folder.finish()


class TestWholeFolder:
    """All of it, or nothing."""

    @pytest.mark.parametrize("place", ["new", "on/the/way", "empty", "link", "dangling", "new/", "."])
    def test_places(self, tmp_path, place, monkeypatch):
        (tmp_path / "cwd").mkdir()
        monkeypatch.chdir(tmp_path / "cwd")
        where = Path(place)
        if place in ("empty", "link"):
            Path("empty").mkdir()
        if place in ("link", "dangling"):
            where.symlink_to("empty" if place == "link" else "new")
        write(where)
        assert left_in(where) == ["a", "b", "c"]

    def test_a_new_file_system_is_empty(self, tmp_path):
        (tmp_path / "lost+found").mkdir()
        write(tmp_path)
        assert left_in(tmp_path) == ["a", "b", "c", "lost+found"]

    @pytest.mark.parametrize("end", [KeyboardInterrupt, ValueError, OSError])
    def test_whatever_ends_it_leaves_nothing(self, tmp_path, end):
        (tmp_path / "empty").mkdir()

        def interrupted(place):
            with AtomicFolder(place, last="b") as folder:
                (folder.partial / "a").write_text("half")
                raise end

        for place in ("empty", "on/the/way"):
            with pytest.raises(RecordError if end is OSError else end):
                interrupted(tmp_path / place)
        assert left_in(tmp_path) == ["empty"]
        assert left_in(tmp_path / "empty") == []

    def test_what_makes_it_valid_comes_last(self, tmp_path, monkeypatch):
        rename, moved = Path.rename, []

        def full_disk(self, place):
            moved.append(self.name)
            if self.name == "b":
                raise OSError(errno.ENOSPC, "No space left on device")
            return rename(self, place)

        monkeypatch.setattr(Path, "rename", full_disk)
        assert "No space left" in refusal(write, tmp_path / "new")[1]
        assert moved == ["a", "c", "b"]
        assert left_in(tmp_path) == []

    def test_a_file_that_somebody_put_there_meanwhile_is_theirs(self, tmp_path):
        def taken_meanwhile():
            with AtomicFolder(tmp_path / "new", last="b") as folder:
                (folder.partial / "a").write_text("ours")
                (folder.partial / "b").write_text("ours")
                (tmp_path / "new" / "b").write_text("theirs")
                folder.finish()

        assert refusal(taken_meanwhile)[1] == "exists already"
        assert left_in(tmp_path / "new") == ["b"]
        assert (tmp_path / "new" / "b").read_text() == "theirs"

    def test_a_second_writer_is_refused(self, tmp_path):
        with AtomicFolder(tmp_path / "new", last="b"):
            assert refusal(write, tmp_path / "new")[1] == f"is being written by process {os.getpid()}"
        write(tmp_path / "new")

    def test_without_locks_too(self, tmp_path, monkeypatch):
        monkeypatch.setattr("fcntl.flock", no_locks)
        with AtomicFolder(tmp_path / "new", last="b"):
            assert "of a process that writes there or was killed" in refusal(write, tmp_path / "new")[1]
        write(tmp_path / "new")
        assert left_in(tmp_path / "new") == ["a", "b", "c"]

    @pytest.mark.parametrize("place", ["/dev/null", "/", "/proc/shoal", "file", "file/x", "full", "x" * 300, "a\0b"])
    def test_places_where_it_cannot_be(self, tmp_path, place):
        (tmp_path / "file").write_text("mine")
        (tmp_path / "full").mkdir()
        (tmp_path / "full" / "thesis.partial").write_text("mine")
        where, problem = refusal(write, tmp_path / place)
        assert where == str(tmp_path / place)
        assert problem == "exists already" or problem.startswith("cannot be written: ")
        assert left_in(tmp_path) == ["file", "full"]
        assert left_in(tmp_path / "full") == ["thesis.partial"]


class TestOwnFolder:
    def test_a_file_system_that_must_lock_and_does_not_is_refused(self, tmp_path, monkeypatch):
        monkeypatch.setattr("fcntl.flock", no_locks)
        own = OwnFolder(tmp_path / "new", must_lock=True)
        assert "does not lock files (No locks available)" in refusal(own.claim)[1]
        assert left_in(tmp_path) == []


class TestCheckFolder:
    """For those who put several things there, one after the other."""

    def test_absent_empty_or_ours_is_fine_and_stays_as_it_is(self, tmp_path):
        check_folder(tmp_path / "new", ["runs"])
        check_folder(tmp_path, ["runs"])
        (tmp_path / "runs").mkdir()
        (tmp_path / "notes.txt").write_text("about them")
        check_folder(tmp_path, ["runs"])
        assert left_in(tmp_path) == ["notes.txt", "runs"]

    def test_a_folder_of_other_things_is_not(self, tmp_path):
        (tmp_path / "report.html").write_text("mine")
        assert "is not empty" in refusal(check_folder, tmp_path, ["runs"])[1]
