"""Specs become the arrays that the engine works on."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.learn.spec import Act, acting
from shoal.strategies.guided import GUIDED

CHOSEN = scenario("oceans2020")


def meant(actions, numbers):
    """What actions mean for the first agent."""
    return actions.middle[0] + actions.half[0] * np.array(numbers)


def test_a_velocity_is_a_share_of_ones_own_top_speed_or_in_meters_a_second():
    _, shares = acting(Act(), CHOSEN)
    _, meters = acting(Act(scaled=False), CHOSEN)
    assert meant(shares, [1.0, -0.5]) == pytest.approx([2.6, -1.3])
    assert shares.half[49].tolist() == [1.0, 1.0]
    assert meant(meters, [1.0, -0.5]).tolist() == [1.0, -0.5]


def test_a_r_is_what_the_paper_s_rule_has_in_this_scenario():
    crew, actions = acting(Act(kind="repulsion"), CHOSEN)
    assert all(each is GUIDED for each in crew.strategies)
    assert meant(actions, [-1.0, 1.0]).tolist() == [0.375, 1.0]
    bay, wide = acting(Act(kind="repulsion"), scenario("bay"))
    assert meant(wide, [1.0, 0.0])[0] > 10.0
    assert bay.params.repulsion_step > 1.0


def test_memory_is_that_of_the_scenario_s_own_strategy():
    crew, actions = acting(Act(kind="memory", bounds={"repulsion": (0.5, 1.0)}), CHOSEN)
    assert crew.strategies[0].name == "knn-pso"
    assert actions.columns.tolist() == [crew.memory.index("repulsion")]
    assert meant(actions, [0.0]).tolist() == [0.75]
    assert (actions.low[0], actions.high[0]) == (-1.0, 1.0)
