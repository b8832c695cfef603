"""What is built is what git tracks, and nothing else is touched. The build itself: `make dist`."""

import shutil
import subprocess
import zipfile

import build_dist
import pytest
from build_dist import BuildError, copy_files, difference, main, put, tracked


@pytest.fixture
def clone(tmp_path):
    """A repository with a tracked file, one that was removed since, one that is ignored, and one that is new."""
    if not shutil.which("git"):
        pytest.skip("there is no git")
    root = tmp_path / "clone"
    (root / "src/shoal").mkdir(parents=True)
    for name in ("src/shoal/a.py", "gone.txt"):
        (root / name).write_text(name)
    (root / ".gitignore").write_text("dist/\n")
    for words in (["init", "-q"], ["add", "."]):
        subprocess.run(["git", "-C", root, *words], check=True)
    (root / "gone.txt").unlink()
    (root / "new.txt").write_text("new")
    (root / "dist").mkdir()
    (root / "dist/old.whl").write_text("old")
    return root


@pytest.fixture
def wheel(tmp_path):
    """A function: a wheel that holds files of these names."""

    def wheel(*names):
        with zipfile.ZipFile(tmp_path / "shoal-1-py3-none-any.whl", "w") as archive:
            for name in names:
                archive.writestr(name, "")
        return tmp_path / "shoal-1-py3-none-any.whl"

    return wheel


INFO = "shoal-1.dist-info/"
LICENSES = (f"{INFO}licenses/LICENSE", f"{INFO}licenses/THIRD_PARTY.md", f"{INFO}METADATA")


class TestTracked:
    def test_files_that_git_knows_and_that_are_there(self, clone):
        assert tracked(clone) == [".gitignore", "src/shoal/a.py"]

    def test_a_folder_inside_of_a_repository_is_refused(self, clone):
        with pytest.raises(BuildError, match=r"is not the top of a git repository\n  fix: build from a clone"):
            tracked(clone / "src")

    def test_a_folder_that_is_no_repository_is_refused(self, tmp_path):
        with pytest.raises(BuildError, match=r"git knows no repository here\n  fix: "):
            tracked(tmp_path)


def test_a_copy_keeps_folders_bytes_and_modes(clone, tmp_path):
    (clone / "src/shoal/a.py").chmod(0o755)
    copy_files(clone, ["src/shoal/a.py"], tmp_path / "copy")
    copied = tmp_path / "copy/src/shoal/a.py"
    assert copied.read_text() == "src/shoal/a.py"
    assert copied.stat().st_mode & 0o777 == 0o755


class TestDifference:
    NAMES = ("README.md", "src/shoal/a.py", "src/shoal/build/b.toml")
    PACKAGE = ("shoal/a.py", "shoal/build/b.toml")

    def test_a_wheel_of_the_tracked_package_with_its_licenses_has_none(self, wheel):
        assert difference(wheel(*self.PACKAGE, *LICENSES), self.NAMES) == []

    def test_a_file_that_an_ignored_name_kept_out_is_missed(self, wheel):
        assert difference(wheel("shoal/a.py", *LICENSES), self.NAMES) == ["lacks shoal/build/b.toml"]

    def test_what_is_not_tracked_is_too_many(self, wheel):
        found = difference(wheel(*self.PACKAGE, "shoal/secret.key", *LICENSES), self.NAMES)
        assert found == ["has beside the package shoal/secret.key"]

    def test_licenses_are_missed(self, wheel):
        found = difference(wheel(*self.PACKAGE, LICENSES[0]), self.NAMES)
        assert found == ["lacks the licenses THIRD_PARTY.md"]


def test_what_was_made_takes_the_place_of_older_builds_and_of_nothing_else(tmp_path):
    made, out = tmp_path / "made", tmp_path / "dist"
    made.mkdir()
    out.mkdir()
    (made / "shoal-2.tar.gz").write_text("2")
    for name in ("shoal-1.tar.gz", "shoal-1-py3-none-any.whl", "other.txt"):
        (out / name).write_text("1")
    assert put(made, out) == [out / "shoal-2.tar.gz"]
    assert sorted(each.name for each in out.iterdir()) == ["other.txt", "shoal-2.tar.gz"]


class TestRefusals:
    """Exit code 2, one error, and what lay in the folder lies there still."""

    @pytest.fixture
    def out(self, tmp_path):
        (tmp_path / "out").mkdir()
        (tmp_path / "out/shoal-1.tar.gz").write_text("1")
        return tmp_path / "out"

    def test_a_base_that_is_no_address(self, out, capsys):
        assert main(["--base", "main", "--out", str(out)]) == 2
        assert capsys.readouterr().err.startswith("BASE: 'main' is no address")
        assert [each.name for each in out.iterdir()] == ["shoal-1.tar.gz"]

    def test_a_build_that_fails(self, out, capsys, monkeypatch, clone):
        monkeypatch.setattr(build_dist, "ROOT", clone)
        monkeypatch.setattr(build_dist.sys, "executable", "false")
        monkeypatch.setattr(build_dist, "git", lambda root, *words: str(clone) if "rev-parse" in words else "")
        assert main(["--out", str(out)]) == 2
        assert capsys.readouterr().err.startswith("build: failed")
        assert [each.name for each in out.iterdir()] == ["shoal-1.tar.gz"]
