"""The later papers: plans that can run, statements that hold on made-up rows where they should, and only there."""

import numpy as np
import pytest

from shoal.experiments.cells import make_cells
from shoal.paper.alife_claims import alife_claims
from shoal.paper.density_claims import density_claims
from shoal.paper.figures_alife import alife_figures
from shoal.paper.figures_density import density_figures
from shoal.paper.later_plan import SPEED, density_groups, evasive_groups
from shoal.paper.leave_out import best_gain
from shoal.paper.plan import make_plan

SEEDS = 4


def rows_of(groups, **metrics):
    """Rows of every point of every group, with a little noise."""
    chance = np.random.default_rng(5)
    return {
        name: [
            {
                **point,
                "run": run,
                "status": "done",
                **{metric: of(point) + chance.normal(0.0, 1e-3) for metric, of in metrics.items()},
            }
            for point in points
            for run in range(SEEDS)
        ]
        for name, points in groups.items()
    }


def hill(at, top, width):
    return 0.5 - ((at - top) / width) ** 2


def evasive_rows(top=20, share=0.004, lower=0.02, agents=0.001):
    """Time on target: a hill over k, more with fast buoys, with a lower k of the fast, with more agents."""

    def time_on_target(point):
        k = point["neighbors"]
        low = lower * (k - point["fleets.BoB-1.neighbors"]) / 20 if "fleets.BoB-1.neighbors" in point else 0.0
        return hill(k, top, 100) + share * point["fast"] + low + agents * (point.get("agents", 50) - 50)

    return rows_of(evasive_groups(False), time_on_target=time_on_target)


def density_rows(steep=True, response=True, trade=1.0, best=True, numbers=True):
    """A step of tracking at a side of 22 m, where Xi peaks; more k: more on target, less covered."""

    def octaves(point):
        return np.log2(point["area.width"] / 22.0)

    def time_on_target(point):
        fall = 1.0 / (1.0 + np.exp(4.0 * octaves(point))) if steep else 0.5 - 0.1 * octaves(point)
        return fall + (0.1 * hill(point["neighbors"], 20, 40) if best else 0.0)

    def xi(point):
        return 0.5 - 0.05 * octaves(point) ** 2 if response else 0.5 - 0.05 * octaves(point)

    def engaged(point):
        agents = point.get("agents", 50)
        amid = abs(octaves(point) - np.log2(agents / 50) / 2) < 0.1
        size = 1.0 + (0.5 * np.log2(agents / 25) if numbers and amid else 0.0)
        return 2.0 * agents / 50 * size + trade * 0.02 * point["neighbors"]

    def coverage(point):
        return 0.6 - trade * 0.004 * point["neighbors"]

    return rows_of(density_groups(False), time_on_target=time_on_target, xi=xi, engaged=engaged, coverage=coverage)


@pytest.mark.parametrize("paper", ["alife2023", "density2023"])
@pytest.mark.parametrize("quick", [True, False])
def test_every_point_of_a_plan_is_a_scenario(paper, quick):
    plan = make_plan(paper, quick=quick)
    for group in plan.groups:
        assert len(make_cells(group.design, group.changes)) == len(group.design.points)


@pytest.mark.parametrize("quick", [False, True])
def test_where_fast_buoys_hear_fewer_the_same_k_for_all_is_run_too(quick):
    """Else the cases of E3 with that k would be left out unsaid."""
    groups = evasive_groups(quick)
    assert {point["neighbors"] for point in groups["unequal"]} <= {point["neighbors"] for point in groups["main"]}


def test_a_seed_is_judged_by_what_the_others_chose():
    luck = np.array([[1.0, 0.0], [0.0, 0.5], [0.0, 0.5]])
    assert best_gain(luck, np.zeros(3)).tolist() == [0.0, 0.0, 0.0]  # without it the first is best, without others not
    assert best_gain(np.array([[1.0, 2.0]] * 3), np.ones(3)).tolist() == [1.0] * 3
    assert np.isnan(best_gain(np.ones((1, 2)), np.ones(1))).all()


def verdicts(claims):
    return {claim.id: claim.verdict for claim in claims}


def test_what_is_said_of_evasive_targets_holds_where_numbers_say_so():
    assert set(verdicts(alife_claims(evasive_rows())).values()) == {"holds"}


@pytest.mark.parametrize(
    ("wrong", "claim"),
    [({"top": 60}, "E1"), ({"share": -0.004}, "E2"), ({"top": 60, "lower": -0.2}, "E3"), ({"agents": 0.05}, "E4")],
)
def test_and_not_where_they_do_not(wrong, claim):
    assert verdicts(alife_claims(evasive_rows(**wrong)))[claim] in ("does not hold", "holds partly")


def test_what_is_said_of_density_holds_where_numbers_say_so():
    found = verdicts(density_claims(density_rows()))
    assert set(found.values()) == {"holds"}, found


@pytest.mark.parametrize(
    ("wrong", "claim"),
    [({"response": False}, "D2"), ({"trade": -1.0}, "D3")],
)
def test_density_does_not_matter_where_numbers_do_not_say_so(wrong, claim):
    assert verdicts(density_claims(density_rows(**wrong)))[claim] in ("does not hold", "holds partly")


@pytest.mark.parametrize(
    ("wrong", "claim"), [({"steep": False}, "D1"), ({"best": False}, "D4"), ({"numbers": False}, "D5")]
)
def test_what_is_flat_is_no_phase(wrong, claim):
    assert verdicts(density_claims(density_rows(**wrong)))[claim] != "holds"


def test_figures_have_the_numbers_they_show(tmp_path):
    evasive, density = alife_figures(evasive_rows()), density_figures(density_rows())
    assert [figure.name for figure in (*evasive, *density)] == ["alife_k", "alife_lower", "alife_fewer", "density"]
    for figure in (*evasive, *density):
        assert all(np.isfinite(row["mean"]) for row in figure.data)
        figure.figure.savefig(tmp_path / f"{figure.name}.png")
    assert {row[SPEED] for row in evasive_rows()["main"]} == {row["target_speed"] for row in evasive[0].data}
    assert alife_figures({}) == density_figures({}) == []
