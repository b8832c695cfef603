"""Any scenario that is accepted runs; any other ends in one clear error."""

import copy
import math
import tomllib
from datetime import date

import numpy as np
import pytest
import tomli_w

from random_scenarios import STEPS, STRATEGIES, TEAMS, broken_table, valid_table
from shoal.cli.main import BAD_INPUT, run_command
from shoal.cli.options import edited_table
from shoal.core.errors import ShoalError
from shoal.core.text import hides
from shoal.metrics.summary import METRICS
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.load import load, scenario_from, to_toml
from shoal.strategies import CATALOGUE

ALIKE = {  # hear, remember and tell as others do that are tried, or are in a team; test_every_strategy.py has them all
    "a-cmommt", "adrift", "attraction-repulsion", "charged-pso", "constant-repulsion", "encircle", "expanding-square",
    "global-pso", "lattice", "lattice-intercept", "lattice-pursuit", "levy-walk", "parallel-track", "pursuit",
    "random-walk", "sector-search", "shared-sighting",
}  # fmt: skip
CREWS = [*([name] for name in STRATEGIES), *TEAMS]
VALID = 12  # of each crew
CHUNKS = 20
BROKEN = 2000 // CHUNKS  # in each chunk
SHARES = ("time_on_target", "target_present", "fairness", "coverage", "clustering")


def chance(*numbers):
    return np.random.default_rng([2020, *numbers])


class TestValid:
    """Scenarios over every field, each for 50 steps."""

    @pytest.mark.parametrize(
        "crew",
        [  # each compiles the engine for its strategies
            pytest.param(crew, marks=() if names == ["knn-pso"] else pytest.mark.slow, id="+".join(names))
            for crew, names in enumerate(CREWS)
            if len(names) > 1 or not ALIKE.issuperset(names)
        ],
    )
    def test_runs_and_adds_up(self, crew):
        for case in range(VALID):
            table = valid_table(chance(crew, case), CREWS[crew])
            if CREWS[crew] != ["knn-pso"] and "motion" in table:  # each order is compiled for itself
                table["motion"]["update_order"] = "synchronous"
            try:
                self.check(table)
            except Exception as error:
                raise AssertionError(f"case {case}: {error!r}\n{tomli_w.dumps(table)}") from error

    def check(self, table):
        chosen = scenario_from(table)
        assert scenario_from(tomllib.loads(to_toml(chosen))) == chosen
        simulation = Simulation(chosen)
        frames = [simulation.advance(STEPS // 2, every=1) for _ in range(2)]
        self.check_state(simulation)
        self.check_sums(
            simulation, *(np.concatenate([getattr(f, name) for f in frames]) for name in ("alive", "target_present"))
        )
        self.check_metrics(simulation)

    @staticmethod
    def check_state(simulation):
        n, world, swarm = simulation.scenario.agents, simulation.world, simulation.swarm
        for name, part in simulation.state().items():
            if part.dtype == np.float64 and not name.startswith("swarm.max_"):
                assert np.isfinite(part).all(), name
        there = swarm.alive[:n] > 0
        for place, clamp, half in ((swarm.x, world.clamp_x, world.half_x), (swarm.y, world.clamp_y, world.half_y)):
            assert (np.abs(place[:n]) <= half).all()
            assert (np.abs(place[:n][there]) <= clamp).all()
        if not world.divide:
            assert (np.hypot(swarm.vx[:n], swarm.vy[:n]) <= swarm.max_speed[:n] * (1 + 1e-9)).all()
        for target, made in zip(simulation.targets, simulation.scenario.targets, strict=True):
            assert all(np.isfinite(target[name]) for name in target.dtype.names)
            if made.kind not in ("still", "waypoint"):
                assert abs(target.x) <= target.half_x
                assert abs(target.y) <= target.half_y

    @staticmethod
    def check_sums(simulation, alive, present):
        tally, n = simulation.tally, simulation.scenario.agents
        assert tally.steps.sum() == STEPS
        assert tally.agent_steps.sum() == alive.sum()
        assert tally.target_steps.sum(axis=0).tolist() == present.sum(axis=0).tolist()
        assert tally.present.sum() == present.any(axis=1).sum()
        assert tally.histogram.sum() == alive[present.any(axis=1)].sum()
        assert (tally.watched <= tally.target_steps).all()
        assert tally.on_target.sum() <= tally.engaged.sum() <= n * tally.on_target.sum()
        assert (tally.stationary.sum(axis=0) <= tally.histogram.sum(axis=(0, 2))).all()
        assert tally.heard.sum() <= tally.agent_steps.sum() * (n - 1)
        assert (tally.ended.sum(axis=0) <= tally.losses.sum(axis=0)).all()
        assert tally.loss_lengths.sum() == tally.ended.sum()

    @staticmethod
    def check_metrics(simulation):
        facts = facts_of(simulation.scenario)
        values = {name: metric.formula(simulation.tally, facts) for name, metric in METRICS.items()}
        assert all(value >= 0 or np.isnan(value) for value in values.values()), values
        assert all(values[name] <= 1 + 1e-12 or np.isnan(values[name]) for name in SHARES), values


def refusal(read, *args):
    """The one error that this ends in, its three parts checked."""
    with pytest.raises(ShoalError) as caught:
        read(*args)
    assert len(caught.value.args) == 3
    assert all(isinstance(part, str) and part.strip() for part in caught.value.args), caught.value.args
    return str(caught.value)


class TestInvalid:
    """2,000 scenarios with one thing wrong."""

    @pytest.mark.parametrize("chunk", range(CHUNKS))
    def test_ends_in_one_error_that_says_where_what_and_how_to_fix(self, chunk, tmp_path):
        file = tmp_path / "broken.toml"
        for case in range(BROKEN):
            wrong, table = broken_table(chance(chunk, case), [STRATEGIES[case % len(STRATEGIES)]])
            try:
                refusal(scenario_from, table)
                file.write_text(tomli_w.dumps(table), encoding="utf-8")
                assert str(file) in refusal(load, file) or "file" in wrong
            except BaseException as error:
                raise AssertionError(f"case {case}, {wrong}: {error!r}\n{table}") from error

    @pytest.mark.parametrize("case", range(20))
    def test_from_the_command_line_too(self, case, tmp_path, capsys):
        wrong, table = broken_table(chance(99, case), ["knn-pso"])
        file = tmp_path / "broken.toml"
        file.write_text(tomli_w.dumps(table), encoding="utf-8")
        assert run_command(["run", str(file), "--json"]) == BAD_INPUT, wrong
        told = capsys.readouterr()
        assert told.out == ""
        assert "Traceback" not in told.err
        assert told.err.startswith("shoal: ")
        assert told.err.count("\n  fix: ") == 1

    @pytest.mark.parametrize("change", ["--agents=7", "--fast=1", "--target-speed=2", "--set=network.neighbors=1"])
    def test_whatever_option_looks_into_it(self, change, tmp_path, capsys):
        for case in range(40):
            _, table = broken_table(chance(98, case), ["knn-pso"])
            table["steps"] = "none"  # whatever the option mends
            file = tmp_path / "broken.toml"
            file.write_text(tomli_w.dumps(table), encoding="utf-8")
            assert run_command(["run", str(file), change]) == BAD_INPUT
            assert "\n  fix: " in capsys.readouterr().err

    @pytest.mark.parametrize(
        "text",
        [
            "",
            "steps",
            "steps = ",
            "[area",
            "steps = 1\nsteps = 2",
            "a = 'b",
            "[area]\n[area]",
            "\0",
            "x = 1e",
            "[[fleets]]\n=1",
        ],
    )
    def test_text_that_is_no_toml_or_says_nothing(self, text, tmp_path):
        file = tmp_path / "broken.toml"
        file.write_text(text, encoding="utf-8")
        assert str(file) in refusal(load, file)

    @pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"\x80abc", bytes(range(256))])
    def test_bytes_that_are_no_text(self, content, tmp_path):
        file = tmp_path / "broken.toml"
        file.write_bytes(content)
        assert "is not a text file" in refusal(load, file)

    def test_cut_short_anywhere(self, tmp_path):
        whole = to_toml(load("oceans2020"))
        file = tmp_path / "broken.toml"
        refused = 0
        for end in range(0, len(whole) - 200, 7):
            file.write_text(whole[:end], encoding="utf-8")
            refused += bool(refusal(load, file))
        assert refused > 100


WHOLE = {
    "name": "b", "description": "", "time_step": 0.1, "steps": 20, "seed": 1,
    "area": {"width": 20.0, "height": 20.0, "agent_margin": 0.5, "origin": [1.0, 2.0]},
    "fleets": [
        {"name": "A", "count": 3, "max_speed": 2.0, "mass": 3.0, "sensor_radius": 0.1, "start": "uniform",
         "neighbors": 2, "detection_probability": 0.9, "false_alarm_probability": 0.01, "mean_lifetime": 100.0,
         "max_acceleration": 1.0, "max_turn_rate": 90.0, "strategy": {"name": "levy-walk", "exponent": 2.0}},
        {"name": "B", "count": 5, "max_speed": 1.0},
    ],
    "network": {"neighbors": 4, "range": 10.0, "loss": 0.1, "delay": 2,
                "adaptive": {"fewest": 1, "most": 5, "patience": 3.0}},
    "motion": {"update_order": "synchronous", "speed_rule": "cap"},
    "strategy": {"name": "knn-pso", "inertia": 1.0, "follow": "nearest", "delta": 0.01},
    "targets": [
        {"kind": "waypoint", "radius": 1.0, "speed": 3.0, "margin": 1.0, "max_turn": 20.0, "waypoint_reach": 1.0,
         "waypoint_patience": 50},
        {"kind": "still", "radius": 1.0, "x": 1.0, "y": 2.0},
        {"kind": "line", "radius": 1.0, "speed": 1.0, "surface_time": 1.0, "dive_time": 1.0},
        {"kind": "levy", "radius": 1.0, "speed": 1.0, "exponent": 2.0, "shortest": 1.0, "longest": 5.0},
        {"kind": "evasive", "radius": 1.0, "speed": 1.0, "sight": 2.0, "wall_sight": 1.0},
        {"kind": "drift", "radius": 1.0, "speed": 0.5, "current_x": 0.1, "current_y": -0.2},
        {"kind": "walk", "radius": 1.0, "speed": 1.0, "persistence": 5.0},
    ],
    "losses": [{"step": 5, "count": 1, "fleet": "A"}],
    "joins": [{"step": 7, "count": 2, "fleet": "B"}],
}  # fmt: skip
NASTY = [
    True, "", "abc", " ", "\0", "5 kn", "1e999 m", "-3 m", "nan", -1, 0, 2.5, -0.0, 5e-324, 1e13, 1e308, math.inf,
    math.nan, 10**30, 2**63, [], [1], [[]], {}, {"a": 1}, {"name": "x"}, {"name": []}, {"file": "nope.py"},
    {"file": "\0.py"}, "x" * 100_000, [1] * 2000, "[/b]", "$\\frac{", "\x1b[2J", "a\u202eb", "\u0665", "1_0", " 5 ",
    "10 %", date(2020, 1, 1), "all", "../x",
]  # fmt: skip


def _paths(table, path=()):
    for key, value in table.items() if isinstance(table, dict) else enumerate(table):
        yield (*path, key)
        if isinstance(value, (dict, list)):
            yield from _paths(value, (*path, key))


class TestNasty:
    """Every field of a scenario that says all there is, with every nasty value, by every door."""

    @pytest.mark.parametrize("door", ["table", "file", "set"])
    def test_ends_in_a_scenario_or_in_one_short_plain_error(self, door, tmp_path):
        cases = [(path, value) for path in _paths(WHOLE) for value in NASTY]
        refused = 0
        for path, value in cases:
            try:
                refused += self.refuses(door, path, value, tmp_path / "nasty.toml")
            except BaseException as error:
                raise AssertionError(f"{path} = {value!r:.80}: {error!r:.500}") from error
        assert len(cases) > 2000
        assert refused > len(cases) / 2

    def refuses(self, door, path, value, file):
        try:
            chosen = self.through(door, path, copy.deepcopy(value), file)
        except ShoalError as error:
            told = str(error)
            assert told.count("\n  fix: ") == 1
            assert len(told) < 5000
            assert not any(hides(each) for each in told if each != "\n")
            return True
        if chosen is not None:
            assert scenario_from(tomllib.loads(to_toml(chosen))) == chosen
        return False

    @staticmethod
    def through(door, path, value, file):
        if door == "set":
            text = tomli_w.dumps({"value": value}).strip()
            if "\n" in text or not text.startswith("value = "):
                return None  # a table, which no option can write
            assignment = f"{'.'.join(map(str, path))}={text.removeprefix('value = ')}"
            file.write_text(tomli_w.dumps(WHOLE), encoding="utf-8")
            return scenario_from(edited_table(str(file), {}, [assignment], None, None), where=str(file))
        table = copy.deepcopy(WHOLE)
        part = table
        for key in path[:-1]:
            part = part[key]
        part[path[-1]] = value
        if door == "table":
            return scenario_from(table)
        file.write_text(tomli_w.dumps(table), encoding="utf-8")
        return load(file)

    @pytest.mark.parametrize("whole", [None, [], "x", 5, {}, {"strategy": None}, {"fleets": {}}, {"fleets": [[]]}])
    def test_what_is_no_scenario_at_all_is_refused(self, whole):
        refusal(scenario_from, whole)

    @pytest.mark.parametrize(
        "text",
        ["a=" + "[" * 5000 + "]" * 5000, "[" + ".".join(["a"] * 5000) + "]", "steps=" + "9" * 5000,
         "#" + "x" * 2_000_000, "fleets=[" + "{}," * 100_000 + "]", "[[fleets]]\n" * 20_000,
         "\n".join(f"x{n} = 1" for n in range(20_000))],
        ids=["deep", "deep header", "long number", "long file", "many fleets", "many tables", "many fields"],
    )  # fmt: skip
    def test_too_much_of_anything_is_one_short_error(self, text, tmp_path):
        file = tmp_path / "much.toml"
        file.write_text(text)
        assert len(refusal(load, file)) < 2500

    def test_twenty_errors_are_enough(self, tmp_path):
        file = tmp_path / "many.toml"
        file.write_text("[[fleets]]\n" * 300)
        told = refusal(load, file)
        assert told.count("\n  also: ") == 19
        assert "\n  and 886 more" in told

    def test_a_device_that_never_ends_is_refused(self):
        assert "is larger than 1 MB" in refusal(load, "/dev/zero")


class TestParameters:
    """Strategies say what their parameters may be."""

    @pytest.mark.parametrize("name", STRATEGIES)
    def test_no_strategy_takes_a_number_below_its_range(self, name):
        for field, default in CATALOGUE[name].params._field_defaults.items():
            if isinstance(default, float):
                told = refusal(scenario_from, {**WHOLE, "strategy": {"name": name, field: -1e-3}})
                assert f"strategy.{field}: -0.001: input should be greater than" in told
