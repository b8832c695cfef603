"""What fleets were given is said once, or of each."""

from shoal.scenario.choices import degree_text, strategy_text


def scenario(*fleets, **network):
    return {
        "strategy": {"name": "knn-pso"},
        "network": {"neighbors": 20, "adaptive": None, **network},
        "fleets": [{"name": name, "strategy": None, "neighbors": None, **own} for name, own in fleets],
    }


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
        assert strategy_text(scenario(("scouts", {"strategy": {"name": "lattice"}}))) == "lattice"

    def test_a_degree_that_adapts_is_a_range(self):
        known = scenario(("scouts", {"neighbors": 3}), adaptive={"fewest": 10, "most": 25, "patience": 10.0})
        assert degree_text(known) == "10 to 25 (adaptive)"
