"""An objective: a metric, and whether more or less of it is looked for."""

from dataclasses import dataclass

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.metrics.summary import METRICS, Bounds, bounds_of
from shoal.record.names import label_of


@dataclass(frozen=True)
class Objective:
    """A metric and its direction: 1 more is looked for, -1 less."""

    metric: str
    direction: int

    @property
    def optuna(self) -> str:
        """The direction in optuna's words."""
        return "maximize" if self.direction > 0 else "minimize"

    @property
    def words(self) -> str:
        """The metric in tables and figures, its unit behind it."""
        return label_of(self.metric)

    @property
    def bounds(self) -> Bounds:
        """Between which values it lies."""
        return bounds_of(self.metric)


def objective(metric: str, direction: int) -> Objective:
    """Return the objective of more (1) or less (-1) of a metric.

    Raises
    ------
    ScenarioError : no such metric, or the other direction is the better one
    """
    word, other = ("--maximize", "--minimize")[:: 1 if direction > 0 else -1]
    if metric not in METRICS:
        hint = did_you_mean(metric, METRICS)
        raise ScenarioError(f"{word} {metric}", "is not a metric", f"{hint}there are: {', '.join(METRICS)}")
    if METRICS[metric].direction == -direction:
        better = METRICS[metric].better
        raise ScenarioError(f"{word} {metric}", f"looks for the worse: {better} is better", f"write {other} {metric}")
    return Objective(metric, direction)


def one_objective(maximize: str | None, minimize: str | None) -> Objective:
    """Return the one objective that was said.

    Raises
    ------
    ScenarioError : none or both were, or it is none
    """
    if maximize is None and minimize is None:
        raise ScenarioError("--maximize", "is missing", "say what is looked for: --maximize time_on_target")
    if maximize is not None and minimize is not None:
        fix = "leave out one of them; `shoal design` weighs a cost against a metric"
        raise ScenarioError("--maximize and --minimize", "are two objectives", fix)
    return objective(maximize, 1) if maximize is not None else objective(str(minimize), -1)
