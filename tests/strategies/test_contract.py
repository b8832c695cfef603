"""A strategy is one plain function in a file of the user's; it runs like our own."""

import math
from collections import namedtuple

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError, StrategyError
from shoal.metrics.summary import evaluate
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.load import load, scenario_from, to_toml
from shoal.strategies import CATALOGUE, strategy
from shoal.strategies.plugins import line_in

STEPS = 300
DRIFTER = '''"""Drift; keep apart; run to whoever is on target."""

import math
from typing import NamedTuple

import shoal


class Drifter(NamedTuple):
    turn_chance: float = 0.05
    spacing: shoal.Meters = 2.0
    hurry: float = 40.0


def keep_apart(me, other, params):
    dx, dy = me.x - other.x, me.y - other.y
    push = max(0.0, params.spacing / (math.hypot(dx, dy) + 1e-9) - 1.0)
    return push * dx, push * dy


@shoal.strategy("drifter", params=Drifter, memory={"heading": "rad", "turns": "1"}, influence=keep_apart)
def drift(me, heard, memory, params, draw):
    """Drift on, turn now and then."""
    if heard.found:
        return params.hurry * (heard.x - me.x), params.hurry * (heard.y - me.y)
    if shoal.uniform(draw, 0) < params.turn_chance:
        memory.heading = 2 * math.pi * shoal.uniform(draw, 1)
        memory.turns += 1
    return math.cos(memory.heading) + heard.sum_x, math.sin(memory.heading) + heard.sum_y
'''


@pytest.fixture(autouse=True)
def own_catalogue():
    """Every test adds to the catalogue that it found."""
    before = dict(CATALOGUE)
    yield
    CATALOGUE.clear()
    CATALOGUE.update(before)


def written(folder, text=DRIFTER, name="my_strategy.py"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def using(path, **options):
    return scenario("oceans2020", {"strategy": {"file": str(path), **options}, "steps": STEPS})


def refusal(folder, text, name="my_strategy.py"):
    with pytest.raises(StrategyError) as caught:
        using(written(folder, text, name))
    return caught.value.args


class TestLoading:
    """A file becomes a strategy of a scenario."""

    @pytest.mark.parametrize("name", ["team", "puppet"])
    def test_may_be_called_as_what_we_make_of_strategies_ourselves(self, tmp_path, name):
        chosen = using(written(tmp_path, DRIFTER.replace('"drifter"', f'"{name}"')))
        assert chosen.strategy.name == name
        assert scenario_from(chosen.model_dump(mode="json")) == chosen

    def test_with_its_name_its_parameters_and_its_source(self, tmp_path):
        choice = using(written(tmp_path)).strategy
        assert choice.name == "drifter"
        assert choice.params == {"turn_chance": 0.05, "spacing": 2.0, "hurry": 40.0}
        assert len(choice.source) == 16

    def test_is_catalogued_with_its_first_line(self, tmp_path):
        path = written(tmp_path, DRIFTER + f"# {tmp_path}\n")
        known = using(path).strategy.owner
        assert (known.summary, known.source, known.builtin) == ("Drift on, turn now and then.", str(path), False)
        assert known.memory == {"heading": "rad", "turns": "1"}

    def test_parameters_are_checked_and_converted_like_our_own(self, tmp_path):
        path = written(tmp_path)
        assert using(path, spacing="10 ft").strategy.params["spacing"] == 3.048
        for options, reason in (
            ({"spacin": 1}, "spacing"),
            ({"hurry": "much"}, "hurry"),
            ({"hurry": math.nan}, "finite"),
        ):
            with pytest.raises(ScenarioError, match=reason):
                using(path, **options)

    @pytest.mark.parametrize("old", ["def keep_apart", "def drift"])
    def test_of_functions_that_are_kernels_already(self, tmp_path, old):
        assert using(written(tmp_path, DRIFTER.replace(old, f"@shoal.kernel\n{old}"))).strategy.name == "drifter"

    def test_beside_the_scenario_that_names_it(self, tmp_path):
        written(tmp_path)
        text = to_toml(scenario()).replace('name = "knn-pso"', 'file = "my_strategy.py"')
        text = "\n".join(line for line in text.splitlines() if line.split(" ")[0] not in scenario().strategy.params)
        (tmp_path / "my.toml").write_text(text, encoding="utf-8")
        assert load(tmp_path / "my.toml").strategy.name == "drifter"

    def test_survives_the_round_trip_through_toml(self, tmp_path):
        chosen = using(written(tmp_path), hurry=3.0)
        (tmp_path / "my.toml").write_text(to_toml(chosen), encoding="utf-8")
        again = load(tmp_path / "my.toml")
        assert again == chosen
        assert again.hash == chosen.hash

    def test_where_the_file_lies_does_not_matter(self, tmp_path):
        (tmp_path / "elsewhere").mkdir()
        assert using(written(tmp_path)).hash == using(written(tmp_path / "elsewhere")).hash


class TestRunning:
    """In the engine, compiled."""

    def test_is_deterministic_below_the_top_speed_with_a_memory_of_its_own(self, tmp_path):
        """One test, for the engine is compiled for it: seconds."""
        chosen = using(written(tmp_path))
        before = Simulation(scenario())
        before.advance(50)
        simulation = Simulation(chosen)
        frames = simulation.advance(STEPS, every=1)
        top = np.repeat([2.6, 1.0], [15, 35]) * (1 + 1e-12)
        assert (np.hypot(frames.vx[2:], frames.vy[2:]) <= top).all()
        assert np.abs([frames.x[1:], frames.y[1:]]).max() <= 8.5
        assert np.isfinite(list(frames.arrays().values())[1:5]).all()
        assert frames.on_target.any()
        assert evaluate("time_on_target", simulation.tally, facts_of(chosen))[0] > 0.1

        turns = frames.memory["turns"]
        assert (np.diff(turns, axis=0) >= 0).all()
        assert turns[-1].sum() / (50 * STEPS) == pytest.approx(0.05, rel=0.5)  # fewer: chasing agents do not draw
        assert ((frames.memory["heading"] >= 0) & (frames.memory["heading"] < 2 * math.pi)).all()

        again = Simulation(chosen)
        for chunk in (1, 99, 200):
            again.advance(chunk)
        for one, other in zip(simulation.swarm, again.swarm, strict=True):
            assert one.tobytes() == other.tobytes()
        other_run = Simulation(chosen, run=1)
        other_run.advance(STEPS)
        assert other_run.swarm.x.tobytes() != simulation.swarm.x.tobytes()

        slower = Simulation(using(tmp_path / "my_strategy.py", turn_chance=0.0))
        slower.advance(STEPS)
        assert not slower.memories.memory["turns"].any()

        after = Simulation(scenario())
        after.advance(50)
        assert after.swarm.x.tobytes() == before.swarm.x.tobytes()  # our own strategy never noticed

    @pytest.mark.slow
    def test_an_edited_file_gives_new_numbers(self, tmp_path):
        ends = []
        for text in (DRIFTER, DRIFTER.replace("math.cos(memory", "0.5 * math.cos(memory")):
            simulation = Simulation(using(written(tmp_path, text)))
            simulation.advance(STEPS)
            ends.append(simulation.swarm.x.tobytes())
        assert ends[0] != ends[1]


class TestEditing:
    """Another text is another strategy."""

    def edited(self, folder):
        return written(folder, DRIFTER.replace("hurry: float = 40.0", "hurry: float = 7.0"))

    def test_an_edited_file_has_another_source_and_hash_and_is_used(self, tmp_path):
        first = using(written(tmp_path))
        second = using(self.edited(tmp_path))
        assert first.strategy.source != second.strategy.source
        assert first.hash != second.hash
        assert (first.strategy.params["hurry"], second.strategy.params["hurry"]) == (40.0, 7.0)

    def test_a_comment_is_an_edit_too(self, tmp_path):
        assert using(written(tmp_path)).hash != using(written(tmp_path, DRIFTER + "# why\n")).hash

    def test_a_saved_scenario_insists_on_the_source_it_was_made_with(self, tmp_path):
        table = using(written(tmp_path)).model_dump(mode="json")
        self.edited(tmp_path)
        with pytest.raises(StrategyError, match="is not the file that this scenario was made with"):
            scenario_from(table)

    def test_an_edit_undone_is_the_first_version_again(self, tmp_path):
        using(written(tmp_path))
        using(self.edited(tmp_path))
        assert using(written(tmp_path)).strategy.params["hurry"] == 40.0

    def test_a_scenario_loaded_before_the_edit_keeps_its_strategy(self, tmp_path):
        first = using(written(tmp_path))
        kind = type(first.strategy.kernel_params())
        self.edited(tmp_path)
        using(tmp_path / "my_strategy.py")
        assert type(first.strategy.kernel_params()) is kind


class TestErrors:
    """Each says which file, what is wrong, and how to fix it."""

    def test_no_file(self, tmp_path):
        with pytest.raises(StrategyError) as caught:
            using(tmp_path / "nowhere.py")
        where, problem, fix = caught.value.args
        assert where == str(tmp_path / "nowhere.py")
        assert problem == "cannot be read: No such file or directory"
        assert fix == "name a Python file"

    def test_a_syntax_error_has_its_line(self, tmp_path):
        where, problem, _ = refusal(tmp_path, "import math\n\n\ndef broken(:\n")
        assert where == f"{tmp_path / 'my_strategy.py'}:4"
        assert problem.startswith("SyntaxError")

    def test_an_error_while_it_loads_has_its_line(self, tmp_path):
        where, problem, _ = refusal(tmp_path, "import math\n\nmath.sine(1)\n")
        assert where == f"{tmp_path / 'my_strategy.py'}:3"
        assert "sine" in problem

    def test_no_strategy_in_it(self, tmp_path):
        where, problem, fix = refusal(tmp_path, "x = 1\n")
        assert where == str(tmp_path / "my_strategy.py")
        assert problem == "defines no strategy"
        assert "@shoal.strategy" in fix

    def test_two_strategies_and_none_named(self, tmp_path):
        both = DRIFTER + DRIFTER.replace("Drifter", "Other").replace('"drifter"', '"other"')
        _, problem, fix = refusal(tmp_path, both)
        assert problem == "defines drifter, other"
        assert "name =" in fix

    def test_a_name_that_it_does_not_define(self, tmp_path):
        with pytest.raises(StrategyError, match="defines drifter"):
            using(written(tmp_path), name="drifted")

    def test_a_built_in_cannot_be_redefined(self, tmp_path):
        ours = CATALOGUE["knn-pso"]
        _, problem, fix = refusal(tmp_path, DRIFTER.replace('"drifter"', '"knn-pso"'))
        assert problem == "redefines the built-in strategy 'knn-pso'"
        assert "name of its own" in fix
        assert CATALOGUE["knn-pso"] is ours

    def test_a_parameter_without_default(self, tmp_path):
        _, problem, fix = refusal(tmp_path, DRIFTER.replace("turn_chance: float = 0.05", "turn_chance: float"))
        assert problem == "parameter 'turn_chance' has no default"
        assert "turn_chance" in fix

    def test_an_error_of_the_decorator_names_the_file_too(self, tmp_path):
        where, _, _ = refusal(tmp_path, DRIFTER.replace("turn_chance: float = 0.05", "turn_chance: float"))
        assert str(tmp_path / "my_strategy.py") in where

    @pytest.mark.slow
    def test_a_function_that_cannot_be_compiled(self, tmp_path):
        chosen = using(written(tmp_path, DRIFTER.replace("if heard.found:", "if heard.target_x > 0.0:")))
        with pytest.raises(StrategyError, match="target_x"):
            Simulation(chosen).advance(1)

    @pytest.mark.slow
    @pytest.mark.parametrize(
        ("line", "says"),
        [
            ("raise ValueError('no')", r":\d+: strategy 'drifter' raised ValueError: no"),
            ("memory.course = 1.0", "'course' is not a field of a memory"),
            ("return 1.0", "returns two numbers"),
        ],
    )
    def test_a_function_that_fails_as_it_is_compiled_or_run(self, tmp_path, line, says):
        head, body = DRIFTER.split("    if heard.found:", 1)
        broken = f"{head}    if me.time >= 0.0:\n        {line}\n    if heard.found:{body}"
        with pytest.raises(StrategyError, match=says):
            Simulation(using(written(tmp_path, broken))).advance(1)

    @pytest.mark.parametrize("compiled_as", ["/new/mine.py", "/old/mine.py"])
    def test_a_line_is_found_where_kept_machine_code_knows_the_file_by_its_path_of_old(self, compiled_as):
        with pytest.raises(ZeroDivisionError) as raised:
            exec(compile("\n\n1 / 0", compiled_as, "exec"))
        assert line_in(raised.tb, "/new/mine.py") == 3
        assert line_in(raised.tb, "/new/other.py") is None

    def test_a_function_of_other_arguments(self):
        with pytest.raises(StrategyError, match=r"(?s)decide takes 2 arguments.*me, heard, memory, params, draw"):
            strategy("mine", params=namedtuple("Mine", []))(lambda me, heard: (0.0, 0.0))

    def test_a_file_that_ends_the_program(self, tmp_path):
        assert "SystemExit" in refusal(tmp_path, "raise SystemExit(0)\n")[1]

    def test_parameters_that_are_no_named_tuple(self):
        with pytest.raises(StrategyError, match="is not a NamedTuple"):
            strategy("mine", params=dict)(lambda me, heard, memory, params, draw: (0.0, 0.0))

    def test_two_strategies_with_one_class_of_parameters(self, tmp_path):
        """The class decides whose functions run."""
        assert "Drifter" in refusal(tmp_path, DRIFTER + "\n\nshoal.strategy('other', params=Drifter)(keep_apart)\n")[1]

    def test_a_file_that_is_no_python(self, tmp_path):
        assert refusal(tmp_path, "x = 2\n", "my_strategy.txt")[1] == "is not a Python file"

    def test_a_file_that_fails_leaves_no_strategy_behind(self, tmp_path):
        refusal(tmp_path, DRIFTER + "\n1 / 0\n")
        assert "drifter" not in CATALOGUE
