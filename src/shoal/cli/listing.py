"""shoal presets, shoal strategies: what there is."""

import json
import sys
from typing import Annotated

from cyclopts import Parameter
from rich.console import Console
from rich.table import Table


def presets() -> None:
    """List the scenarios that come with Shoal."""
    from shoal.scenario.load import load
    from shoal.scenario.load import presets as names

    _print_rows([(name, load(name).description) for name in names()])


def strategies(*, json_: Annotated[bool, Parameter(name="--json", negative=())] = False) -> None:
    """List the strategies that come with Shoal.

    Parameters
    ----------
    json_
        Print a JSON list with every parameter, its default and its unit.
    """
    from shoal.scenario.strategy_choice import params_model
    from shoal.strategies import CATALOGUE

    known = [CATALOGUE[name] for name in sorted(CATALOGUE)]
    if json_:
        rows = [
            {
                "name": each.name,
                "summary": each.summary,
                "memory": each.memory,
                "parameters": params_model(each).model_json_schema()["properties"],
            }
            for each in known
        ]
        sys.stdout.write(json.dumps(rows) + "\n")
    else:
        _print_rows([(each.name, each.summary) for each in known])


def _print_rows(rows: list[tuple[str, str]]) -> None:
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for row in rows:
        table.add_row(*row)
    Console(file=sys.stdout, highlight=False).print(table)
