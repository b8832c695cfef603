"""A suite is a short file of valid scenarios; its leaderboard scores them, its page says what made it."""

import re
from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import RecordError, ScenarioError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.contenders import contenders, with_parameters
from shoal.experiments.leaderboard import make_leaderboard, suite_hash
from shoal.experiments.leaderboard_page import BEGIN, END, _as_markdown, page_part, standing_still, write_page
from shoal.experiments.suite import read_suite, resized, suites
from shoal.metrics.summary import METRICS
from shoal.scenario.crew import crew_of
from shoal.scenario.load import load
from shoal.strategies import CATALOGUE

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reference" / "arena.md"
EVERYBODY = contenders(sorted(CATALOGUE))


@pytest.fixture
def arena():
    return read_suite("arena")


def board(suite, shares):
    """A leaderboard of made-up shares, {strategy: mean}, in every run of every condition, with a little noise."""
    named = contenders([name for name in shares if name != "lattice"])
    noise = np.random.default_rng(1).normal(scale=0.01, size=(len(suite.conditions), len(named), suite.runs))
    table = {
        condition.name: (
            condition.changes,
            {each.name: shares[each.name] + noise[c, i] for i, each in enumerate(named)},
        )
        for c, condition in enumerate(suite.conditions)
    }
    return make_leaderboard(suite, named, table)


def test_lengths_that_are_said_of_a_contender_follow_each_condition():
    wide = read_suite("arena-wide")
    named, _ = with_parameters(contenders(["encircle"]), {"encircle.chase": 7.0, "encircle.push": 0.2})
    said = {each.name: wide.design(each, named).points[0] for each in wide.conditions}
    assert said["5 m/s"] == {"strategy": "encircle", "strategy.chase": 7.0, "strategy.push": 0.2}
    assert said["sparse"]["strategy.chase"] == pytest.approx(14.0)  # twice the spacing
    assert said["bay"]["strategy.chase"] == pytest.approx(7.0 * (6e6 / 30) ** 0.5 / 8**0.5)


class TestArena:
    def test_it_is_the_suite_there_is(self, arena):
        assert suites() == ["arena", "arena-wide"]
        assert arena.seed == 4242
        with pytest.raises(ScenarioError, match="did you mean 'arena'"):
            read_suite("areno")

    def test_every_condition_is_a_valid_scenario_for_every_strategy(self, arena):
        cells = arena.cells(EVERYBODY)
        assert len(cells) == len(arena.conditions) * len(EVERYBODY)
        assert len({cell.run_id(0) for cell in cells}) == len(cells)
        assert {cell.scenario.seed for cell in cells} == {4242}
        assert {cell.scenario.steps for cell in cells} == {arena.steps}

    def test_conditions_are_what_they_are_called(self, arena):
        cells = arena.cells(contenders(["knn-pso"]))
        scenarios = {each.name: cells[2 * number].scenario for number, each in enumerate(arena.conditions)}
        assert {name: each.agents for name, each in scenarios.items() if each.agents != 50} == {"200 agents": 200}
        assert {each.network.neighbors for each in scenarios.values()} == {20}
        assert [target.speed for target in scenarios["5 m/s"].targets] == [5.0]
        assert [target.kind for target in scenarios["evasive"].targets] == ["evasive"]
        assert len(scenarios["3 targets"].targets) == 3
        assert scenarios["20 % loss"].network.loss == 0.2
        (loss,) = scenarios["half lost"].losses
        assert (2 * loss.step, 2 * loss.count) == (arena.steps, 50)

    def test_more_agents_are_as_dense(self, arena):
        cells = arena.cells(contenders(["knn-pso"]))
        few, many = cells[0].scenario, cells[-1].scenario
        assert many.agents / (many.area.width * many.area.height) == few.agents / (few.area.width * few.area.height)

    def test_what_counts_is_a_share(self, arena):
        for each in arena.conditions:
            assert METRICS[each.metric].unit == "1" or each.out_of == len(each.changes["targets"])

    def test_folders_of_conditions_differ(self, arena):
        assert len({each.folder for each in arena.conditions}) == len(arena.conditions)

    def test_shorter_runs_lose_agents_half_way_too(self, arena):
        short = resized(arena, steps=300, runs=2)
        (losses,) = (each.changes["losses"] for each in short.conditions if each.name == "half lost")
        assert losses == [{"step": 150, "count": 25}]
        assert (short.runs, short.steps, short.seed) == (2, 300, 4242)


class TestWideArena:
    """The arena's seven conditions, and more."""

    def test_begins_with_the_very_runs_of_the_arena(self, arena):
        named = contenders(["knn-pso"])
        runs, wide = ([cell.run_id(3) for cell in each.cells(named)] for each in (arena, read_suite("arena-wide")))
        assert wide[: len(runs)] == runs
        assert len(set(wide)) == len(wide) == 2 * len(read_suite("arena-wide").conditions)

    def test_conditions_are_what_they_are_called(self):
        wide = read_suite("arena-wide")
        cells = wide.cells(contenders(["knn-pso"]))
        scenarios = {each.name: cells[2 * number].scenario for number, each in enumerate(wide.conditions)}
        kinds = {name: scenarios[name].targets[0].kind for name in ("walk", "Levy", "line", "drift")}
        assert kinds == {"walk": "walk", "Levy": "levy", "line": "line", "drift": "drift"}
        assert {scenarios[name].targets[0].margin for name in ("walk", "Levy", "line")} == {0.0}
        numbers = {name: scenarios[name].agents for name in ("sparse", "25 agents", "dense 100", "dense 200")}
        assert list(numbers.values()) == [50, 25, 100, 200]
        assert scenarios["sparse"].area.width == 2 * scenarios["dense 200"].area.width == 40.0
        assert [scenarios[name].targets[0].radius for name in ("radius 0.6", "radius 2")] == [0.6, 2.0]
        assert {fleet.false_alarm_probability for fleet in scenarios["false alarms"].fleets} == {0.002}
        assert {fleet.detection_probability for fleet in scenarios["detection 0.5"].fleets} == {0.5}
        assert {fleet.max_acceleration for fleet in scenarios["sluggish"].fleets} == {1.0}
        assert scenarios["delay"].network.delay == 5
        assert scenarios["range 2 m"].network.range == 2.0

    def test_the_bay_is_a_scenario_of_its_own_and_as_long_as_it_is(self):
        wide = read_suite("arena-wide")
        bay, short = wide.cells(contenders(["knn-pso"]))[-1], resized(wide, steps=2000)
        assert (bay.scenario.name, bay.scenario.steps, bay.scenario.seed) == ("bay", 7200, wide.seed)
        assert short.cells(contenders(["knn-pso"]))[-1].scenario.steps == 720

    def test_folders_of_conditions_differ(self):
        folders = [each.folder for each in read_suite("arena-wide").conditions]
        assert len(set(folders)) == len(folders)


class TestLeaderboard:
    def test_the_score_is_the_mean_over_conditions(self, arena):
        found = board(arena, {"knn-pso": 0.7, "lattice": 0.5})
        for strategy in ("knn-pso", "lattice"):
            shares = [condition.of(strategy).value.mean for condition in found.shares.conditions]
            assert found.overall.of(strategy).value.mean == pytest.approx(np.mean(shares))

    def test_a_run_that_failed_under_one_condition_has_no_score(self, arena):
        values = {"knn-pso": np.linspace(0.5, 0.9, 20), "lattice": np.linspace(0.4, 0.5, 20)}
        table = {each.name: ({}, {name: part.copy() for name, part in values.items()}) for each in arena.conditions}
        table["evasive"][1]["knn-pso"][3] = np.nan
        found = make_leaderboard(arena, contenders(["knn-pso"]), table)
        assert found.overall.of("knn-pso").missing == 1
        assert found.overall.of("knn-pso").difference.pairs == 19
        assert found.shares.conditions[0].of("knn-pso").missing == 0

    def test_the_hash_follows_what_shapes_the_numbers(self, arena):
        few, more = contenders(["knn-pso"]), contenders(["knn-pso", "pursuit"])
        other = [resized(arena, runs=3), resized(arena, steps=300), resized(arena, seed=5)]
        hashes = {suite_hash(arena, few), suite_hash(arena, more), *(suite_hash(each, few) for each in other)}
        assert len(hashes) == 5
        assert suite_hash(arena, few) in hashes

    def test_the_hash_follows_defaults_which_those_of_scenarios_do_not(self, arena, monkeypatch):
        before = suite_hash(arena, contenders(["knn-pso"]))
        other = crew_of(load("oceans2020", **{"strategy.social": 0.6}))  # as if that were the default
        monkeypatch.setattr("shoal.experiments.leaderboard.crew_of", lambda scenario: other)
        assert suite_hash(arena, contenders(["knn-pso"])) != before


class TestStandingStill:
    """Said plainly, from the numbers."""

    def test_whom_it_beats_and_to_whom_no_difference_is_shown(self, arena):
        found = board(arena, {"knn-pso": 0.7, "levy-walk": 0.2, "random-walk": 0.5, "pursuit": 0.1, "lattice": 0.5})
        told = standing_still(found)
        assert re.search(r"ranks [23] of 4 by score", told)
        assert "- **evasive**: it beats levy-walk; no difference is shown to random-walk." in told
        assert "pursuit" not in told

    def test_where_it_comes_first(self, arena):
        told = standing_still(board(arena, {"knn-pso": 0.3, "lattice": 0.5}))
        assert f"comes first under {', '.join(each.name for each in arena.conditions)}." in told

    def test_where_everybody_is_better(self, arena):
        told = standing_still(board(arena, {"knn-pso": 0.8, "lattice": 0.5}))
        assert "comes first under no condition" in told
        assert "- **3 m/s**: it neither beats nor equals any." in told


class TestPage:
    def test_only_what_is_between_the_markers_changes(self, arena, tmp_path):
        file = tmp_path / "page.md"
        file.write_text(f"# Mine\n\nbefore\n{BEGIN}\nold\n{END}\nafter\n")
        found = board(arena, {"knn-pso": 0.7, "lattice": 0.5})
        write_page(found, file)
        assert file.read_text() == f"# Mine\n\nbefore\n{BEGIN}\n{page_part(found)}\n{END}\nafter\n"
        first = file.read_bytes()
        write_page(found, file)
        assert file.read_bytes() == first

    def test_a_page_without_markers_is_left_as_it_is(self, arena, tmp_path):
        file = tmp_path / "page.md"
        file.write_text("# Mine\n")
        with pytest.raises(RecordError, match="write two lines"):
            write_page(board(arena, {"knn-pso": 0.7, "lattice": 0.5}), file)
        assert file.read_text() == "# Mine\n"

    def test_a_short_trial_says_so(self, arena):
        shares = {"knn-pso": 0.7, "lattice": 0.5}
        assert "short trial" not in page_part(board(arena, shares))
        short = page_part(board(resized(arena, runs=3, steps=500), shares))
        assert "**A short trial**, not to be cited: 3 runs of 500 steps" in short
        assert "`shoal compare --suite arena --runs 3 --steps 500`" in short

    def test_references_have_no_rank_and_are_called_no_bound(self, arena):
        page = page_part(board(arena, {"knn-pso": 0.7, "pursuit": 0.9, "lattice": 0.5}))
        assert "| – | pursuit (knows the target) |" in page
        assert "They are not an upper bound; no proven one is known." in page


class TestPageOfTheDocs:
    """What is in the docs was made by today's strategies: if not, make it anew, as docs/how-to/compare.md says."""

    def test_its_suite_hash_is_that_of_today(self, arena):
        made = re.search(
            r"(\d+) runs of ([\d,]+) steps each, seed (\d+), .*results version (\d+), suite hash (\w{16})",
            PAGE.read_text(encoding="utf-8"),
        )
        assert made, f"{PAGE.name} does not say what made it"
        runs, steps, seed, version = (int(part.replace(",", "")) for part in made.groups()[:4])
        assert version == RESULTS_VERSION
        assert made.group(5) == suite_hash(resized(arena, runs=runs, steps=steps, seed=seed), EVERYBODY)

    def test_it_ranks_every_strategy_under_every_condition(self, arena):
        text = PAGE.read_text(encoding="utf-8")
        sections = [text.partition("## Leaderboard")[2].partition("\n## ")[0]]
        sections += [text.partition(f"### {each.name}\n")[2].partition("\n### ")[0] for each in arena.conditions]
        for section in sections:
            rows = re.findall(r"^\| [\d–]+ \| ([\w-]+)(?: \(knows the target\))? \|", section, re.MULTILINE)
            assert sorted(rows) == sorted(CATALOGUE)


def test_a_name_is_text_in_the_page():
    assert _as_markdown("a|b <i> *c* _d_ [e](f) `g` $h$") == r"a\|b \<i\> \*c\* \_d\_ \[e\](f) \`g\` \$h\$"
    assert _as_markdown("knn-pso") == "knn-pso"
