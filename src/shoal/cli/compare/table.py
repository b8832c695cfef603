"""Comparisons and leaderboards in a terminal."""

from collections.abc import Callable, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from shoal.cli.console import print_table, results_console, styled
from shoal.experiments.comparison import Comparison, Condition, Standing
from shoal.experiments.comparison_words import (
    REFERENCES,
    difference_text,
    family_text,
    p_text,
    rank_text,
    share_text,
    value_text,
)
from shoal.experiments.contenders import LATTICE
from shoal.experiments.leaderboard import Leaderboard
from shoal.metrics.summary import METRICS
from shoal.record.names import label_of

_Column = tuple[str, Callable[[Standing], str]]


def print_comparison(comparison: Comparison, metric: str, direction: int, about: dict[str, Any]) -> None:
    """Print a table per condition, and what the verdicts mean."""
    console = results_console()
    words = {1: "more is better", -1: "less is better", 0: "neither more nor less is better"}[direction]
    runs = f"{about['runs']} run{'s' * (about['runs'] > 1)}"
    text = f": {runs} of {about['steps']:,} steps, seed {about['seed']}"
    console.print(styled(about["scenario"], "bold") + styled(text, ""))
    console.print(f"{label_of(metric)}: {METRICS[metric].sentence}; {words}")
    columns = [
        (METRICS[metric].words, value_text),
        (f"minus {comparison.baseline}", difference_text),
        ("adj. p", lambda each: p_text(each.adjusted_p)),
        ("verdict", lambda each: each.verdict),
    ]
    for condition in comparison.conditions:
        console.print()
        if condition.name:
            console.print(styled(condition.name, "bold"))
        print_table(console, _table(condition, columns))
        if direction:
            ranked = sum(each.rank is not None for each in condition.standings)
            console.print(f"standing still ({LATTICE}) ranks {rank_text(condition.of(LATTICE))} of {ranked}")
    family = (
        f"all {comparison.tests} comparisons"
        if len(comparison.conditions) == 1
        else (f"all {comparison.tests} comparisons of the {len(comparison.conditions)} tables")
    )
    _print_notes(console, family, comparison.conditions[0])


def print_leaderboard(board: Leaderboard) -> None:
    """Print the ranking by score, then the shares under every condition."""
    console, suite = results_console(), board.suite
    text = (
        f": {suite.runs} runs of {suite.steps:,} steps under each of {len(suite.conditions)} conditions, seed "
        f"{suite.seed}, suite hash {board.hash}"
    )
    console.print(styled(suite.name, "bold") + styled(text, ""))
    console.print("score: mean share over all conditions\n")
    columns: list[_Column] = [
        ("score", value_text),
        (f"minus {LATTICE}", difference_text),
        ("adj. p", lambda each: p_text(each.adjusted_p)),
        ("verdict", lambda each: each.verdict),
    ]
    print_table(console, _table(board.overall, columns))
    console.print("\nshare under each condition; + better, − worse than standing still; no sign: no difference shown\n")
    print_table(console, _shares(board))
    family = f"all comparisons of scores ({board.score.tests}) together, and for all of shares ({board.shares.tests})"
    _print_notes(console, family, board.overall)


def _table(condition: Condition, columns: Sequence[_Column]) -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0))
    table.add_column("", justify="right")
    table.add_column("strategy", no_wrap=True)
    for title, _ in columns:
        table.add_column(title, justify="left" if title == "verdict" else "right", no_wrap=title != "verdict")
    _fill(table, condition, [text for _, text in columns])
    return table


def _shares(board: Leaderboard) -> Table:
    """In the order of the score; narrow enough for 80 columns."""
    table = Table(box=None, padding=(0, 1, 0, 0))
    table.add_column("", justify="right")
    table.add_column("strategy", no_wrap=True)
    for each in board.shares.conditions:
        table.add_column(each.name, min_width=6)
    _fill(table, board.overall, [_share_under(each) for each in board.shares.conditions])
    return table


def _share_under(condition: Condition) -> Callable[[Standing], str]:
    return lambda each: share_text(condition.of(each.strategy), decimals=2)


def _fill(table: Table, condition: Condition, texts: Sequence[Callable[[Standing], str]]) -> None:
    """A row per standing; those that know the target below a line that says so."""
    below = False
    for each in condition.standings:
        if each.informed and not below:
            table.add_row("", styled("know the target:", "dim"))
            below = True
        look = "bold" if each.strategy == LATTICE else "dim" if each.informed else ""
        table.add_row(rank_text(each), each.strategy, *(text(each) for text in texts), style=look)


def _print_notes(console: Console, family: str, condition: Condition) -> None:
    references = f" {REFERENCES}" if any(each.informed for each in condition.standings) else ""
    console.print(f"\n{family_text(family)}{references}", style="dim")
