"""The steersman of a session: changes are logged, and a log is followed to the same bits."""

import json

import pytest

from shoal.core.errors import ScenarioError
from shoal.run.change_log import log_of
from shoal.scenario.load import load, read_table
from shoal.viewer.requests import parse_request
from shoal.viewer.session import Session

STEERED = (
    (10, {"do": "change", "changes": {"neighbors": 9}}),
    (20, {"do": "restart", "seed": 7}),
    (5, {"do": "change", "changes": {"target_speed": 4.5}}),
    (12, {"do": "kill", "agent": 7}),
    (12, {"do": "drag", "x": 3.0, "y": -2.0}),
    (12, {"do": "drag", "x": 4.0, "y": -2.5}),
    (30, {"do": "change", "changes": {"strategy": "lattice"}}),
    (41, {"do": "add", "x": 2.0, "y": 2.0}),
    (50, {"do": "change", "changes": {"strategy": "knn-pso", "strategy.delta": 0.03, "fast": 20}}),
)


@pytest.fixture(scope="module")
def steered():
    one = Session([read_table("oceans2020")])
    for step, said in STEERED:
        played(one, step - one.number)
        one.obey(parse_request(json.dumps(said)))
    return played(one, 70 - one.number)


@pytest.fixture(scope="module")
def log(steered):
    """What the page would save."""
    request = parse_request('{"do": "export", "what": "changes"}')
    return log_of(json.loads(steered.export(request))["text"])


def test_it_makes_the_same_bits(steered, log):
    again = Session([each.table for each in log.runs], script=log, speed=20)
    for _ in range(100):
        if again.playing:
            again.play_on()
    assert (again.number, again.playing, again.steersman.script_end) == (70, False, None)
    assert bits(again) == bits(steered)
    assert again.runs[0].message == steered.runs[0].message
    assert again.steersman.log == log


def test_a_target_dragged_on_at_one_step_is_logged_once(log):
    assert [entry.step for entry in log.entries] == [10, 20, 5, 12, 12, 30, 41, 50]
    assert log.step == 70


def test_nobody_else_changes_anything_before_its_end(log):
    again = Session([each.table for each in log.runs], script=log)
    with pytest.raises(ScenarioError, match="the changes of a log are made until step 70"):
        again.obey(parse_request('{"do": "kill", "agent": 1}'))


def test_the_scenario_as_it_is_set_now_is_a_file_that_runs(steered, tmp_path):
    text = json.loads(steered.export(parse_request('{"do": "export", "what": "scenario"}')))["text"]
    (tmp_path / "now.toml").write_text(text, encoding="utf-8")
    assert load(tmp_path / "now.toml") == steered.runs[0].simulation.scenario
    assert "step 70 of a watched run" in text.splitlines()[0]


def played(one, frames):
    for _ in range(frames):
        one.play_on()
    return one


def bits(one):
    return {name: part.tobytes() for name, part in one.runs[0].simulation.state().items()}
