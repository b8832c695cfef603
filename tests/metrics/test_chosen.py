"""Metrics that a scenario names are as they are among all, to the bit; the others are unknown, and not counted."""

import math

import numpy as np
import pytest

from shoal.core.errors import ScenarioError
from shoal.drawing.summary import summary_figure
from shoal.experiments.cells import make_cells
from shoal.experiments.design import Design
from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.chosen import skipped
from shoal.metrics.summary import METRICS
from shoal.metrics.tally import SUMS
from shoal.record.files import open_record
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.scenario.load import load
from shoal.study.check import check

STEPS = 1200


@pytest.fixture(scope="module")
def everything():
    return simulate("oceans2020", steps=STEPS)


def measured(metrics):
    bits = skipped(metrics)
    return {each.name for number, each in enumerate(MEASUREMENTS) if not bits >> number & 1}


def test_what_a_metric_needs_is_counted():
    assert skipped([]) == 0
    assert measured(["time_on_target"]) == {"time_on_target"}
    assert measured(["xi"]) == {"time_on_target", "velocity_fluctuation"}
    assert measured(["clustering", "stationary"]) == {"time_on_target", "graph", "heading_bearing"}


@pytest.mark.parametrize("name", METRICS)
def test_each_alone_is_what_it_is_among_all(everything, name):
    alone = simulate("oceans2020", steps=STEPS, metrics=[name])
    assert alone.listed() == [each for each in everything.listed() if each == name]
    ours, theirs = alone.estimate(name), everything.estimate(name)
    assert ours == theirs or (math.isnan(ours.mean) and math.isnan(theirs.mean))


def test_the_run_is_the_same_and_nothing_else_is_counted():
    some, all_of_them = (Simulation(load("oceans2020", steps=STEPS, metrics=names)) for names in ("xi", ""))
    for each in (some, all_of_them):
        each.advance(STEPS)
    assert some.swarm.x.tobytes() == all_of_them.swarm.x.tobytes()
    counted = {part.name for each in MEASUREMENTS if each.name in measured(["xi"]) for part in each.sums}
    for name in SUMS:
        raw, known = getattr(some.moment.tally, name), getattr(some.tally, name)
        assert np.isnan(known).all() != (name in counted)
        assert name in counted or (raw == SUMS[name].start).all()


def test_a_record_is_kept_read_and_drawn(tmp_path):
    made = simulate("oceans2020", steps=STEPS, metrics=["xi"], out=tmp_path / "record")
    read = open_record(tmp_path / "record")
    assert read.listed() == made.listed() == ["xi"]
    assert read.estimate("xi") == made.estimate("xi")
    assert math.isnan(read.estimate("coverage").mean)
    summary_figure(read).savefig(tmp_path / "page.png")


def test_which_they_are_is_part_of_a_scenario():
    named = load("oceans2020", metrics="xi, clustering")
    assert named.metrics == ("xi", "clustering")
    assert named.hash != load("oceans2020").hash


@pytest.mark.parametrize("ask", [simulate, check, lambda scenario: make_cells(Design(scenario, ({},), 1), {})])
def test_a_name_that_none_has(ask):
    with pytest.raises(ScenarioError, match=r"metrics: has 'clusterin', which is none\n  fix: did you mean"):
        ask(load("oceans2020", metrics="clusterin"))
