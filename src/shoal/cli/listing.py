"""shoal presets, shoal strategies, shoal metrics: what there is."""

import json
from typing import Annotated

from cyclopts import Parameter
from rich.table import Table
from rich.text import Text

from shoal.cli.console import print_table, results_console, small_print, styled
from shoal.cli.output import write
from shoal.cli.progress import note


def presets() -> None:
    """List the scenarios that come with Shoal."""
    from shoal.study.listing import list_presets

    _print_rows([(each.name, styled(each.description, "")) for each in list_presets()])


def strategies(*, json_: Annotated[bool, Parameter(name="--json", negative=())] = False) -> None:
    """List the strategies that come with Shoal or with installed packages.

    Parameters
    ----------
    json_
        Print a JSON list with every parameter, its default and its unit.
    """
    from shoal.scenario.strategy_choice import params_model
    from shoal.strategies import CATALOGUE, RECOMMENDED
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
                "recommended": each.builtin and each.name == RECOMMENDED,
                "hears_all": each.hears_all,
                "tells": each.told,
                "memory": each.memory,
                "parameters": params_model(each).model_json_schema()["properties"],
            }
            for each in known
        ]
        write(json.dumps(rows) + "\n")
    else:
        _print_rows([(each.name, small_print(each.summary, each.reference or each.source)) for each in known])


def metrics(*, json_: Annotated[bool, Parameter(name="--json", negative=())] = False) -> None:
    """List what is measured, of installed packages too: what tables call it, its unit and what it means.

    Parameters
    ----------
    json_
        Print a JSON list instead.
    """
    from shoal.metrics.summary import METRICS
    from shoal.record.names import label_of
    from shoal.study.listing import list_metrics

    if json_:
        write(json.dumps([each._asdict() for each in list_metrics()]) + "\n")
    else:
        rows = [(name, small_print(label_of(name), each.sentence)) for name, each in METRICS.items()]
        _print_rows(rows)
        note("each is defined in docs/reference/metrics.md; --set metrics=NAME,NAME measures these alone")


def _print_rows(rows: list[tuple[str, Text]]) -> None:
    table = Table(box=None, padding=(0, 2, 0, 0), show_header=False)
    for name, text in rows:
        table.add_row(name, text)
    print_table(results_console(), table)
