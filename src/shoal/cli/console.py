"""Where results are printed: stdout, as wide as the terminal."""

import sys

from rich.console import Console

_NO_MARGIN = 160  # columns; a file or a pipe has no margin to fit


def results_console() -> Console:
    """Return a console on stdout."""
    console = Console(file=sys.stdout, highlight=False)
    if not console.is_terminal:
        console.width = _NO_MARGIN
    return console
