"""Progress on stderr: a bar on a terminal, a line now and then in a log."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

from shoal.cli.console import progress_console
from shoal.cli.output import tell
from shoal.core.text import plain

SECONDS_BETWEEN_LINES = 5.0


@contextmanager
def progress_bar(what: str, unit: str = "steps") -> Iterator[Callable[[int, int], None]]:
    """Yield a function to call as update(done, total) from any thread."""
    console = progress_console()
    if not console.is_terminal:
        yield _line_printer(what, unit)
        return
    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TextColumn("{task.percentage:>3.0f} %"))
    with Progress(*columns, TimeElapsedColumn(), TimeRemainingColumn(), console=console, transient=True) as bar:
        task = bar.add_task(plain(what), total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def note(message: str) -> None:
    """Tell the user something that is not a result."""
    tell(message)


def _line_printer(what: str, unit: str) -> Callable[[int, int], None]:
    last = time.monotonic()

    def update(done: int, total: int) -> None:
        nonlocal last
        if time.monotonic() - last >= SECONDS_BETWEEN_LINES:
            last = time.monotonic()
            note(f"{what}: {100 * done / total:.0f} % ({done:,} of {total:,} {unit})")

    return update
