"""Comparisons in a terminal."""

import sys
from collections.abc import Callable, Sequence
from typing import Any, Literal

from rich.console import Console
from rich.table import Table
from rich.text import Text

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

_Column = tuple[str, Callable[[Standing], str]]


def print_comparison(comparison: Comparison, metric: str, direction: int, about: dict[str, Any]) -> None:
    """Print a table per condition, and what the verdicts mean."""
    console = _console()
    words = {1: "more is better", -1: "less is better", 0: "neither more nor less is better"}[direction]
    console.print(
        f"[bold]{about['scenario']}[/bold]: {about['runs']} runs of {about['steps']:,} steps, seed {about['seed']}"
    )
    unit = METRICS[metric].unit
    console.print(
        f"{metric.replace('_', ' ')}{'' if unit == '1' else f' [{unit}]'}: {METRICS[metric].sentence}; {words}"
    )
    columns = [
        (metric.replace("_", " "), value_text),
        (f"minus {comparison.baseline}", difference_text),
        ("adj. p", lambda each: p_text(each.adjusted_p)),
        ("verdict", lambda each: each.verdict),
    ]
    for condition in comparison.conditions:
        console.print()
        if condition.name:
            console.print(f"[bold]{condition.name}[/bold]")
        console.print(_table(condition, columns))
        if direction:
            ranked = sum(each.rank is not None for each in condition.standings)
            console.print(f"standing still ({LATTICE}) ranks {rank_text(condition.of(LATTICE))} of {ranked}")
    _print_notes(console, [comparison])


def print_leaderboard(board: Leaderboard) -> None:
    """Print the ranking by score, then the shares under every condition."""
    console, suite = _console(), board.suite
    console.print(
        f"[bold]{suite.name}[/bold]: {suite.runs} runs of {suite.steps:,} steps under each of {len(suite.conditions)} "
        f"conditions, seed {suite.seed}, suite hash {board.hash}"
    )
    console.print("score: mean share over all conditions\n")
    columns: list[_Column] = [
        ("score", value_text),
        (f"minus {LATTICE}", difference_text),
        ("adj. p", lambda each: p_text(each.adjusted_p)),
        ("verdict", lambda each: each.verdict),
    ]
    console.print(_table(board.overall, columns))
    console.print("\nshare under each condition; + better, − worse than standing still; no sign: no difference shown\n")
    columns = [(each.name, _share_under(each)) for each in board.shares.conditions]
    console.print(_table(board.overall, columns, justify="left"))
    _print_notes(console, [board.score, board.shares])


def _share_under(condition: Condition) -> Callable[[Standing], str]:
    return lambda each: share_text(condition.of(each.strategy))


def _table(condition: Condition, columns: Sequence[_Column], justify: Literal["left", "right"] = "right") -> Table:
    table = Table(box=None, padding=(0, 2, 0, 0))
    table.add_column("", justify="right")
    table.add_column("strategy", no_wrap=True)
    for title, _ in columns:
        table.add_column(title, justify="left" if title == "verdict" else justify, no_wrap=title != "verdict")
    below = False
    for each in condition.standings:
        if each.informed and not below:
            table.add_row("", Text("know the target:", style="dim"))
            below = True
        look = "bold" if each.strategy == LATTICE else "dim" if each.informed else ""
        table.add_row(rank_text(each), each.strategy, *(text(each) for _, text in columns), style=look)
    return table


def _print_notes(console: Console, comparisons: Sequence[Comparison]) -> None:
    tests = " and ".join(str(each.tests) for each in comparisons)
    told = family_text(comparisons[0]).replace(f"all {comparisons[0].tests} ", f"all {tests} ")
    informed = any(each.informed for each in comparisons[0].conditions[0].standings)
    console.print(f"\n{told}{f' {REFERENCES}' if informed else ''}", style="dim")


def _console() -> Console:
    console = Console(file=sys.stdout, highlight=False)
    if not console.is_terminal:
        console.width = 160  # a file or a pipe has no margin to fit
    return console
