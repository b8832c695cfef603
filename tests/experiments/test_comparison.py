"""A comparison ranks, pairs with the baseline, corrects, and says plainly what is left."""

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.experiments.cells import make_cells
from shoal.experiments.comparison import compare
from shoal.experiments.contenders import contenders, with_parameters
from shoal.experiments.run_comparison import by_condition, comparison_design, values_of
from shoal.metrics.summary import METRICS
from shoal.scenario.load import load

NOISE = np.random.default_rng(3).normal(scale=0.05, size=(4, 10))


def values(**means):
    """values(good=0.8, bad=0.2): ten runs of each, with noise of their own."""
    return {name: mean + noise for (name, mean), noise in zip(means.items(), NOISE, strict=False)}


def compared(table, baseline, informed=(), direction=1):
    """The standings of one condition, by strategy."""
    (condition,) = compare({"": ({}, table)}, baseline, informed, direction).conditions
    return {each.strategy: each for each in condition.standings}


class TestVerdict:
    def test_a_large_difference_is_better_or_worse(self):
        found = compared(values(base=0.5, good=0.8, bad=0.2), "base")
        assert {name: each.verdict for name, each in found.items()} == {
            "good": "better",
            "base": "baseline",
            "bad": "worse",
        }

    def test_less_can_be_better(self):
        found = compared(values(base=0.5, more=0.8, less=0.2), "base", direction=-1)
        assert (found["less"].verdict, found["more"].verdict) == ("better", "worse")
        assert list(found) == ["less", "base", "more"]

    def test_a_metric_without_a_better_side_is_higher_or_lower(self):
        found = compared(values(base=0.5, more=0.8, less=0.2), "base", direction=0)
        assert (found["more"].verdict, found["less"].verdict) == ("higher", "lower")

    def test_identical_strategies_differ_by_exactly_nothing(self):
        same = values(base=0.5)["base"]
        found = compared({"base": same, "twin": same.copy()}, "base")
        assert found["twin"].difference[:3] == (0.0, None, 1.0)
        assert found["twin"].verdict == "no difference shown"
        assert found["twin"].rank == found["base"].rank == 1

    def test_swapping_the_baseline_flips_the_difference(self):
        table = values(one=0.5, other=0.6)
        there, back = compared(table, "one")["other"], compared(table, "other")["one"]
        assert there.difference.mean == -back.difference.mean
        assert there.adjusted_p == back.adjusted_p
        assert (there.verdict, back.verdict) == ("better", "worse")

    def test_a_single_run_is_too_few(self):
        assert compared({"base": np.array([0.1]), "other": np.array([0.9])}, "base")["other"].verdict == "too few runs"

    def test_more_comparisons_need_more_evidence(self):
        slight = {"base": NOISE[0], "slight": NOISE[0] + NOISE[1] + 0.04}
        alone = compared(slight, "base")["slight"]
        many = compare({str(n): ({"n": n}, slight) for n in range(50)}, "base", ())
        assert alone.verdict == "better"
        assert many.tests == 50
        assert {condition.of("slight").verdict for condition in many.conditions} == {"no difference shown"}


class TestRank:
    def test_those_that_know_the_target_have_none_and_come_last(self):
        found = compared(values(base=0.5, oracle=0.9, bad=0.2), "base", informed={"oracle"})
        assert {name: each.rank for name, each in found.items()} == {"base": 1, "bad": 2, "oracle": None}
        assert list(found)[-1] == "oracle"
        assert found["oracle"].verdict == "better"

    def test_without_any_value_there_is_none(self):
        found = compared({**values(base=0.5), "failed": np.full(10, np.nan)}, "base")
        assert found["failed"].rank is None
        assert (found["failed"].missing, found["failed"].verdict) == (10, "too few runs")
        assert found["base"].rank == 1


class TestMissingRuns:
    def test_they_are_counted_and_left_out_in_pairs(self):
        table = values(base=0.5, other=0.8)
        table["other"][[2, 5]] = np.nan
        found = compared(table, "base")
        assert found["other"].missing == 2
        assert found["other"].difference.pairs == 8
        assert len(found["other"].value.runs) == 8
        assert len(found["base"].value.runs) == 10

    def test_a_failed_run_and_one_without_the_metric_have_no_value(self):
        rows = [{"status": "done", "xi": 0.5}, {"status": "failed", "xi": None}, {"status": "done", "xi": None}, None]
        assert values_of({"a": rows}, "xi", out_of=2.0)["a"] == pytest.approx([0.25, *[np.nan] * 3], nan_ok=True)


class TestDirection:
    def test_every_metric_with_a_better_side_exists(self):
        assert METRICS["time_on_target"].direction == 1
        assert METRICS["first_detection"].direction == -1
        assert METRICS["xi"].direction == 0
        assert {name for name, each in METRICS.items() if each.direction} >= {"targets_observed", "losses", "power"}


class TestContenders:
    def test_the_lattice_is_always_there_once(self):
        assert [each.name for each in contenders(["knn-pso"])] == ["knn-pso", "lattice"]
        assert [each.name for each in contenders(["lattice", "knn-pso", "knn-pso"])] == ["lattice", "knn-pso"]

    def test_those_that_know_the_target_are_marked(self):
        assert {each.name: each.informed for each in contenders(["pursuit"])} == {"pursuit": True, "lattice": False}

    def test_two_of_one_name_are_refused(self, tmp_path):
        source = (
            "from typing import NamedTuple\nimport shoal\nclass P(NamedTuple):\n    a: float = {0}\n"
            "@shoal.strategy('mine', params=P)\ndef mine(me, heard, memory, params, draw):\n    return 0.0, 0.0\n"
        )
        for name in ("one", "two"):
            (tmp_path / f"{name}.py").write_text(source.format(len(name) + (name == "two")))
        with pytest.raises(ScenarioError, match="are both called 'mine'"):
            contenders([str(tmp_path / "one.py"), str(tmp_path / "two.py")])


class TestParameters:
    """Of a strategy by its name: encircle.ring."""

    def test_each_gets_its_own_and_the_scenario_the_rest(self):
        changes = {"encircle.ring": 0.5, "steps": 9, "network.loss": 0.1}
        own, left = with_parameters(contenders(["knn-pso", "encircle"]), changes)
        assert {each.name: each.said for each in own} == {"knn-pso": {}, "encircle": {"ring": 0.5}, "lattice": {}}
        assert left == {"steps": 9, "network.loss": 0.1}

    def test_what_a_scenario_says_of_its_own_strategy_stays(self):
        own, left = with_parameters(contenders(["knn-pso", "encircle"]), {"knn-pso.delta": 0.02})
        cells = make_cells(comparison_design("oceans2020", own, 1, {"neighbors": [3]}), left)
        chosen = {cell.scenario.strategy.name: cell.scenario.strategy.params for cell in cells}
        assert chosen["knn-pso"] == load("oceans2020").strategy.params | {"delta": 0.02}
        assert chosen["encircle"]["ring"] == 0.95
        rows = [{"run_id": cell.run_id(0)} for cell in cells]
        ((point, found),) = by_condition(cells, rows, 1, {each.choice: each.name for each in own})
        assert (point, list(found)) == ({"neighbors": 3}, ["knn-pso", "encircle", "lattice"])

    def test_one_that_it_has_not_is_refused(self):
        own, left = with_parameters(contenders(["encircle"]), {"encircle.rang": 0.5})
        with pytest.raises(ScenarioError, match="rang: unknown field"):
            make_cells(comparison_design("oceans2020", own, 1), left)


class TestByCondition:
    """Rows of a store, which may hold more than is wanted, sorted by what is."""

    def test_each_run_finds_its_place_and_strangers_none(self):
        both = contenders(["knn-pso"])
        cells = make_cells(comparison_design("oceans2020", both, 2, {"neighbors": [3, 4]}), {"steps": 9})
        rows = [{"run_id": cell.run_id(run), "mark": (dict(cell.point), run)} for cell in cells for run in (1, 0, 2)]
        found = by_condition(cells, [*rows, {"run_id": "stranger"}], 2, {each.choice: each.name for each in both})
        assert [point for point, _ in found] == [{"neighbors": 3}, {"neighbors": 4}]
        for point, strategies in found:
            assert list(strategies) == ["knn-pso", "lattice"]
            for name, known in strategies.items():
                assert [row["mark"] for row in known] == [({"strategy": name, **point}, run) for run in (0, 1)]
