"""Commands of a scenario: who goes by what, and what nobody can obey."""

import pytest

from scenarios import scenario, small
from shoal.core.errors import ScenarioError
from shoal.scenario.commands import Command
from shoal.scenario.crew import crew_of
from shoal.scenario.instructions import Instructions, changed
from shoal.scenario.load import load, to_toml
from shoal.scenario.schema import Scenario

HOLD = {"step": 5, "order": "hold"}


def with_commands(*commands):
    return scenario("oceans2020", {"commands": list(commands)})


class TestInstructions:
    """What each agent goes by after a command that sets fields."""

    def test_neighbors_of_some(self):
        chosen = small(6, 5)
        instructions = Instructions.of(chosen).after(Command(step=1, set={"neighbors": 3}, agents=(2, 4)))
        assert instructions.degrees(crew_of(chosen)) == [5, 5, 3, 5, 3, 5]

    def test_the_last_word_counts_however_it_is_spelled(self):
        chosen = small(6, 5)
        instructions = Instructions.of(chosen).after(Command(step=1, set={"network.neighbors": 3}))
        assert instructions.after(Command(step=2, set={"neighbors": 4})).degrees(crew_of(chosen)) == [4] * 6

    def test_a_parameter_of_all_is_another_number_of_the_same_strategy(self):
        chosen = small(6, 5)
        crew = Instructions.of(chosen).after(Command(step=1, set={"strategy.delta": 0.5})).crew(crew_of(chosen))
        assert type(crew.params) is type(crew_of(chosen).params)
        assert crew.params.delta == 0.5

    def test_a_parameter_of_some_makes_a_team(self):
        chosen = small(6, 5)
        crew = (
            Instructions.of(chosen)
            .after(Command(step=1, set={"strategy.delta": 0.5}, agents=(2,)))
            .crew(crew_of(chosen))
        )
        first, rest = crew.params.first, crew.params.rest
        assert (crew.params.until, rest.until) == (2, 3)
        assert (first.delta, rest.first.delta, rest.rest.delta) == (first.delta, 0.5, first.delta)

    def test_of_all_of_a_fleet(self):
        chosen = load("oceans2020")
        instructions = Instructions.of(chosen).after(Command(step=1, set={"fleets.BoB-1.neighbors": 7}))
        assert instructions.degrees(crew_of(chosen)) == [7] * 15 + [20] * 35


class TestRefusals:
    """One sentence that says which command, and why."""

    @pytest.mark.parametrize(
        ("command", "words"),
        [
            ({"step": 5}, "has an order, or fields to set"),
            ({**HOLD, "set": {"neighbors": 3}}, "has an order, or fields to set"),
            ({**HOLD, "step": 0}, "commands.0.step: 0: input should be greater than 0"),
            ({**HOLD, "order": "sink"}, "'hold', 'recall' or 'resume'"),
            ({**HOLD, "agents": [50]}, "agents are 0 to 49"),
            ({**HOLD, "agents": [3, 3]}, "names one twice"),
            ({**HOLD, "agents": [-1]}, "greater than or equal to 0"),
            ({"steps": 5, "order": "hold"}, "did you mean 'step'?"),
            ({"step": 5, "set": {"area.width": 3.0}}, "area.width: cannot change on the way"),
            ({"step": 5, "set": {"strategy.name": "lattice"}}, "cannot change on the way"),
            ({"step": 5, "set": {"fleets.BoB-1.max_speed": 3.0}}, "cannot change on the way"),
            ({"step": 5, "set": {"strategy.delta": -1}}, "greater than or equal to 0"),
            ({"step": 5, "set": {"strategy.detla": 1}}, "did you mean 'delta'?"),
            ({"step": 5, "set": {"neighbors": 60}}, "50 agents can hear at most 49"),
            ({"step": 5, "set": {"fleets.BoB-9.neighbors": 6}}, "no entry 'BoB-9'"),
            ({"step": 5, "set": {"neighbors": [3]}}, "commands.0.set"),
        ],
    )
    def test_of_one(self, command, words):
        with pytest.raises(ScenarioError, match="commands") as caught:
            with_commands(command)
        assert words in str(caught.value)

    def test_of_one_after_the_other(self):
        every_other = [{"step": 5, "set": {"strategy.delta": 0.5}, "agents": list(range(0, 20, 2))}]
        with pytest.raises(ScenarioError, match="changes more than 7 times"):
            with_commands(*every_other)

    def test_of_k_that_adapts(self):
        with pytest.raises(ScenarioError, match="k adapts by itself"):
            changed(scenario("oceans2020", {"network.adaptive": {}}), {"neighbors": 3})

    def test_of_parameters_in_a_scenario_of_another_scale(self):
        chosen = with_commands({"step": 5, "set": {"strategy.delta": 0.5}})
        with pytest.raises(ScenarioError, match="keep their size"):
            chosen.scaled(2.0)
        assert with_commands({"step": 5, "set": {"neighbors": 5}}).scaled(2.0).commands[0].set == {"neighbors": 5}


def test_a_scenario_without_commands_keeps_its_hash():
    assert "commands" not in load("oceans2020").choices
    assert with_commands(HOLD).hash != load("oceans2020").hash


def test_there_and_back(tmp_path):
    chosen = with_commands(HOLD, {"step": 7, "set": {"strategy.delta": 0.5, "neighbors": "all"}, "agents": [3]})
    file = tmp_path / "mine.toml"
    file.write_text(to_toml(chosen))
    assert load(file) == chosen
    assert isinstance(chosen, Scenario)
    assert [each.words for each in chosen.commands] == ["hold", "set strategy.delta = 0.5, neighbors = all"]
