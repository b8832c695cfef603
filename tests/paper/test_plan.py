"""The plan runs what the issue asks for, and no more than fits in its time."""

import pytest

from shoal.experiments.cells import make_cells
from shoal.paper.plan import PAPERS, VARIANTS, make_plan


def by_name(plan):
    return {each.name: each for each in plan.groups}


def group(plan, name):
    return next(each for each in plan.groups if each.name == name)


@pytest.mark.parametrize("paper", PAPERS)
@pytest.mark.parametrize("quick", [True, False])
class TestEveryPlan:
    def test_every_point_can_run(self, paper, quick):
        assert all(make_cells(each.design, each.changes) for each in make_plan(paper, quick=quick).groups)

    def test_no_two_groups_share_a_store(self, paper, quick):
        names = [each.name for each in make_plan(paper, quick=quick).groups]
        assert len(set(names)) == len(names)

    def test_no_point_is_listed_twice(self, paper, quick):
        for each in make_plan(paper, quick=quick).groups:
            points = [tuple(sorted(point.items())) for point in each.design.points]
            assert len(set(points)) == len(points)


class TestOceans:
    def test_full_is_five_seeds_of_100_000_steps(self):
        plan = make_plan("oceans2020")
        assert (plan.seeds, plan.steps) == (5, 100_000)
        assert {cell.scenario.steps for cell in make_cells(plan.groups[0].design, plan.groups[0].changes)} == {100_000}

    def test_quick_is_two_seeds_of_20_000_steps(self):
        plan = make_plan("oceans2020", quick=True)
        assert (plan.seeds, plan.steps) == (2, 20_000)

    def test_full_has_every_even_k_and_both_ends_for_both_swarms_and_speeds(self):
        points = group(make_plan("oceans2020"), "main").design.points
        for fast in (0, 15):
            for speed in (3.0, 5.0):
                known = {p["neighbors"] for p in points if (p["fast"], p["target_speed"]) == (fast, speed)}
                assert known >= {*range(2, 49, 2), 49}

    def test_full_has_every_tenth_of_the_shares_at_four_k(self):
        points = group(make_plan("oceans2020"), "main").design.points
        for k in (10, 20, 30, 40):
            assert {p["fast"] for p in points if p["neighbors"] == k} == set(range(0, 51, 5))

    def test_every_variant_changes_the_scenario_and_only_in_its_own_way(self):
        plan = make_plan("oceans2020", quick=True)
        variants = [each for each in plan.groups if each.name.startswith("sensitivity/")]
        assert [each.labels["variant"] for each in variants] == list(VARIANTS)
        first = [make_cells(each.design, each.changes)[0].scenario.hash for each in variants]
        assert len(set(first)) == len(first)

    def test_a_start_in_a_corner_survives_that_all_are_slow(self):
        corner = group(make_plan("oceans2020"), "sensitivity/start-in-a-corner")
        cells = make_cells(corner.design, corner.changes)
        assert {fleet.start for cell in cells for fleet in cell.scenario.fleets} == {"corner"}

    @pytest.mark.parametrize("preset", ["oceans2020", "oceans2020-refit"])
    def test_both_readings_get_the_same_points(self, preset):
        plan = make_plan("oceans2020")
        mine, printed = (
            {name.removeprefix("refit/"): each for name, each in by_name(plan).items() if each.design.scenario == base}
            for base in (preset, "oceans2020")
        )
        for part in ("main", "placement", "side/as-it-is"):
            assert mine[part].design.points == printed[part].design.points

    def test_another_number_of_buoys_keeps_the_shares_of_the_fleets(self):
        more = group(make_plan("oceans2020"), "side/100-buoys")
        assert more.labels["fast"] == 15
        assert {tuple(cell.scenario.counts) for cell in make_cells(more.design, more.changes)} == {(30, 70)}

    @pytest.mark.parametrize(("quick", "most"), [(True, 180), (False, 3300)])
    def test_it_fits_in_its_time(self, quick, most):
        """100,000 steps take some 0.6 s of one of two cores: some 16 minutes in full, a minute quick."""
        plan = make_plan("oceans2020", quick=quick)
        steps = sum(
            cell.scenario.steps * each.design.runs
            for each in plan.groups
            for cell in make_cells(each.design, each.changes)
        )
        assert steps <= most * 100_000


class TestAamas:
    def test_it_runs_every_published_k_of_both_presets(self):
        plan = make_plan("aamas2020")
        assert [each.labels["preset"] for each in plan.groups] == ["aamas2020", "aamas2020-constant"]
        assert all([p["neighbors"] for p in each.design.points] == list(range(10, 50, 3)) for each in plan.groups)


def test_another_paper_is_no_plan():
    with pytest.raises(KeyError):
        make_plan("icra2030")
