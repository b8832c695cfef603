"""What fleets were given is said once, or of each."""

import shoal
from shoal.scenario.choices import degree_text, strategy_text


def scenario(*fleets, **network):
    return shoal.load(
        "oceans2020",
        fleets=[{"name": name, "count": 20, "max_speed": 1.0, **own} for name, own in fleets],
        **{f"network.{name}": value for name, value in network.items()},
    )


class TestChoices:
    """Strategies and degrees."""

    def test_what_all_have_is_said_once(self):
        known = scenario(("scouts", {}), ("relays", {}))
        assert (strategy_text(known), degree_text(known)) == ("knn-pso", "20")

    def test_what_differs_is_said_of_each(self):
        known = scenario(("scouts", {"strategy": {"name": "lattice"}}), ("relays", {"neighbors": "all"}))
        assert strategy_text(known) == "lattice (scouts), knn-pso (relays)"
        assert degree_text(known) == "20 (scouts), all (relays)"

    def test_the_scenarios_own_strategy_is_not_said_where_no_fleet_follows_it(self):
        assert strategy_text(scenario(("scouts", {"strategy": {"name": "lattice"}}), neighbors=5)) == "lattice"

    def test_a_degree_that_adapts_is_a_range(self):
        known = scenario(
            ("scouts", {"count": 40, "neighbors": 3}), adaptive={"fewest": 10, "most": 25, "patience": 10.0}
        )
        assert degree_text(known) == "10 to 25 (adaptive)"
