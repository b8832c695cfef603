import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.fleet_range import FleetRange, check_fleets, parse_fleet
from shoal.scenario.load import load

SCENARIO = load("oceans2020")


def test_counts_and_the_cost_of_one():
    assert parse_fleet("BoB-1=0:30@3") == FleetRange("BoB-1", 0, 30, 3)
    assert parse_fleet("BoB-1=0:30") == FleetRange("BoB-1", 0, 30)
    assert parse_fleet("BoB-0=15@1.5").fixed
    assert parse_fleet("a=b=1:2") == FleetRange("a=b", 1, 2)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("BoB-1", "is not a fleet and its counts"),
        ("=3:4", "is not a fleet and its counts"),
        ("BoB-1=0:3.5@3", "is not a fleet and its counts"),
        ("BoB-1=0:30:5@3", "is not a fleet and its counts"),
        ("BoB-1=30:0@3", "30 to 0 agents"),
        ("BoB-1=-1:3@3", "-1 to 3 agents"),
        ("BoB-1=0:30@", "is not a number"),
        ("BoB-1=0:30@-2", "cannot cost -2"),
        ("BoB-1=0:30@inf", "cannot cost inf"),
    ],
)
def test_what_is_neither_is_refused(text, told):
    with pytest.raises(ScenarioError, match=told):
        parse_fleet(text)


@pytest.mark.parametrize(
    ("texts", "told"),
    [
        ([], "--fleet: is missing"),
        (["Bob-1=0:30@3"], "no such fleet\n  fix: did you mean 'BoB-1'"),
        (["BoB-1=0:30@3", "BoB-1=0:20@3"], "is given twice"),
        (["BoB-1=0:30@3"], r"fleet BoB-0: has no cost\n  fix: .*--fleet BoB-0=35@COST"),
        (["BoB-1=0:30", "BoB-0=0:45@1"], "fleet BoB-1: has no cost"),
        (["BoB-1=15@3", "BoB-0=35@1"], "nothing to choose"),
        (["BoB-1=0:1@3", "BoB-0=0@1"], "fewer than 2 agents"),
    ],
)
def test_what_is_no_choice_among_the_fleets_of_a_scenario_is_refused(texts, told):
    with pytest.raises(ScenarioError, match=told):
        check_fleets(list(map(parse_fleet, texts)), SCENARIO, costs=True)


def test_a_path_says_the_name_or_the_number_where_it_cannot():
    dotted = load("oceans2020", **{"fleets.0.name": "v1.5"})
    assert FleetRange("BoB-0", 0, 9).path(dotted, "count") == "fleets.BoB-0.count"
    assert FleetRange("v1.5", 0, 9).path(dotted, "count") == "fleets.0.count"
