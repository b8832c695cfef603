"""What looks promising was not tried, can run, and lies where the front would gain."""

import numpy as np

from searches import chance
from shoal.experiments.fleet_range import FleetRange
from shoal.experiments.fleet_trial import FleetSearch, FleetTrial
from shoal.experiments.front import front
from shoal.experiments.objective import objective
from shoal.experiments.promising import expected_front, promising
from shoal.experiments.surrogate import halton
from shoal.experiments.variable import Variable
from shoal.scenario.load import load

SEARCH = FleetSearch(
    "oceans2020", {}, load("oceans2020"), [FleetRange("BoB-1", 0, 30, 3), FleetRange("BoB-0", 0, 45, 1)],
    [Variable("neighbors", 4, 40)], objective("cost", -1), objective("time_on_target", 1),
)  # fmt: skip
PATHS = ("fleets.BoB-1.count", "fleets.BoB-0.count")


def worth(point):
    """Slow ones are the better buy; k is best at 20."""
    fast, slow = (point[path] for path in PATHS)
    return 1 - np.exp(-(slow + 1.4 * fast) / 40) - 0.0003 * (point["neighbors"] - 20) ** 2


def trial(point, luck=0.0):
    cost = 3.0 * point[PATHS[0]] + point[PATHS[1]]
    counts = tuple(point[path] for path in PATHS)
    return FleetTrial(point, counts, (cost, cost), (worth(point) + luck, worth(point) - luck / 2))


POINTS = [
    {PATHS[0]: int(30 * fast), PATHS[1]: 2 + int(43 * slow), "neighbors": 4 + int(36 * k)}
    for fast, slow, k in halton(40, 0, 3)
]
TRIED = [trial(each, luck=0.1 * chance(number)) for number, each in enumerate(POINTS)]


def test_points_are_new_and_have_two_agents_or_more():
    found = promising(SEARCH, TRIED, 3, 7)
    assert len(found) == 3
    assert all(each not in POINTS and SEARCH.agents(each) > 1 for each in found)
    assert found == promising(SEARCH, TRIED, 3, 7) != promising(SEARCH, TRIED, 3, 8)


def test_points_lie_where_slow_ones_and_the_best_k_are():
    found = [each for begin in range(4) for each in promising(SEARCH, TRIED, 3, begin)]
    assert np.mean([each[PATHS[0]] for each in found]) < 12
    assert np.mean([abs(each["neighbors"] - 20) for each in found]) < 8


def test_of_too_few_nothing_is_expected():
    assert promising(SEARCH, TRIED[:4], 3, 0) == []
    assert expected_front(SEARCH, TRIED[:4]) == []


def test_a_lucky_one_among_poor_neighbors_is_not_expected_on_the_front():
    near = [
        {PATHS[0]: fast, PATHS[1]: slow, "neighbors": k} for fast in (13, 14) for slow in (2, 3) for k in (19, 20, 21)
    ]
    lucky = trial(near[0], luck=1.2)
    everybody = [*TRIED, *map(trial, near[1:]), lucky]
    seen = front([each.means[0] for each in everybody], [each.means[1] for each in everybody])
    assert lucky in [everybody[at] for at in seen]
    assert lucky not in expected_front(SEARCH, everybody)
