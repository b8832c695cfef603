import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.conditions import conditions_of
from shoal.scenario.load import load

SCENARIO = load("oceans2020", steps=1000)


def test_without_a_name_there_is_the_scenario_as_it_is():
    (only,) = conditions_of([], "power", SCENARIO)
    assert (only.metric, only.changes) == ("power", {})


def test_of_the_arena_by_name_or_folder_what_happens_moves_with_the_steps():
    one, other = conditions_of(["half lost", "3-targets"], "time_on_target", SCENARIO)
    assert one.changes["losses"] == [{"step": 500, "count": 25}]
    assert (other.metric, other.out_of) == ("targets_observed", 3)
    assert conditions_of(["3 targets"], "power", SCENARIO)[0].metric == "power"


def test_changes_of_ones_own():
    (own,) = conditions_of(["target-speed=5,network.loss=0.2"], "time_on_target", SCENARIO)
    assert own.changes == {"target-speed": 5, "network.loss": 0.2}


@pytest.mark.parametrize(
    ("texts", "told"),
    [(["half losst"], "did you mean 'half lost'"), (["5 m/s", "5-m-s"], "is given twice")],
)
def test_what_is_none_is_refused(texts, told):
    with pytest.raises(ScenarioError, match=told):
        conditions_of(texts, "time_on_target", SCENARIO)


def test_those_of_the_arena_need_an_arena_of_its_size():
    with pytest.raises(ScenarioError, match="is of an arena of 20 m x 20 m"):
        conditions_of(["half lost"], "time_on_target", load("bay"))


def test_one_of_the_wide_arena_may_be_another_scenario():
    (bay,) = conditions_of(["bay"], "time_on_target", SCENARIO)
    assert (bay.scenario, bay.steps) == ("bay", 360)  # 7200 of 20,000 steps, as 1000 here
