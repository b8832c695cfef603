"""No folder that somebody else could have written is read."""

import os
import subprocess
import sys

import pytest

from shoal.compiler.private import make_private, strangers

pytestmark = pytest.mark.skipif(not hasattr(os, "geteuid"), reason="owners and modes are those of POSIX")

CACHE = "from shoal.compiler.kernel import cache_folder, why_uncached; print(cache_folder()); print(why_uncached())"


def cache_of(**environment):
    """The cache's folder, and why it is not kept, in a process of its own."""
    environment = {name: str(value) for name, value in environment.items()}
    done = subprocess.run(
        [sys.executable, "-c", CACHE], capture_output=True, text=True, check=True, env={**os.environ, **environment}
    )
    folder, why = done.stdout.splitlines()
    return folder, why


class TestMakePrivate:
    def test_makes_the_folder_and_its_parents_for_us_alone(self, tmp_path):
        folder = tmp_path / "a" / "b"
        old = os.umask(0)
        try:
            make_private(folder)
        finally:
            os.umask(old)
        assert [each.stat().st_mode & 0o777 for each in (folder, folder.parent)] == [0o700, 0o700]

    def test_takes_its_own_again(self, tmp_path):
        make_private(tmp_path / "a")
        make_private(tmp_path / "a")

    @pytest.mark.parametrize("mode", [0o777, 0o770, 0o755, 0o701])
    def test_refuses_one_that_is_not_private(self, mode, tmp_path):
        folder = tmp_path / "a"
        folder.mkdir()
        folder.chmod(mode)
        with pytest.raises(PermissionError, match="is not private"):
            make_private(folder)

    def test_refuses_a_link_even_to_a_private_one(self, tmp_path):
        make_private(tmp_path / "a")
        (tmp_path / "b").symlink_to(tmp_path / "a")
        with pytest.raises(PermissionError, match="is a link"):
            make_private(tmp_path / "b")

    def test_refuses_one_that_others_can_replace(self, tmp_path):
        make_private(tmp_path / "open" / "a")
        (tmp_path / "open").chmod(0o777)
        assert "open can be written by others" in strangers(tmp_path / "open" / "a")

    def test_takes_one_in_a_sticky_folder_where_each_keeps_their_own(self, tmp_path):
        make_private(tmp_path / "open" / "a")
        (tmp_path / "open").chmod(0o1777)
        assert strangers(tmp_path / "open" / "a") is None

    def test_refuses_one_behind_a_link_that_others_can_replace(self, tmp_path):
        make_private(tmp_path / "real" / "a")
        (tmp_path / "open").mkdir()
        (tmp_path / "open" / "link").symlink_to(tmp_path / "real")
        (tmp_path / "open").chmod(0o777)
        assert "open can be written by others" in strangers(tmp_path / "open" / "link" / "a")

    @pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can give files away")
    def test_refuses_what_belongs_to_somebody_else(self, tmp_path):
        make_private(tmp_path / "theirs" / "a")
        os.chown(tmp_path / "theirs" / "a", 65534, 65534)
        assert "is not private" in strangers(tmp_path / "theirs" / "a")
        os.chown(tmp_path / "theirs" / "a", 0, 0)
        os.chown(tmp_path / "theirs", 65534, 65534)
        assert "theirs can be written by others" in strangers(tmp_path / "theirs" / "a")


class TestKernelCache:
    """Where numba unpickles."""

    @pytest.mark.parametrize("variable", ["SHOAL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"])
    def test_is_the_configured_folder_if_that_is_ours(self, variable, tmp_path):
        unset = {"SHOAL_CACHE_DIR": "", "XDG_CACHE_HOME": ""}
        folder, why = cache_of(**unset | {variable: tmp_path / "c"})
        assert folder.startswith(str(tmp_path / "c"))
        assert os.stat(folder).st_mode & 0o777 == 0o700
        assert why == "None"

    @pytest.mark.parametrize("variable", ["SHOAL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"])
    def test_is_a_folder_of_this_process_if_others_could_have_written_it(self, variable, tmp_path):
        (tmp_path / "c").mkdir()
        (tmp_path / "c").chmod(0o777)
        unset = {"SHOAL_CACHE_DIR": "", "XDG_CACHE_HOME": ""}
        environment = unset | {variable: tmp_path / "c", "TMPDIR": tmp_path}
        first, why = cache_of(**environment)
        second, _ = cache_of(**environment)
        assert first != second
        assert first.startswith(str(tmp_path / "shoal-kernels-"))
        assert "can be written by others" in why
        assert not os.path.exists(first)  # gone with its process

    def test_is_never_one_that_lies_ready_in_the_temporary_folder(self, tmp_path):
        for name in (f"shoal-{os.getuid()}", "shoal", "shoal-kernels"):
            (tmp_path / name).mkdir()
        folder, why = cache_of(SHOAL_CACHE_DIR="/proc/nowhere", TMPDIR=tmp_path)
        assert os.path.dirname(folder) == str(tmp_path)
        assert os.path.basename(folder).startswith("shoal-kernels-")
        assert "/proc/nowhere" in why
