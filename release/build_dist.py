"""Build the sdist and the wheel into dist/, from what git tracks, without touching the working tree: `make dist`.

The sources are copied, the links of the copy's README are made absolute where a base address is given, both files are
built from the copy and checked, and only then put into dist/ in the place of what an earlier build left there.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from collections.abc import Iterable, Sequence
from pathlib import Path

from absolute_links import absolute, base_address

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = "src/shoal/"


class BuildError(Exception):
    """What keeps a release from being built: where, what, how to fix it."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Build, check, and say what there is; 0 if both files are in place, 2 if nothing was changed."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--base", default="", metavar="URL", help="of the repository's files, for the links of README")
    parser.add_argument("--out", type=Path, default=ROOT / "dist", metavar="DIR")
    asked = parser.parse_args(arguments)
    try:
        base = base_address(asked.base) if asked.base else ""
        names = tracked(ROOT)
        with tempfile.TemporaryDirectory() as folder:
            copy, made = Path(folder, "shoal"), Path(folder, "dist")
            copy_files(ROOT, names, copy)
            if base:
                (copy / "README.md").write_text(absolute(ROOT / "README.md", base, ROOT), encoding="utf-8")
            build(copy, made)
            check(made, names)
            files = put(made, asked.out)
    except (BuildError, ValueError) as error:
        print(error, file=sys.stderr)
        return 2
    for file in files:
        print(f"{file}: {file.stat().st_size / 1e6:.1f} MB, SHA-256 {hashlib.sha256(file.read_bytes()).hexdigest()}")
    print(f"links of README: absolute, below {base}" if base else "links of README: relative (BASE=URL not given)")
    if changed := git(ROOT, "status", "--porcelain").splitlines():
        print(f"NOT for release: the working tree is not what is committed ({len(changed)} files; new ones left out)")
    return 0


def git(root: Path, *words: str) -> str:
    """Return what a git command prints about the repository in `root`.

    Raises
    ------
    BuildError : there is no git, or no repository
    """
    try:
        done = subprocess.run(["git", "-C", root, *words], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        raise BuildError(f"{root}: git knows no repository here\n  fix: build from a clone") from None
    return done.stdout


def tracked(root: Path) -> list[str]:
    """Return the files that git tracks and that are there, by their names relative to `root`, in order.

    Raises
    ------
    BuildError : `root` is not the top of a repository, such as an unpacked sdist inside of another
    """
    if Path(git(root, "rev-parse", "--show-toplevel").strip()).resolve() != root.resolve():
        raise BuildError(f"{root}: is not the top of a git repository\n  fix: build from a clone")
    return sorted(name for name in git(root, "ls-files", "-z").split("\0") if name and (root / name).is_file())


def copy_files(root: Path, names: Iterable[str], to: Path) -> None:
    """Copy files of these relative names, with their modes."""
    for name in names:
        (to / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(root / name, to / name)


def build(sources: Path, made: Path) -> None:
    """Build an sdist, and a wheel from it, into the folder `made`; the same sources give the same bytes.

    Raises
    ------
    BuildError : the build fails
    """
    moment = {"SOURCE_DATE_EPOCH": git(ROOT, "log", "-1", "--format=%ct").strip()}
    command = [sys.executable, "-m", "build", "--outdir", made, sources]
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | moment, check=False)
    if done.returncode:
        raise BuildError(f"build: failed\n{(done.stdout + done.stderr).strip()[-2000:]}")


def check(made: Path, names: Iterable[str]) -> None:
    """Check that the wheel holds the package as git tracks it, and both files what an index asks for.

    Raises
    ------
    BuildError : a file of the package is missing or too many, there is no license, or twine objects
    """
    (wheel,) = made.glob("*.whl")
    problems = difference(wheel, names)
    if problems:
        raise BuildError(f"{wheel.name}: {'; '.join(problems)}\n  fix: see .gitignore, and hatch in pyproject.toml")
    command = [sys.executable, "-m", "twine", "check", "--strict", *sorted(made.iterdir())]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise BuildError(f"twine check: failed\n{(done.stdout + done.stderr).strip()[-2000:]}")


def difference(wheel: Path, names: Iterable[str]) -> list[str]:
    """Return what a wheel has beside the package as tracked, or lacks of it and of the licenses, in words."""
    with zipfile.ZipFile(wheel) as archive:
        held = set(archive.namelist())
    wanted = {name.removeprefix("src/") for name in names if name.startswith(PACKAGE)}
    package = {name for name in held if ".dist-info/" not in name}
    licenses = {name.rpartition("/")[2] for name in held if ".dist-info/licenses/" in name}
    found = (
        ("lacks", wanted - package),
        ("has beside the package", package - wanted),
        ("lacks the licenses", {"LICENSE", "THIRD_PARTY.md"} - licenses),
    )
    return [f"{problem} {', '.join(sorted(files)[:5])}" for problem, files in found if files]


def put(made: Path, out: Path) -> list[Path]:
    """Move what was made into `out`, in the place of every build that is there; return the files."""
    out.mkdir(parents=True, exist_ok=True)
    for older in [*out.glob("shoal-*.whl"), *out.glob("shoal-*.tar.gz")]:
        older.unlink()
    return [Path(shutil.move(file, out / file.name)) for file in sorted(made.iterdir())]


if __name__ == "__main__":
    sys.exit(main())
