import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.condition_point import followed_point
from shoal.scenario.load import load

HERE = load("oceans2020", strategy="encircle")
SPARSE = load("oceans2020", strategy="encircle", **{"area.width": 40.0, "area.height": 40.0})
WIDE = load("oceans2020", strategy="encircle", **{"targets.0.radius": 2.0})


def follow(point, there, here=HERE):
    return followed_point(point, lambda: here, lambda: there)


@pytest.mark.parametrize(
    ("field", "there", "times"),
    [
        ("chase", SPARSE, 2.0),  # follows the spacing
        ("chase", WIDE, 1.0),
        ("ring", WIDE, 2.0),  # follows the reach
        ("ring", SPARSE, 1.0),
        ("push", SPARSE, 1.0),  # a number
    ],
)
def test_what_follows_a_length_is_as_many_times_longer_as_that_is_under_the_condition(field, there, times):
    point = {f"strategy.{field}": 0.7, "neighbors": 9}
    assert follow(point, there) == {f"strategy.{field}": pytest.approx(0.7 * times), "neighbors": 9}


def test_of_one_fleet_by_name_or_number():
    own = {"fleets.BoB-0.strategy": "cordon"}
    here, there = HERE.with_(**own), SPARSE.with_(**own)
    for fleet in ("BoB-0", next(str(n) for n, each in enumerate(HERE.fleets) if each.name == "BoB-0")):
        assert follow({f"fleets.{fleet}.strategy.span": 3.0}, there, here).popitem()[1] == pytest.approx(6.0)
    with pytest.raises(ScenarioError, match="names no fleet"):
        follow({"fleets.swift.strategy.span": 3.0}, there, here)


def test_without_parameters_no_scenario_is_made():
    assert followed_point({"neighbors": 5}, pytest.fail, pytest.fail) == {"neighbors": 5}
