"""A leaderboard as a part of a Markdown page: the same runs, the same bytes."""

import re
import shlex
from collections.abc import Sequence
from pathlib import Path

from shoal.core.errors import RecordError
from shoal.core.files import write_atomic
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.experiments.comparison import Condition, Standing
from shoal.experiments.comparison_words import (
    REFERENCES,
    difference_text,
    family_text,
    name_text,
    p_text,
    rank_text,
    share_text,
    value_text,
)
from shoal.experiments.contenders import LATTICE
from shoal.experiments.leaderboard import Leaderboard
from shoal.experiments.suite import SuiteCondition, read_suite

BEGIN, END = "<!-- shoal compare: begin -->", "<!-- shoal compare: end -->"


def write_page(board: Leaderboard, file: Path, named: Sequence[str] = ()) -> None:
    """Replace what is between the two markers of a page; a missing page is begun.

    Raises
    ------
    RecordError : the page has no markers, or cannot be read or written; it is as it was then
    """
    before, after = page_around(file, board.suite.name)
    write_atomic(file, f"{before}{BEGIN}\n{page_part(board, named)}\n{END}{after}".encode())


def page_around(file: Path, title: str) -> tuple[str, str]:
    """Return what a page says before and after the markers.

    Raises
    ------
    RecordError : it has none, or cannot be read
    """
    try:
        text = file.read_text(encoding="utf-8") if file.exists() else f"# Suite {title}\n\n{BEGIN}\n{END}\n"
    except (OSError, UnicodeDecodeError) as error:
        raise RecordError(str(file), f"cannot be read: {error}", "name a Markdown file") from error
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not begin or not end:
        fix = f"write two lines where it belongs: {BEGIN} and {END}"
        raise RecordError(str(file), "has no place for the leaderboard", fix)
    return before, after


def page_part(board: Leaderboard, named: Sequence[str] = ()) -> str:
    """Leaderboard, what standing still is worth, and a table per condition, with what made them."""
    conditions = zip(board.suite.conditions, board.shares.conditions, strict=True)
    return "\n\n".join(
        [
            _made_by(board, named),
            "## Leaderboard",
            f"Score: the mean of the shares, 0 to 1, under the {len(board.suite.conditions)} conditions, which are the "
            "columns to its right. There **+** is better and **−** worse than standing still; without a sign no "
            "difference is shown.",
            _overview(board),
            f"{family_text(f'all {board.score.tests} comparisons of scores')} {REFERENCES}",
            "## When standing still wins",
            standing_still(board),
            "## Condition by condition",
            family_text(f"all {board.shares.tests} comparisons of the tables below"),
            *(_section(condition, found) for condition, found in conditions),
        ]
    )


def standing_still(board: Leaderboard) -> str:
    """Say for every condition what the motionless lattice beats, and where no difference is shown."""
    ranked = sum(each.rank is not None for each in board.overall.standings)
    first = [each.name for each in board.shares.conditions if each.of(LATTICE).rank == 1]
    lines = [
        f"Standing still (`{LATTICE}`) ranks {board.overall.of(LATTICE).rank} of {ranked} by score. "
        f"It comes first under {', '.join(first) or 'no condition'}.",
        "",
    ]
    for condition in (board.overall, *board.shares.conditions):
        beaten, equal = (_names(condition, verdict) for verdict in ("worse", "no difference shown"))
        sentences = [f"it beats {beaten}"] * bool(beaten) + [f"no difference is shown to {equal}"] * bool(equal)
        lines.append(f"- **{condition.name}**: {'; '.join(sentences) or 'it neither beats nor equals any'}.")
    return "\n".join(lines)


def _made_by(board: Leaderboard, named: Sequence[str]) -> str:
    suite, asked = board.suite, read_suite(board.suite.name)
    changed = [name for name in ("runs", "steps", "seed") if getattr(suite, name) != getattr(asked, name)]
    options = [part for name in changed for part in (f"--{name}", str(getattr(suite, name)))]
    command = shlex.join(["shoal", "compare", *named, "--suite", suite.name, *options])
    made = (
        f"Made by `{command}`: {suite.runs} runs of {suite.steps:,} steps each, seed {suite.seed}, Shoal {VERSION}, "
        f"results version {RESULTS_VERSION}, suite hash {board.hash}."
    )
    if suite.runs >= asked.runs and suite.steps >= asked.steps:
        return made
    return (
        f"> **A short trial**, not to be cited: {suite.runs} runs of {suite.steps:,} steps, where the suite asks for "
        f"{asked.runs} of {asked.steps:,}.\n\n{made}"
    )


def _overview(board: Leaderboard) -> str:
    conditions = board.shares.conditions
    head = ["rank", "strategy", "score [95 %]", "minus lattice", "adjusted p", *(each.name for each in conditions)]
    rows = [
        [*_cells(each), *(share_text(condition.of(each.strategy)) for condition in conditions)]
        for each in board.overall.standings
    ]
    return _markdown(head, rows)


def _section(condition: SuiteCondition, found: Condition) -> str:
    out_of = f" / {condition.out_of:g}" if condition.out_of != 1 else ""
    head = ["rank", "strategy", "share [95 %]", "minus lattice", "adjusted p", "verdict"]
    rows = [[*_cells(each), each.verdict] for each in found.standings]
    says = condition.says[0].upper() + condition.says[1:]
    return f"### {condition.name}\n\n{says}. Share: `{condition.metric}`{out_of}.\n\n{_markdown(head, rows)}"


def _cells(each: Standing) -> list[str]:
    return [
        rank_text(each),
        _as_markdown(name_text(each)),
        value_text(each),
        difference_text(each),
        p_text(each.adjusted_p),
    ]


def _names(condition: Condition, verdict: str) -> str:
    return ", ".join(
        _as_markdown(each.strategy) for each in condition.standings if each.verdict == verdict and not each.informed
    )


def _as_markdown(name: str) -> str:
    """A name as text of a table, not as its markup."""
    return re.sub(r"([\\`*_\[\]<>|$])", r"\\\1", name)


def _markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    align = [":---" if name in ("strategy", "verdict") else "---:" for name in head]
    return "\n".join("| " + " | ".join(row) + " |" for row in (head, align, *rows))
