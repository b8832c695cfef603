"""The sentence that a record begins with: every number is the record's, and nothing is said that was not measured."""

from dataclasses import replace

import numpy as np
import pytest

import shoal
from shoal.metrics.tally import new_tally
from shoal.record.sentence import quotable
from shoal.record.words import mean_text

STEPS = 100  # of 0.1 s


@pytest.fixture(scope="module")
def record():
    return shoal.simulate("oceans2020", steps=STEPS)


def made(record, *runs, scenario=None):
    """The record with these sums instead of its own: steps at which a target is there, is watched, is not found yet."""
    scenario = scenario or record.scenario
    targets, tallies = len(scenario.targets), []
    for run in runs:
        empty = new_tally(STEPS, 1, 2, 50, targets)
        there = run.get("there", STEPS)
        each = np.full((1, targets), float(there))
        tallies.append(
            empty._replace(
                steps=np.full_like(empty.steps, STEPS),
                present=np.full_like(empty.present, there),
                on_target=np.full_like(empty.on_target, run.get("watched", 0)),
                target_steps=each,
                undetected=np.full_like(each, run.get("undetected", 0)),
                losses=np.full_like(each, run.get("losses", 0)),
                ended=np.full_like(each, run.get("ended", 0)),
                ended_steps=np.full_like(each, run.get("ended_steps", 0)),
            )
        )
    return replace(record, scenario=scenario, tallies=tuple(tallies))


def test_of_a_run_says_how_much_how_often_and_how_long(record):
    told = quotable(made(record, {"watched": 80, "losses": 4, "ended": 4, "ended_steps": 20}))
    assert told == ("The target was watched 80 % of the time; it was lost 1,440 times an hour, for 0.500 s each time.")


def test_of_several_runs_has_intervals(record):
    runs = [{"watched": watched, "losses": 4, "ended": 4, "ended_steps": 20} for watched in (79, 80, 81)]
    assert quotable(made(record, *runs)).startswith("The target was watched 80.0 % [77.4, 82.4] of the time; ")


def test_numbers_are_those_of_the_table(record):
    told = quotable(record)
    assert f"{100 * record.estimate('time_on_target').mean:g} %" in told
    assert f" {mean_text(record.estimate('losses'))} times an hour" in told
    assert f" {mean_text(record.estimate('reacquisition'))} s" in told


def test_a_target_that_is_absent_at_times_is_not_held_against_the_swarm(record):
    assert "40 % of the time that it was there; once found, it was never lost." in quotable(
        made(record, {"there": 50, "watched": 20})
    )


def test_a_loss_that_never_ends(record):
    assert quotable(made(record, {"watched": 50, "losses": 1})).endswith(
        "; it was lost 360 times an hour and never found again."
    )


def test_never_detected(record):
    nothing = {"undetected": STEPS}
    assert quotable(made(record, nothing)) == "The target was never detected in the run."
    assert quotable(made(record, nothing, nothing)) == "The target was never detected in the 2 runs."


def test_found_in_some_runs_only(record):
    told = quotable(made(record, {"watched": 50}, {"undetected": STEPS}, {"watched": 50}))
    assert told.endswith("; it was found in 2 of the 3 runs.")


def test_no_target_was_ever_there(record):
    absent = {"there": 0}
    assert quotable(made(record, absent)) == "No target was ever there, so there is no time on target."
    assert quotable(made(record, absent, {"watched": 9})).startswith("In some runs no target was ever there")


def test_several_targets(record):
    two = record.scenario.model_copy(update={"targets": record.scenario.targets * 2})
    told = quotable(made(record, {"watched": 80, "losses": 2, "ended": 2, "ended_steps": 20}, scenario=two))
    assert told == (
        "At least one of the 2 targets was watched 80 % of the time; a target was lost 720 times an hour, for 1 s each "
        "time."
    )


def test_what_was_not_measured_is_not_said():
    told = quotable(shoal.simulate("oceans2020", steps=STEPS, metrics=["time_on_target"]))
    assert told.endswith(" of the time.")
