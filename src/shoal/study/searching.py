"""What tuning and designing have in common: words of a call or a command into variables, and rows for tables."""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.experiments.asker import require_optuna
from shoal.experiments.variable import Variable, variable_of
from shoal.scenario.change import change
from shoal.scenario.load import Source, load, name_of_source, scenario_from, table_of
from shoal.scenario.schema import Scenario
from shoal.study.varied import written

_ALWAYS = ("time_on_target", "cost")  # known whatever a scenario counts


def variables_of(vary: Mapping[str, Any]) -> list[Variable]:
    """Return what varies: a range as text ("0.002:0.05") or as a tuple of two ends, or values one by one.

    Raises
    ------
    ScenarioError : `vary` is not a mapping, or a field has neither
    """
    if not isinstance(vary, Mapping) or not all(isinstance(name, str) for name in vary):
        raise ScenarioError("vary", f"is {vary!r:.60}", 'write vary={"neighbors": (5, 40)}')
    return [
        variable_of(name if "." in name else name.replace("-", "_"), _plain(values), f"vary {name}")
        for name, values in vary.items()
    ]


def base_scenario(scenario: Source, changes: Mapping[str, Any]) -> Scenario:
    """Return the scenario that is searched, changed, validated; refuse a search without optuna first.

    Raises
    ------
    ScenarioError, TrackError, StrategyError : it cannot run
    MissingExtraError : optuna is not installed
    """
    require_optuna()
    return scenario_from(change(table_of(scenario), changes), where=name_of_source(scenario))


def check_counted(scenario: Scenario, metrics: Iterable[str]) -> None:
    """Refuse to look for a metric that a scenario does not count, as it has chosen others.

    Raises
    ------
    ScenarioError : it names the metric
    """
    for name in metrics:
        if scenario.metrics and name not in (*scenario.metrics, *_ALWAYS):
            fix = f"add it: metrics={','.join([*scenario.metrics, name])}, or leave out metrics"
            raise ScenarioError("metrics", f"leaves out {name}, which is looked for", fix)


def called(scenario: Source) -> str:
    """What results call a scenario."""
    return str(scenario) if isinstance(scenario, (str, Path)) else load(scenario).name


def shown(value: Any) -> str:
    """A value in a table."""
    if value is None:
        return "not set"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _plain(values: Any) -> Any:
    if isinstance(values, str):
        return values
    if isinstance(values, tuple):
        return tuple(written(each) for each in values)
    return [written(each) for each in values] if isinstance(values, Iterable) else values
