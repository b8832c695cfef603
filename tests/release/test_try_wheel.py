"""A wheel is tried under every Python that is here, what is not tried is said. The trial itself: `make dist-check`."""

import sys
from pathlib import Path

import pytest
import try_wheel
from try_wheel import TrialError, called, interpreter, main, supported

HERE = f"{sys.version_info.major}.{sys.version_info.minor}"


@pytest.fixture
def dist(tmp_path):
    """A folder with one wheel."""
    (tmp_path / "dist").mkdir()
    (tmp_path / "dist/shoal-1-py3-none-any.whl").write_text("")
    return tmp_path / "dist"


def test_the_pythons_are_those_of_the_classifiers(tmp_path):
    (tmp_path / "pyproject.toml").write_text(
        '[project]\nclassifiers = ["Typing :: Typed", "Programming Language :: Python :: 3.9"]\n'
    )
    assert supported(tmp_path / "pyproject.toml") == ["3.9"]


class TestInterpreter:
    def test_one_on_path_or_of_pyenv_is_found(self, monkeypatch, tmp_path):
        folder = tmp_path / f"versions/{HERE}.1/bin"
        folder.mkdir(parents=True)
        (folder / f"python{HERE}").write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
        (folder / f"python{HERE}").chmod(0o755)
        monkeypatch.setenv("PYENV_ROOT", str(tmp_path))
        monkeypatch.setattr(try_wheel.shutil, "which", lambda name: None)
        assert interpreter(HERE) == folder / f"python{HERE}"

    def test_one_that_does_not_start_is_none(self, monkeypatch, tmp_path):
        shim = tmp_path / "python3.99"  # as pyenv leaves one for a version that is not chosen
        shim.write_text("#!/bin/sh\nexit 127\n")
        shim.chmod(0o755)
        monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
        monkeypatch.setenv("PYENV_ROOT", str(tmp_path))
        assert interpreter("3.99") is None


class TestCalled:
    def test_nothing_of_the_callers_python_is_there(self, monkeypatch, tmp_path):
        monkeypatch.setenv("PYTHONPATH", "/sources")
        seen = called([sys.executable, "-c", "import os; print(os.environ.get('PYTHONPATH'), os.getcwd())"], tmp_path)
        assert seen.split() == ["None", str(tmp_path)]

    def test_another_exit_code_is_a_failure_that_says_why(self, tmp_path):
        with pytest.raises(TrialError, match=r"exits with 3, not 0: too bad"):
            called([sys.executable, "-c", "import sys; print('too bad', file=sys.stderr); sys.exit(3)"], tmp_path)

    def test_a_traceback_is_a_failure_whatever_the_exit_code(self, tmp_path):
        with pytest.raises(TrialError, match="ZeroDivisionError"):
            called([sys.executable, "-c", "1 / 0"], tmp_path, code=1)


class TestMain:
    def run(self, dist, monkeypatch, results):
        """main() where these versions are here, whose trials give a line or fail."""

        def trial(wheel, python):
            if isinstance(results[python.name], TrialError):
                raise results[python.name]
            return results[python.name]

        monkeypatch.setattr(try_wheel, "interpreter", lambda version: Path(version) if version in results else None)
        monkeypatch.setattr(try_wheel, "trial", trial)
        return main(["--dist", str(dist)])

    def test_a_python_that_is_not_here_is_said(self, dist, monkeypatch, capsys):
        assert self.run(dist, monkeypatch, {"3.11": "works", "3.13": "works"}) == 0
        told = capsys.readouterr().out.splitlines()
        assert told == ["Python 3.11: works", "Python 3.12: is not on this machine, not tried", "Python 3.13: works"]

    def test_one_failure_is_a_failure_and_the_others_are_tried(self, dist, monkeypatch, capsys):
        assert self.run(dist, monkeypatch, {"3.11": TrialError("bad"), "3.12": "works"}) == 1
        assert capsys.readouterr().out.splitlines()[:2] == ["Python 3.11: FAILS: bad", "Python 3.12: works"]

    def test_nothing_tried_is_no_success(self, dist, monkeypatch, capsys):
        assert self.run(dist, monkeypatch, {}) == 2
        assert "no Python to try it with" in capsys.readouterr().err

    def test_a_folder_without_its_one_wheel_is_refused(self, tmp_path, capsys):
        assert main(["--dist", str(tmp_path)]) == 2
        assert capsys.readouterr().err == f"{tmp_path}: has 0 wheels of shoal, not 1\n  fix: make dist\n"
