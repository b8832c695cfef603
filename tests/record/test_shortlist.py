"""Eight metrics that matter most; those that a scenario names, or asks for by a battery or a cost, are among them."""

import shoal
from shoal.record.shortlist import MOST, shortlist


def of(**changes):
    return shortlist(shoal.simulate("oceans2020", steps=50, **changes))


def test_eight_in_the_order_of_the_table():
    assert of() == [
        "time_on_target", "engaged", "xi", "first_detection", "losses", "reacquisition", "coverage", "speed",
    ]  # fmt: skip


def test_what_the_scenario_asks_for_is_among_them():
    priced = of(**{"fleets.0.cost": 3.0, "fleets.1.cost": 1.0})
    assert len(priced) == MOST
    assert "cost" in priced
    assert priced[:2] == ["time_on_target", "engaged"]


def test_metrics_that_a_scenario_names_are_all_there():
    names = ["time_on_target", "clustering", "closest"]
    assert sorted(of(metrics=names)) == sorted(names)
