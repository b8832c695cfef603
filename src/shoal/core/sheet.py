"""A small table to look at: as text in a terminal, as HTML in a notebook. What is in it is text, never markup."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

MOST_ROWS = 30  # shown; how many are left out is said


@dataclass(frozen=True)
class Sheet:
    """A heading, rows of text below titles, and a note.

    Attributes
    ----------
    head : one line above
    titles : of the columns
    rows : one text per column each
    note : one line below
    words : titles of the columns that hold words, which begin at the left; numbers end at the right
    """

    head: str
    titles: Sequence[str]
    rows: Sequence[Sequence[str]]
    note: str = ""
    words: Sequence[str] = ()

    def text(self) -> str:
        """Columns side by side."""
        table = [tuple(map(shown, row)) for row in (self.titles, *self.rows[:MOST_ROWS])]
        widths = [max(map(len, column)) for column in zip(*table, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(width) if title in self.words else cell.rjust(width)
                for cell, width, title in zip(row, widths, self.titles, strict=True)
            ).rstrip()
            for row in table
        ]
        return "\n".join(line for line in (shown(self.head), *lines, self._more(), shown(self.note)) if line)

    def html(self) -> str:
        """The same as a table; everything is escaped."""
        titles = "".join(f"<th{self._side(title)}>{_html(title)}</th>" for title in self.titles)
        rows = "".join(
            "<tr>"
            + "".join(
                f"<td{self._side(title)}>{_html(cell)}</td>" for cell, title in zip(row, self.titles, strict=True)
            )
            + "</tr>"
            for row in self.rows[:MOST_ROWS]
        )
        below = "".join(f"<div><small>{_html(line)}</small></div>" for line in (self._more(), self.note) if line)
        table = f"<table><thead><tr>{titles}</tr></thead><tbody>{rows}</tbody></table>" if self.titles else ""
        return f"<div><div>{_html(self.head)}</div>{table}{below}</div>"

    def _more(self) -> str:
        left = len(self.rows) - MOST_ROWS
        return f"... and {left} more rows: see to_pandas()" if left > 0 else ""

    def _side(self, title: str) -> str:
        side = "left" if title in self.words else "right; white-space: nowrap"
        return f' style="text-align: {side}; padding: 0.15em 0.6em"'


def shown(text: str) -> str:
    r"""Return a text as it can be shown: characters that steer a terminal or break a line become \x1b and alike."""
    return "".join(each if each.isprintable() else ascii(each)[1:-1] for each in text)


def _html(text: str) -> str:
    return escape(shown(text))
