"""shoal run of a log of changes: what was steered in the browser, made again without one."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shoal.cli.progress import progress_bar

if TYPE_CHECKING:
    from shoal.record.record import Record

SUFFIX = ".jsonl"  # of a log of changes


def refuse_changes(log: str, changes: Sequence[Any], *, runs: int, device: str) -> None:
    """Refuse options that a log has no place for.

    Raises
    ------
    ScenarioError : one is given
    """
    from shoal.core.errors import ScenarioError

    if any(each is not None for each in changes) or runs != 1 or device != "cpu":
        problem = "is a log of changes, which is run as it was: once, on the processor"
        raise ScenarioError(log, problem, "leave out what would change it")


def make_again(log: str, every: int | None, out: Path | None) -> "Record":
    """Make the run of a log again, with a bar of how far it is."""
    from shoal.run.change_log import read_log
    from shoal.run.replay_changes import replay_changes

    known = read_log(log)
    with progress_bar(f"{known.runs[0].name}, steered, {known.last:,} steps") as progress:
        return replay_changes(known, every=every, out=out, progress=progress)
