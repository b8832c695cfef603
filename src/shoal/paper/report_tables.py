"""Tables of the report: the claims, and whatever else was tabulated, intervals beside their values."""

import math
import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from shoal.experiments.rows import Row
from shoal.paper.report_words import COLUMNS, METRICS
from shoal.paper.results import Claim
from shoal.record.words import told

BADGES = {  # a sign and a class for each verdict: color is never the only one
    "holds": ("\u2713", "holds"),
    "holds partly": ("\u25d0", "partly"),
    "does not hold": ("\u2717", "fails"),
    "undecided": ("?", "open"),
}
_DASH = "\u2013"


def badge(verdict: str) -> str:
    """A verdict as a colored label."""
    sign, name = BADGES.get(verdict, ("", "open"))
    return f'<span class="badge {name}"><span aria-hidden="true">{sign}</span> {escape(verdict)}</span>'


def claims_table(claims: Sequence[Claim], titles: Mapping[str, str], refit: Sequence[Claim] = ()) -> str:
    """The claims with what was measured and the verdict; `titles` are those of the figures in the report, by name.

    With the claims under another reading, `refit`, both stand side by side.
    """
    if refit:
        return _two_readings(claims, refit, titles)
    rows = "".join(_claim_row(claim, titles) for claim in claims)
    return (
        '<table class="claims"><thead><tr><th>Claim</th><th>What the paper says</th>'
        "<th>What the runs say</th><th>Verdict</th><th>Read from</th></tr></thead>\n"
        f"<tbody>\n{rows}</tbody></table>"
    )


def _claim_row(claim: Claim, titles: Mapping[str, str]) -> str:
    cells = (
        f"<td>{escape(claim.id)}</td>",
        f'<td data-label="Paper: ">{tidy(claim.statement)}</td>',
        f'<td data-label="Runs: ">{tidy(claim.measured)}<span class="key">{key_number(claim)}</span></td>',
        f'<td>{badge(claim.verdict)}<span class="key">{escape(claim.cases)}</span></td>',
        f'<td data-label="Figure: ">{_figure_link(claim.figure, titles)}</td>',
    )
    return f'<tr id="claim-{escape(claim.id)}">{"".join(cells)}</tr>\n'


def _two_readings(claims: Sequence[Claim], refit: Sequence[Claim], titles: Mapping[str, str]) -> str:
    """What the runs say under either reading; verdicts that differ are marked."""
    rows = "".join(
        f'<tr id="claim-{escape(one.id)}"><td>{escape(one.id)}</td>'
        f'<td data-label="Paper: ">{tidy(one.statement)}'
        f"{'' if one.verdict == other.verdict else DEPENDS}</td>"
        f'<td data-label="As printed: ">{_runs(one)}</td><td data-label="Refit: ">{_runs(other)}</td>'
        f'<td data-label="Figure: ">{_figure_link(one.figure, titles)}</td></tr>\n'
        for one, other in zip(claims, refit, strict=True)
    )
    return (
        '<table class="claims both"><thead><tr><th>Claim</th><th>What the paper says</th><th>As printed (oceans2020)'
        "</th><th>The reading that meets most (oceans2020-refit)</th><th>Read from</th></tr></thead>\n"
        f"<tbody>\n{rows}</tbody></table>"
    )


DEPENDS = '<span class="key">The verdict depends on the reading.</span>'


def _runs(claim: Claim) -> str:
    return (
        f'{badge(claim.verdict)}<span class="key">{escape(claim.cases)}</span>'
        f'<span class="measured">{tidy(claim.measured)}</span><span class="key">{key_number(claim)}</span>'
    )


def key_number(claim: Claim) -> str:
    """The key number of a claim with its interval and unit, or nothing if there is none."""
    if not math.isfinite(claim.value):
        return ""
    unit = "" if claim.unit in ("", "1") else "\u00a0" + escape(claim.unit).replace(" ", "\u00a0")
    return f"Key number: {interval_text(claim.value, claim.low, claim.high)}{unit}"


def data_table(rows: Sequence[Row], title: str) -> str:
    """Rows as a table; a column X with X_low and X_high, or one before low and high, gets its interval beside it."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    intervals = _intervals(names)
    bounds = {bound for pair in intervals.values() for bound in pair}
    shown = [name for name in names if name not in bounds]
    numeric = {name: any(_is_number(row.get(name)) for row in rows) for name in shown}
    head = "".join(_heading(name, numeric[name]) for name in shown)
    caption = f"{title} [95 % intervals]" if intervals else title
    body = "".join(
        "<tr>" + "".join(_cell(row, name, numeric[name], intervals.get(name)) for name in shown) + "</tr>\n"
        for row in rows
    )
    return (
        f'<div class="scroll" tabindex="0"><table><caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead>\n'
        f"<tbody>\n{body}</tbody></table></div>"
    )


def interval_text(value: float, low: float, high: float) -> str:
    """0.832 [0.829, 0.835], on one line."""
    return told(value, low, high).replace(" ", "\u00a0")


def tidy(text: str) -> str:
    """Escaped text with true minus signs and inequalities."""
    return escape(re.sub(r"(?<![\w.])-(?=\d)", "\u2212", text).replace("<=", "\u2264").replace(">=", "\u2265"))


def number_text(value: float) -> str:
    """A number without an interval; a dash where there is none."""
    return told(value) if math.isfinite(value) else _DASH


def _intervals(names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """{column: its columns of the lower and the upper bound}."""
    found = {
        name: (f"{name}_low", f"{name}_high") for name in names if f"{name}_low" in names and f"{name}_high" in names
    }
    for at, name in enumerate(names[:-2]):
        if (names[at + 1], names[at + 2]) == ("low", "high"):
            found[name] = ("low", "high")
    return found


def _heading(name: str, numeric: bool) -> str:
    words, unit = COLUMNS.get(name, (name.replace("_", " "), ""))
    shown = f'<span class="unit">{escape(unit)}</span>' if unit else ""
    return f"<th{_numeric(numeric)}>{escape(words)}{shown}</th>"


def _cell(row: Row, name: str, numeric: bool, interval: tuple[str, str] | None) -> str:
    value = row.get(name)
    if value is None or value == "":
        text = _DASH
    elif value in BADGES:
        text = badge(str(value))
    elif isinstance(value, bool):
        text = "yes" if value else "no"
    elif _is_number(value) and interval is not None:
        text = interval_text(float(value), *(_float(row.get(bound)) for bound in interval))
    elif isinstance(value, (int, float)):
        text = number_text(value)
    else:
        text = escape(METRICS.get(str(value), str(value)))
    return f"<td{_numeric(numeric)}>{text}</td>"


def _figure_link(name: str, titles: Mapping[str, str]) -> str:
    if name not in titles:
        return escape(name) or _DASH
    return f'<a href="#figure-{escape(name)}">{escape(titles[name])}</a>'


def _numeric(numeric: bool) -> str:
    return ' class="number"' if numeric else ""


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _float(value: Any) -> float:
    return float(value) if _is_number(value) else math.nan
