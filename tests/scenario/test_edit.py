"""Changes to a scenario's raw table: so many agents, whatever k was."""

import pytest

from shoal.cli.main import run_command
from shoal.core.errors import ScenarioError
from shoal.scenario.edit import apply
from shoal.scenario.load import read_table, scenario_from


def changed(changes, **network):
    table = read_table("oceans2020")
    table["network"] |= network
    return scenario_from(apply(table, changes))


class TestAgents:
    """Fleets of 5 to 500 under one scenario."""

    @pytest.mark.parametrize(("agents", "k"), [(2, 1), (5, 4), (20, 19), (21, 20), (50, 20), (500, 20)])
    def test_k_is_lowered_to_the_number_of_others(self, agents, k):
        chosen = changed({"agents": agents})
        assert (chosen.agents, chosen.network.neighbors) == (agents, k)

    def test_in_the_shares_of_the_fleets(self):
        assert [fleet.count for fleet in changed({"agents": 500}).fleets] == [150, 350]
        assert [fleet.count for fleet in changed({"agents": 5}).fleets] == [2, 3]

    def test_all_stays_all(self):
        assert changed({"agents": 5}, neighbors="all").network.neighbors == "all"

    def test_limits_of_an_adaptive_k_and_of_fleets_are_lowered_too(self):
        adaptive = {"fewest": 10, "most": 25}
        table = read_table("oceans2020")
        table["network"]["adaptive"], table["fleets"][0]["neighbors"] = adaptive, 30
        chosen = scenario_from(apply(table, {"agents": 12}))
        assert (chosen.network.adaptive.fewest, chosen.network.adaptive.most) == (10, 11)
        assert chosen.fleets[0].neighbors == 11
        assert adaptive == {"fewest": 10, "most": 25}

    def test_those_who_join_later_can_be_heard(self):
        table = read_table("oceans2020") | {"joins": [{"step": 5, "count": 10, "fleet": "BoB-0"}]}
        assert scenario_from(apply(table, {"agents": 5})).network.neighbors == 14

    @pytest.mark.parametrize("order", [("agents", "neighbors"), ("neighbors", "agents")])
    def test_a_k_that_is_asked_for_is_not_lowered(self, order):
        changes = {"agents": 5, "neighbors": 20}
        with pytest.raises(ScenarioError, match="5 agents can hear at most 4"):
            changed({name: changes[name] for name in order})

    @pytest.mark.parametrize("order", [("agents", "fast"), ("fast", "agents")])
    def test_fast_ones_are_counted_among_so_many(self, order):
        changes = {"agents": 40, "fast": 10}
        chosen = changed({name: changes[name] for name in order})
        assert [fleet.count for fleet in chosen.fleets] == [10, 30]

    def test_the_command_line_says_so(self, capsys):
        assert run_command(["run", "oceans2020", "--agents", "5", "--steps", "10", "--json"]) == 0
        assert "k is 4 instead of 20: 5 agents have no more neighbors" in capsys.readouterr().err
        assert run_command(["run", "oceans2020", "--agents", "500", "--steps", "10", "--json"]) == 0
        assert "instead of" not in capsys.readouterr().err
        assert run_command(["run", "oceans2020", "--agents", "5", "-k", "20"]) == 2

    @pytest.mark.parametrize("fleets", [None, 3, [], ["a"], [{"name": "a"}], [{"count": "3"}], [{"count": 0}]])
    @pytest.mark.parametrize("change", [{"agents": 5}, {"fast": 1}])
    def test_without_fleets_there_is_one_error(self, fleets, change):
        with pytest.raises(ScenarioError, match="needs fleets"):
            apply({"fleets": fleets}, change)


class TestBrokenTables:
    """What is wrong already is refused, not walked into."""

    @pytest.mark.parametrize("path", ["network.neighbors", "fleets.0.count", "area.width", "network.adaptive.most"])
    @pytest.mark.parametrize("wrong", [3, "text", ["a"]])
    def test_a_path_through_no_table(self, path, wrong):
        table = read_table("oceans2020")
        table[path.split(".")[0]] = wrong
        with pytest.raises(ScenarioError):
            apply(table, {path: 3})

    @pytest.mark.parametrize("targets", [3, "speed", ["speed"], [{"kind": "still"}]])
    def test_targets_without_a_speed(self, targets):
        with pytest.raises(ScenarioError, match="no target of this scenario has a speed"):
            apply({"targets": targets}, {"target-speed": 3.0})


def test_a_strategy_of_a_fleet_is_known_by_its_source_not_by_its_place(tmp_path):
    """The hash of a scenario does not depend on where files lie."""
    text = (
        "from typing import NamedTuple\nimport shoal\nclass P(NamedTuple):\n    a: float = 1.0\n"
        "@shoal.strategy('stay', params=P)\ndef stay(me, heard, memory, params, draw):\n    return 0.0, 0.0\n"
    )
    hashes = set()
    for folder in ("one", "other"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "stay.py").write_text(text)
        table = read_table("oceans2020")
        table["fleets"][0]["strategy"] = {"file": str(tmp_path / folder / "stay.py")}
        hashes.add(scenario_from(table).hash)
    assert len(hashes) == 1
