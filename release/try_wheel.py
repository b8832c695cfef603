"""Install the wheel of dist/ without extras into fresh environments and run it there: `make dist-check`.

One environment per Python that Shoal names and that is on this machine, each in a folder of its own, with a kernel
cache of its own, away from the sources.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


class TrialError(Exception):
    """A wheel that does not do what it should, in words."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Try the wheel under every Python; 0 if it works under all that are here, 1 if not, 2 if nothing can be tried."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--dist", type=Path, default=ROOT / "dist", metavar="DIR")
    parser.add_argument("--python", action="append", metavar="3.X", help="this version only (repeat for more)")
    asked = parser.parse_args(arguments)
    wheels = sorted(asked.dist.glob("shoal-*.whl"))
    if len(wheels) != 1:
        print(f"{asked.dist}: has {len(wheels)} wheels of shoal, not 1\n  fix: make dist", file=sys.stderr)
        return 2
    tried = passed = 0
    for version in asked.python or supported(ROOT / "pyproject.toml"):
        python = interpreter(version)
        if not python:
            print(f"Python {version}: is not on this machine, not tried", flush=True)
            continue
        tried += 1
        try:
            print(f"Python {version}: {trial(wheels[0], python)}", flush=True)
            passed += 1
        except TrialError as error:
            print(f"Python {version}: FAILS: {error}", flush=True)
    if not tried:
        print("no Python to try it with\n  fix: install one of those above", file=sys.stderr)
        return 2
    return 0 if passed == tried else 1


def supported(project: Path) -> list[str]:
    """Return the versions of Python, such as 3.12, that the classifiers of a pyproject.toml name."""
    classifiers = tomllib.loads(project.read_text(encoding="utf-8"))["project"]["classifiers"]
    words = [each.removeprefix("Programming Language :: Python :: ") for each in classifiers]
    return [word for word in words if word.startswith("3.")]


def interpreter(version: str) -> Path | None:
    """Return an interpreter of this version, on PATH or pyenv's, that starts; None if there is none."""
    name = f"python{version}"
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    on_path = shutil.which(name)
    candidates = [Path(on_path)] if on_path else []
    for each in [*candidates, *sorted(pyenv.glob(f"versions/{version}.*/bin/{name}"))]:
        asked = [each, "-c", "import sys, ensurepip; print('%d.%d' % sys.version_info[:2])"]
        done = subprocess.run(asked, capture_output=True, text=True, check=False)
        if done.returncode == 0 and done.stdout.strip() == version:
            return each
    return None


def trial(wheel: Path, python: Path) -> str:
    """Install a wheel, core only, into an environment of this Python, run it, and return what it did, in a line.

    Raises
    ------
    TrialError : something is not as it should be
    """
    began = time.monotonic()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        called([python, "-m", "venv", folder / "venv"], folder)
        inside = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        called([inside / "python", "-m", "pip", "install", "--quiet", wheel.resolve()], folder)
        listed = json.loads(called([inside / "python", "-m", "pip", "list", "--format=json"], folder))
        shoal = inside / "shoal"
        must_name("shoal presets", called([shoal, "presets"], folder), "oceans2020")
        must_name("shoal strategies", called([shoal, "strategies"], folder), "knn-pso")
        found = json.loads(called([shoal, "run", "oceans2020", "--steps", "200", "--json"], folder))
        share = found["time_on_target"]["mean"]
        if not 0.0 <= share <= 1.0 or found["steps"] != 200:
            raise TrialError(f"shoal run gives a time on target of {share} over {found['steps']} steps")
        refused = called([shoal, "run", "oceans2020", "--steps", "200", "--figure", "run.png"], folder, code=2)
        must_name("shoal run --figure without the extra", refused, "matplotlib")
    packages = {each["name"]: each["version"] for each in listed}
    return (
        f"{len(packages)} packages (numba {packages['numba']}, numpy {packages['numpy']}); presets, strategies and run "
        f"work, time on target {share:.3f}; {time.monotonic() - began:.0f} s with installing and compiling"
    )


def called(command: Sequence[str | Path], folder: Path, *, code: int = 0) -> str:
    """Run a command in `folder` with nothing of the caller's Python, and return all that it prints.

    Raises
    ------
    TrialError : it does not exit with `code`, or there is a traceback
    """
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "VIRTUAL_ENV"))}
    cache = folder / "cache"
    cache.mkdir(mode=0o700, exist_ok=True)
    own = {"SHOAL_CACHE_DIR": str(cache), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    done = subprocess.run(command, cwd=folder, env=kept | own, capture_output=True, text=True, check=False)
    words = " ".join(Path(command[0]).name if each is command[0] else str(each) for each in command)
    if done.returncode != code or "Traceback" in done.stderr:
        raise TrialError(f"`{words}` exits with {done.returncode}, not {code}: {done.stderr.strip()[-1000:]}")
    return done.stdout if code == 0 else done.stdout + done.stderr


def must_name(what: str, text: str, word: str) -> None:
    """Raise TrialError if what was printed does not say a word."""
    if word not in text:
        raise TrialError(f"{what} does not name {word}: {text.strip()[:300]}")


if __name__ == "__main__":
    sys.exit(main())
