"""Packages as a user installs them, in a folder; and Shoal as it then runs, in a process of its own."""

import os
import re
import subprocess
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"


def example(page):
    """The complete file that a how-to shows."""
    return re.search(r"```python\n(.*?)```", (DOCS / f"how-to/{page}.md").read_text(encoding="utf-8"), re.DOTALL)[1]


def install(site, package, text, group, *names):
    """Put a package of one module into a folder, and what it offers there: its own name, if nothing else is said."""
    module = package.replace("-", "_")
    (site / f"{module}.py").write_text(text, encoding="utf-8")
    info = site / f"{module}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n", encoding="utf-8")
    lines = "".join(f"{name} = {module}\n" for name in names or (package,))
    (info / "entry_points.txt").write_text(f"[{group}]\n{lines}", encoding="utf-8")


def python(site, *arguments, cwd=None):
    """Run Python with these packages installed; return exit code, stdout, stderr."""
    path = os.pathsep.join([str(site), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run(
        [sys.executable, *arguments], cwd=cwd or site, env={**os.environ, "PYTHONPATH": path},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def shoal(site, *tokens, cwd=None):
    """Run a command with these packages installed; return exit code, stdout, stderr."""
    return python(site, "-m", "shoal", *map(str, tokens), cwd=cwd)
