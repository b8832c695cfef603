"""What disturbs a swarm, in words, and who comes and goes."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.core.agents import NEVER
from shoal.viewer.conditions import MOST, comings_and_goings, conditions_of, kept_comings_and_goings


class TestConditionsOf:
    def test_a_swarm_that_nothing_disturbs_has_none(self):
        assert conditions_of(scenario()) == []

    @pytest.mark.parametrize(
        ("changes", "sentence"),
        [
            ({"network.adaptive": {"fewest": 5, "most": 25}}, "k adapts, from 5 to 25"),
            ({"network.range": 1500.0}, "nobody is heard beyond 1,500 m"),
            ({"network.loss": 0.3}, "30 % of the reports are lost"),
            ({"network.delay": 2}, "reports are 2 steps late"),
            ({"network.interval": 10.0}, "a report every 10 s"),
            ({"fleets.0.detection_probability": 0.8}, "BoB-1: notice a target in reach in 80 % of steps"),
            ({"fleets.1.mean_lifetime": 3600.0}, "BoB-0: last 3,600 s on average"),
            ({"losses": [{"step": 1000, "agents": [3, 4]}]}, "no. 3, 4 lost at step 1,000"),
            ({"losses": [{"step": 5, "count": 2, "fleet": "BoB-0"}]}, "2 of BoB-0 lost at step 5"),
            ({"joins": [{"step": 5, "count": 2, "fleet": "BoB-0"}]}, "2 of BoB-0 join at step 5"),
            ({"disturbances": [{"kind": "blackout", "since": 10.0, "until": 20.0}]}, "blackout from 10 s to 20 s"),
        ],
    )
    def test_what_does_is_said(self, changes, sentence):
        assert conditions_of(scenario(changes=changes)) == [sentence]


class TestComingsAndGoings:
    def test_are_told_in_the_order_of_their_steps(self):
        told = comings_and_goings([0, 40, 0], [NEVER, NEVER, 7])
        assert told == [(7, "lost", 2), (40, "joined", 1)]

    def test_of_very_many_are_cut(self):
        assert len(comings_and_goings(np.zeros(MOST + 5), np.arange(MOST + 5))) == MOST

    def test_of_frames_are_the_steps_at_which_they_are_seen(self):
        alive = [[True, False], [True, True], [False, True]]
        assert kept_comings_and_goings([0, 50, 100], alive) == [(50, "joined", 1), (100, "lost", 0)]
