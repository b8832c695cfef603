"""shoal presets, shoal strategies: what there is."""

import json
import sys
from typing import Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shoal.cli.progress import note


def presets() -> None:
    """List the scenarios that come with Shoal."""
    from shoal.scenario.load import load
    from shoal.scenario.load import presets as names

    _print_rows([(name, escape(load(name).description)) for name in names()])


def strategies(*, json_: Annotated[bool, Parameter(name="--json", negative=())] = False) -> None:
    """List the strategies that come with Shoal or with installed packages.

    Parameters
    ----------
    json_
        Print a JSON list with every parameter, its default and its unit.
    """
    from shoal.scenario.strategy_choice import params_model
    from shoal.strategies import CATALOGUE
    from shoal.strategies.installed import load_all_installed

    for error in load_all_installed():
        note(str(error))
    known = [CATALOGUE[name] for name in sorted(CATALOGUE)]
    if json_:
        rows = [
            {
                "name": each.name,
                "summary": each.summary,
                "reference": each.reference,
                "builtin": each.builtin,
                "informed": each.informed,
                "hears_all": each.hears_all,
                "tells": each.told,
                "memory": each.memory,
                "parameters": params_model(each).model_json_schema()["properties"],
            }
            for each in known
        ]
        sys.stdout.write(json.dumps(rows) + "\n")
    else:
        _print_rows(
            [
                (each.name, f"{escape(each.summary)}\n[dim]{escape(each.reference or each.source)}[/dim]")
                for each in known
            ]
        )


def _print_rows(rows: list[tuple[str, str]]) -> None:
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for name, text in rows:
        table.add_row(name, text)
    Console(file=sys.stdout, highlight=False).print(table)
