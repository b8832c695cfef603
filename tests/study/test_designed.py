"""Designing from Python, and the page for who buys."""

import html

import numpy as np
import pytest

import shoal
from searches import chance, runs_of
from shoal.core.errors import RecordError, ScenarioError
from shoal.experiments.fleet_range import FleetRange
from shoal.experiments.variable import Variable
from shoal.study.design import DesignOptions, designed
from shoal.study.design_page import ROWS, page
from shoal.study.design_words import sentences, shortened, simulated

FLEETS = {"BoB-1": (0, 30, 3), "BoB-0": "0:45@1"}
RANGES = [FleetRange("BoB-1", 0, 30, 3), FleetRange("BoB-0", 0, 45, 1)]


def found_with(fast, price=3, scenario="oceans2020"):
    """A design where one fast buoy is worth so many slow ones, by a formula."""

    def value(scenario, run):
        counts = {fleet.max_speed: fleet.count for fleet in scenario.fleets}
        strength = counts.get(1.0, 0) + fast * counts.get(2.6, 0)
        return 1 - float(np.exp(-strength / 40)) + 0.01 * chance(scenario.hash, scenario.seed, run)

    ranges = [FleetRange(each.name, 0, most, cost) for each, most, cost in
              zip(shoal.load(scenario).fleets, (30, 45), (price, 1), strict=True)]  # fmt: skip
    options = DesignOptions(trials=30, runs=2, final_runs=5)
    return designed(scenario, (ranges, [Variable("neighbors", 4, 40)]), {"steps": 50}, options,
                    executor=runs_of(value), report=None)  # fmt: skip


@pytest.fixture(scope="module")
def found():
    return found_with(2.3)


class TestWords:
    @pytest.mark.parametrize(("fast", "told"), [(0.8, "BoB-0 are the better buy"), (6.0, "BoB-1 are the better buy")])
    def test_say_what_is_the_better_buy(self, fast, told):
        assert any(told in each for each in sentences(found_with(fast).result))

    def test_say_what_one_is_worth_and_costs(self, found):
        (told,) = (each for each in sentences(found.result) if each.startswith("One BoB-1"))
        assert any(f"worth {rate} [" in told for rate in ("2.2", "2.3", "2.4"))
        assert "] BoB-0 here" in told
        assert "costs 3 times as much" in told

    def test_where_nothing_matters_no_rate_is_made_up(self):
        def luck(scenario, run):
            return 0.5 + 0.1 * chance(scenario.hash, scenario.seed, run)

        options = DesignOptions(trials=20, runs=2, final_runs=4)
        found = designed("oceans2020", (RANGES, []), {"steps": 50}, options, executor=runs_of(luck), report=None)
        assert "does not tell how many BoB-0 one BoB-1 is worth" in repr(found)

    def test_where_the_front_runs_along_what_was_allowed_it_is_said(self):
        told = [each for each in sentences(found_with(0.8).result) if "the most that were allowed" in each]
        assert len(told) == 1  # the slow are the better buy: whoever wants more than 45 of them can give must buy fast
        assert " have 45 BoB-0, " in told[0]
        assert "allowed" not in " ".join(sentences(found_with(6.0).result))


class TestPage:
    def test_says_what_was_simulated(self, found):
        told = simulated(found.result)
        for words in ("BoB-1 of 2.6 m/s at 3 each", "BoB-0 of 1 m/s at 1 each", "knn-pso", "time on target [share]: "):
            assert words in told
        assert told in html.unescape(page("mine", found.result, "x.png"))

    def test_has_the_front_and_the_own_fleet_but_no_more_rows_than_fit(self, found):
        kept = shortened(found.result, ROWS)
        assert sum(each.present for each in kept) == 1
        assert 5 < len(kept) <= ROWS + 1
        assert found.front[0] in kept
        assert found.front[-1] in kept

    def test_is_text_and_asks_for_nothing_from_elsewhere(self, tmp_path):
        named = shoal.load("oceans2020").model_dump(mode="json")
        named["fleets"][0]["name"] = "<script>alert(1)</script>"
        text = page("<b>x", found_with(2.0, scenario=named).result, "data:image/png;base64,")
        assert "<script" not in text
        assert "<b>x" not in text
        assert "http" not in text

    def test_replaces_its_own_kind_only(self, found, tmp_path):
        (tmp_path / "mine.html").write_text("mine")
        with pytest.raises(RecordError, match="was not made by Shoal"):
            found.report(tmp_path / "mine.html")
        found.report(tmp_path / "page.html")
        found.report(tmp_path / "page.html")
        assert (tmp_path / "page.html").read_text(encoding="utf-8").count("data:image/png") == 1


class TestFigure:
    def test_has_the_front_those_behind_and_the_own_fleet(self, found):
        (axes,) = found.plot().axes
        gids = {each.get_gid() for each in axes.lines}
        assert {"tried", "on-the-front", "own-fleet", "dominated-for-sure"} <= gids


class TestCalls:
    def test_a_short_one(self, tmp_path):
        words = {"steps": 50, "trials": 4, "runs": 1, "final_runs": 2, "out": tmp_path / "buy"}
        found = shoal.design("oceans2020", FLEETS, {"neighbors": (4, 40)}, **words)
        assert repr(found) == repr(shoal.design("oceans2020", FLEETS, {"neighbors": (4, 40)}, **words))
        table = found.to_pandas()
        assert (table["cost"] == 3 * table["BoB-1"] + table["BoB-0"]).all()
        assert table["present"].sum() == 1
        assert "<table>" in found._repr_html_()

    @pytest.mark.parametrize(
        ("fleets", "told"),
        [
            ("BoB-1", "write fleets="),
            ({"BoB-1": (0, 30, 3, 4)}, "write .fewest, most, cost of one."),
            ({"BoB-1": (0.5, 30)}, "write .fewest, most, cost of one."),
            ({"BoB-9": (0, 30, 3)}, "no such fleet"),
        ],
    )
    def test_of_no_fleets_are_refused(self, fleets, told):
        with pytest.raises(ScenarioError, match=told):
            shoal.design("oceans2020", fleets, steps=50)
