"""The readings are listed by a rule, each can run, and no two are the same scenario."""

import itertools

from shoal.experiments.cells import make_cells
from shoal.paper.readings import ANCHORS, BOXES, MOTIONS, OMEGAS, SWITCHES, printed, readings
from shoal.paper.readings_plan import FINAL, SCREEN, groups_of
from shoal.scenario.edit import apply
from shoal.scenario.load import load, read_table, scenario_from


def scenario_of(reading):
    return scenario_from(apply(read_table("oceans2020"), reading.changes))


def test_there_are_all_combinations_and_each_switch_at_each_anchor():
    assert len(readings()) == len(OMEGAS) * len(BOXES) * len(MOTIONS) + len(ANCHORS) * len(SWITCHES) == 30


def test_no_two_are_the_same_scenario_and_no_two_share_a_folder():
    assert len({scenario_of(each).hash for each in readings()}) == 30
    assert len({each.slug for each in readings()}) == 30


def test_the_printed_one_is_the_preset():
    assert scenario_of(printed()).hash == load("oceans2020").hash
    assert printed() in readings()
    assert [each.departures for each in readings()].count(0) == 1


def test_the_box_is_told_as_half_sides():
    for reading, (omega, (wall, waypoints), motion) in zip(
        readings(), itertools.product(OMEGAS, BOXES, MOTIONS), strict=False
    ):
        scenario = scenario_of(reading)
        assert scenario.area.width / 2 - scenario.area.agent_margin == wall
        assert scenario.area.width / 2 - scenario.targets[0].margin == waypoints
        assert scenario.targets[0].kind == {"waypoints": "waypoint", "walk": "walk"}[motion]
        assert scenario.strategy.params["inertia"] == omega


def test_every_point_of_both_stages_can_run():
    for reading in readings():
        for stage in (SCREEN, FINAL):
            for group in groups_of(reading, stage):
                cells = make_cells(group.design, group.changes)
                assert {cell.scenario.steps for cell in cells} == {stage.steps_of(reading)}
                assert {cell.scenario.targets[0].speed for cell in cells} == {3.0, 5.0}


def test_buoys_that_move_one_after_the_other_are_screened_half_as_long():
    slow = [each for each in readings() if each.sequential]
    assert len(slow) == 2
    assert {SCREEN.steps_of(each) for each in slow} == {SCREEN.steps // 2}
    assert {FINAL.steps_of(each) for each in slow} == {100_000}
