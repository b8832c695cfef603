"""shoal compare --suite: a leaderboard over fixed conditions."""

import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from shoal.cli.compare.runs import tell_failures
from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.sweep_progress import sweep_progress


def compare_suite(
    named: Sequence[str],
    name: str,
    *,
    assignments: list[str],
    runs: int | None,
    steps: int | None,
    seed: int | None,
    jobs: int | None,
    device: str,
    out: Path | None,
    figure: Path | None,
    width: Literal["single", "double"],
    markdown: Path | None,
    as_json: bool,
) -> None:
    """Run what is missing of a suite, and print its leaderboard."""
    from shoal.cli.compare.data import leaderboard_data
    from shoal.cli.compare.table import print_leaderboard
    from shoal.cli.options import given_changes
    from shoal.core.errors import ScenarioError
    from shoal.core.files import check_file
    from shoal.experiments.compiled_first import compiled_first
    from shoal.experiments.contenders import contenders, with_parameters
    from shoal.experiments.leaderboard import make_leaderboard
    from shoal.experiments.leaderboard_page import page_around, write_page
    from shoal.experiments.on_card import executor_on
    from shoal.experiments.suite import read_suite, resized, run_suite, suite_values
    from shoal.strategies import CATALOGUE
    from shoal.study.comparison_figure import leaderboard_figure
    from shoal.study.folder import store_folder

    suite = resized(read_suite(name), runs=runs, steps=steps, seed=seed)
    everybody, left = with_parameters(contenders(named or sorted(CATALOGUE)), given_changes(assignments))
    if left:
        problem = f"does not go with --suite: {name} has its own scenarios"
        raise ScenarioError(f"--set {next(iter(left))}", problem, "set a parameter of a strategy: encircle.ring=0.9")
    if markdown:
        page_around(markdown, name)  # refused before the runs, not after
        check_file(markdown)
    titles = [each.name for each in suite.conditions]

    def begin(title: str) -> None:
        note(f"{title} ({titles.index(title) + 1} of {len(titles)})")

    begun = time.monotonic()
    execute = compiled_first(executor_on(device, jobs), note)
    with store_folder(out) as folder, sweep_progress(out) as report:
        found = run_suite(suite, everybody, folder, executor=execute, begin=begin, report=report)
    tell_failures(row for strategies in found.values() for rows in strategies.values() for row in rows)
    board = make_leaderboard(suite, everybody, suite_values(suite, found))
    if markdown:
        write_page(board, markdown, named)
        note(f"page: {markdown}")
    if as_json:
        said = {each.name: dict(each.said) for each in everybody if each.said}
        write(json.dumps(leaderboard_data(board) | ({"parameters": said} if said else {})) + "\n")
    else:
        print_leaderboard(board)
    if figure:
        from shoal.drawing.files import save_figure

        save_figure(leaderboard_figure(board, width), figure)
        note(f"figure: {figure}")
    note(f"{time.monotonic() - begun:.0f} s" + (f"; all runs: a sweep per condition in {out}" if out else ""))
