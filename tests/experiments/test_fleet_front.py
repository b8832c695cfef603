"""A design finds the front of fleets, measures it on fresh seeds, and starts again where it was."""

import numpy as np
import pytest

from searches import chance, failing, runs_of
from shoal.core.errors import ScenarioError
from shoal.experiments.fleet_front import design_fleets
from shoal.experiments.fleet_range import parse_fleet
from shoal.experiments.fleet_trial import FleetSearch
from shoal.experiments.front import hypervolume
from shoal.experiments.objective import objective
from shoal.experiments.results import read_rows
from shoal.experiments.variable import parse_variable
from shoal.scenario.load import load

TWO = ("BoB-1=0:30@3", "BoB-0=0:45@1")


def search(*fleets, vary=("neighbors=4:40",), trials=24, changes=None):
    changes = {"steps": 50, **(changes or {})}
    return FleetSearch(
        source="oceans2020", changes=changes, scenario=load("oceans2020", **changes),
        fleets=[parse_fleet(each) for each in fleets or TWO], variables=[parse_variable(each) for each in vary],
        less=objective("cost", -1), more=objective("time_on_target", 1), trials=trials, runs=2, final_runs=5,
    )  # fmt: skip


def agents(scenario):
    return {fleet.name: fleet.count for fleet in scenario.fleets}


def known(fast, slow, k):
    """One fast agent is worth 2.3 slow ones; k is best at 20."""
    return 1 - np.exp(-(slow + 2.3 * fast) / 40) - 0.0001 * (k - np.minimum(20, fast + slow - 1)) ** 2


def worth(scenario, run):
    counts = agents(scenario)
    fast, slow, k = counts.get("BoB-1", 0), counts.get("BoB-0", 0), scenario.network.neighbors
    return float(known(fast, slow, k)) + 0.01 * chance(fast, slow, k, scenario.seed, run)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return design_fleets(search(trials=40), tmp_path_factory.mktemp("found"), executor=runs_of(worth))


class TestFront:
    def test_is_nearly_that_of_all_fleets(self, found):
        fast, slow = np.meshgrid(range(31), range(46))
        best = hypervolume(
            (3 * fast + slow).ravel(), known(fast, slow, np.minimum(20, fast + slow - 1)).ravel(), found.reference
        )
        assert found.hypervolumes["all"] > 0.95 * best

    def test_beats_as_many_trials_at_random(self, found):
        assert found.hypervolumes["sampler"] > 1.02 * found.hypervolumes["random"]

    def test_is_cheapest_first_and_rises(self, found):
        assert len(found.front) > 8
        for one, other in zip(found.front, found.front[1:], strict=False):
            assert one.less.mean < other.less.mean
            assert one.more.mean < other.more.mean

    def test_those_dominated_for_sure_have_another_that_costs_no_more_and_is_beyond_their_interval(self, found):
        beaten = [each for each in found.alternatives if each.beaten_by is not None]
        assert beaten
        for each in beaten:
            better = found.alternatives[each.beaten_by]
            assert better.less.high <= each.less.low
            assert better.more.low >= each.more.high

    def test_the_exchange_rate_is_found(self, found):
        (rate,) = found.rates
        assert (rate.fleet, found.base) == (0, 1)
        assert rate.low < 2.3 < rate.high
        assert rate.high / rate.low < 1.5

    def test_the_fleet_of_the_scenario_stands_beside_the_others(self, found):
        assert found.present.counts == (15, 35)
        assert found.present.less.mean == 80


class TestCounts:
    def test_of_0_and_k_of_all_others(self, tmp_path):
        seen = []

        def value(scenario, run):
            seen.append(scenario)
            return worth(scenario, run)

        design_fleets(search("BoB-1=0:2@3", "BoB-0=0:4@1", trials=12), tmp_path, executor=runs_of(value))
        assert any("BoB-1" not in agents(each) for each in seen)
        assert any("BoB-0" not in agents(each) for each in seen)
        assert {each.network.neighbors == each.agents - 1 for each in seen if each.agents <= 5} == {True}
        for row in read_rows(tmp_path / "search")[1]:
            assert row["neighbors"] < row["fleets.BoB-1.count"] + row["fleets.BoB-0.count"]

    def test_that_are_fixed_stay_also_at_0(self, tmp_path):
        fixed = search("BoB-1=0@3", "BoB-0=2:45@1", trials=6)
        found = design_fleets(fixed, tmp_path, executor=runs_of(worth))
        assert {each.counts[0] for each in found.alternatives if not each.present} == {0}
        assert found.rates == ()

    def test_other_fleets_stay_and_are_paid(self, tmp_path):
        only = search("BoB-1=0:30@3", trials=6, changes={"fleets.BoB-0.cost": 2})
        found = design_fleets(only, tmp_path, executor=runs_of(worth))
        assert {each.less.mean - 3 * each.counts[0] for each in found.alternatives} == {70.0}


class TestResume:
    def test_cut_off_it_ends_as_if_it_had_not_been(self, tmp_path):
        small = search(trials=16)
        whole = design_fleets(small, tmp_path / "whole", executor=runs_of(worth))
        for after in (3, 5):

            def cut(tasks, after=after):
                for number, done in enumerate(runs_of(worth)(tasks)):
                    if number == after:
                        raise KeyboardInterrupt
                    yield done

            with pytest.raises(KeyboardInterrupt):
                design_fleets(small, tmp_path / "cut", executor=cut)
        asked = []
        assert design_fleets(small, tmp_path / "cut", executor=runs_of(worth, asked)) == whole
        assert design_fleets(small, tmp_path / "cut", executor=runs_of(worth, again := [])) == whole
        assert asked
        assert not again


class TestRefusals:
    @pytest.mark.parametrize(
        ("vary", "told"),
        [
            (("fast=0:5",), "twice"),
            (("fleets.1.count=0:5",), "twice"),
            (("strategy.dleta=0.1:0.2",), "strategy.dleta"),
        ],
    )
    def test_of_what_cannot_be_varied_besides_leave_nothing(self, vary, told, tmp_path):
        with pytest.raises(ScenarioError, match=told):
            design_fleets(search(vary=vary), tmp_path / "new", executor=failing)
        assert not (tmp_path / "new").exists()

    def test_where_every_run_fails_that_is_the_error(self, tmp_path):
        with pytest.raises(ScenarioError, match="no fleet has a value: it broke"):
            design_fleets(search(trials=3), tmp_path, executor=failing)
