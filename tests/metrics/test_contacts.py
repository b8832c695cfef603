"""First detection, losses, re-acquisition."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from coasting import coasting
from shoal.metrics.contacts import tally_contacts
from shoal.metrics.contract import Step
from shoal.metrics.summary import evaluate
from shoal.metrics.tally import new_tally
from shoal.run.facts import facts_of
from shoal.world.targets.catalogue import TARGET_FIELDS


def counted(*watchers, present=None):
    """Tally of targets with so many watchers step by step, one list per target; absent where `present` says so."""
    targets = np.zeros(len(watchers), TARGET_FIELDS).view(np.recarray)
    targets["lost"] = -1
    tally = new_tally(steps=len(watchers[0]), batches=1, fleets=1, agents=2, targets=len(watchers))
    for step in range(len(watchers[0])):
        targets["watchers"] = [each[step] for each in watchers]
        targets["present"] = 1 if present is None else present[step]
        tally_contacts(tally, Step(step, 0, 0), None, None, targets, None)
    return tally


def of(tally, name):
    return getattr(tally, name)[0].tolist()


class TestSequences:
    """By hand: o nobody watches, x somebody does, - the target is not there."""

    @pytest.mark.parametrize(
        ("sequence", "undetected", "losses", "ended", "ended_steps"),
        [
            ("", 0, 0, 0, 0),
            ("oooo", 4, 0, 0, 0),
            ("xxxx", 0, 0, 0, 0),
            ("ooxx", 2, 0, 0, 0),
            ("ooxo", 2, 1, 0, 0),
            ("xooo", 0, 1, 0, 0),
            ("xox", 0, 1, 1, 1),
            ("oxooxoooxo", 1, 3, 2, 5),
            ("o-ox", 2, 0, 0, 0),
            ("x--o--ox", 0, 1, 1, 2),
            ("x---x", 0, 0, 0, 0),
            ("--x-o", 0, 1, 0, 0),
        ],
    )
    def test_are_counted(self, sequence, undetected, losses, ended, ended_steps):
        steps = sequence or "x"
        tally = counted([each == "x" for each in steps], present=[each != "-" for each in steps])
        assert of(tally, "undetected") == [undetected]
        assert of(tally, "losses") == [losses]
        assert of(tally, "ended") == [ended]
        assert of(tally, "ended_steps") == [ended_steps]
        assert tally.loss_lengths.sum() == ended

    def test_targets_are_counted_apart(self):
        tally = counted([0, 1, 0, 1], [1, 0, 0, 0])
        assert of(tally, "undetected") == [1, 0]
        assert of(tally, "losses") == [1, 1]
        assert of(tally, "ended") == [1, 0]

    @pytest.mark.parametrize(
        ("length", "bin_"), [(1, 0), (2, 1), (3, 1), (4, 2), (7, 2), (8, 3), (1023, 9), (1024, 10)]
    )
    def test_a_loss_lies_in_the_bin_of_its_length(self, length, bin_):
        lengths = counted([1] + [0] * length + [1]).loss_lengths[0]
        assert lengths.tolist() == [1.0 if each == bin_ else 0.0 for each in range(32)]

    @given(watched=st.lists(st.booleans(), min_size=1, max_size=80))
    def test_every_step_is_before_the_first_detection_or_watched_or_lost(self, watched):
        tally = counted(watched)
        words = "".join("x" if each else "o" for each in watched)
        losses = [part for part in words.lstrip("o").split("x") if part]
        ended = losses[:-1] if words.endswith("o") and losses else losses
        assert of(tally, "undetected") == [len(words) - len(words.lstrip("o"))]
        assert of(tally, "losses") == [len(losses)]
        assert of(tally, "ended") == [len(ended)]
        assert of(tally, "ended_steps") == [sum(map(len, ended))]


class TestInARun:
    """A buoy crosses a target of radius 1 m at 1 m/s: from x = -3 it is on it from 2 s to 4 s."""

    @pytest.fixture
    def simulation(self):
        simulation = coasting([(-3.05, 0), (9, 9), (9, -9)], [(1, 0), (0, 0), (0, 0)], steps=60)
        simulation.advance(60)
        return simulation

    def metric(self, simulation, name):
        return evaluate(name, simulation.tally, facts_of(simulation.scenario))[0]

    def test_the_first_detection_is_in_seconds(self, simulation):
        assert self.metric(simulation, "first_detection") == pytest.approx(2.1)

    def test_losses_are_per_hour(self, simulation):
        assert self.metric(simulation, "losses") == pytest.approx(3600 / 6)

    def test_a_loss_that_never_ended_has_no_length(self, simulation):
        assert math.isnan(self.metric(simulation, "reacquisition"))

    def test_with_a_second_buoy_behind_it_has(self):
        places, velocities = [(-3.05, 0), (-6.05, 0), (9, 9)], [(1, 0), (1, 0), (0, 0)]
        simulation = coasting(places, velocities, steps=60)
        simulation.advance(60)
        assert self.metric(simulation, "reacquisition") == pytest.approx(1.0)
        assert self.metric(simulation, "losses") == pytest.approx(3600 / 6)
