"""Write the records and stores of today's results version into results-vN, see README.md."""

import sys
from pathlib import Path

from shoal.cli.main import run_command
from shoal.core.version import RESULTS_VERSION

HERE = Path(__file__).parent
TINY = str(HERE / "tiny.toml")


def main(folder: Path) -> None:
    """Write everything, by the commands that users write."""
    for what, *command in (
        ("record", "run", TINY, "--runs", "2"),
        ("every", "run", TINY, "--every", "1"),
        ("sweep", "sweep", TINY, "--vary", "neighbors=2,3", "--vary", "strategy=knn-pso,lattice", "--runs", "2"),
        ("compare", "compare", "knn-pso", "charged-pso", "--scenario", TINY, "--runs", "2"),
    ):
        if run_command([*command, "--out", str(folder / what), "--jobs", "1"]) != 0:
            sys.exit(f"{what}: not written")


if __name__ == "__main__":
    main(HERE / f"results-v{RESULTS_VERSION}")
