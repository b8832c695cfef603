"""Where results and progress are printed: names are text here, never markup, emoji or orders to the terminal."""

import sys
from typing import IO, Any, NoReturn

from rich.console import Console
from rich.table import Table
from rich.text import Text

from shoal.core.text import plain

_NO_MARGIN = 160  # columns; a file or a pipe has no margin to fit
_NARROWEST = 40  # columns; COLUMNS=0 is not a width


class _PlainConsole(Console):
    """A console to which every string is what it says."""

    def __init__(self, file: IO[str]) -> None:
        super().__init__(file=file, highlight=False, markup=False, emoji=False)
        self.width = max(self.width, _NARROWEST) if self.is_terminal else _NO_MARGIN

    def render_str(self, text: str, **look: Any) -> Text:
        return super().render_str(plain(text, "\n"), **look)

    def on_broken_pipe(self) -> NoReturn:
        raise BrokenPipeError  # run_command has one rule for all output


def results_console() -> Console:
    """Return a console on stdout."""
    return _PlainConsole(sys.stdout)


def progress_console() -> Console:
    """Return a console on stderr."""
    return _PlainConsole(sys.stderr)


def print_table(console: Console, table: Table) -> None:
    """Print a table without blanks at the ends of its lines."""
    for line in console.render_lines(table, pad=False):
        text = Text.assemble(*((piece.text, piece.style or "") for piece in line))
        text.rstrip()
        console.print(text, no_wrap=True, crop=False, overflow="ignore")


def styled(text: str, style: str) -> Text:
    """A text in a style, as it can be shown."""
    return Text(plain(text, "\n"), style=style)


def small_print(text: str, below: str) -> Text:
    """A text, and another one dimmed below it."""
    return styled(f"{text}\n", "").append_text(styled(below, "dim"))
