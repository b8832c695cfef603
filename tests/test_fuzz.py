"""Any scenario that is accepted runs; any other ends in one clear error."""

import tomllib

import numpy as np
import pytest
import tomli_w

from random_scenarios import STEPS, STRATEGIES, TEAMS, broken_table, valid_table
from shoal.cli.main import BAD_INPUT, run_command
from shoal.core.errors import ShoalError
from shoal.metrics.summary import METRICS
from shoal.run.facts import facts_of
from shoal.run.simulation import Simulation
from shoal.scenario.load import load, scenario_from, to_toml

CREWS = [*([name] for name in STRATEGIES), *TEAMS]
VALID = -(-2000 // len(CREWS))  # of each crew
CHUNKS = 20
BROKEN = 2000 // CHUNKS  # in each chunk
SHARES = ("time_on_target", "target_present", "fairness", "coverage", "clustering")


def chance(*numbers):
    return np.random.default_rng([2020, *numbers])


class TestValid:
    """2,000 scenarios over every field, each for 50 steps."""

    @pytest.mark.parametrize(
        "crew",
        [  # each compiles the engine for its strategies
            pytest.param(crew, marks=() if names == ["knn-pso"] else pytest.mark.slow, id="+".join(names))
            for crew, names in enumerate(CREWS)
        ],
    )
    def test_runs_and_adds_up(self, crew):
        for case in range(VALID):
            table = valid_table(chance(crew, case), CREWS[crew])
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
