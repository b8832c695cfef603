import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.objective import objective, one_objective


@pytest.mark.parametrize(
    ("maximize", "minimize", "told"),
    [
        (None, None, "is missing"),
        ("time_on_target", "cost", "are two objectives"),
        ("time_on_targt", None, "did you mean 'time_on_target'"),
        (None, "time_on_target", "higher is better\n  fix: write --maximize time_on_target"),
        ("power", None, "lower is better\n  fix: write --minimize power"),
    ],
)
def test_what_is_no_objective_is_refused(maximize, minimize, told):
    with pytest.raises(ScenarioError, match=told):
        one_objective(maximize, minimize)


def test_of_a_metric_that_is_neither_better_high_nor_low_both_are_objectives():
    assert objective("xi", 1).direction == 1
    assert objective("xi", -1).optuna == "minimize"
