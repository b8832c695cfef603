"""[[disturbances]] in scenarios: their fields, their hash, what is refused."""

import pickle

import pytest

from scenarios import scenario
from shoal.core.errors import ScenarioError
from shoal.scenario.load import load, to_toml

CURRENT = {"kind": "current", "east": "1 kn"}


def disturbed(**changes):
    return scenario(changes={"disturbances": [{**CURRENT, **changes}]})


def test_units_are_read_and_defaults_filled_in():
    (current,) = disturbed().disturbances
    assert current.east == pytest.approx(0.514444, abs=1e-6)
    assert (current.north, current.fleet, current.since, current.until) == (0.0, None, 0.0, None)


def test_none_changes_no_hash_and_one_does():
    assert scenario(changes={"disturbances": []}).hash == scenario().hash
    assert len({scenario().hash, disturbed().hash, disturbed(north=1.0).hash, disturbed(since=1.0).hash}) == 4


def test_kinds_with_the_same_fields_differ():
    kinds = [scenario(changes={"disturbances": [{"kind": kind}]}).hash for kind in ("current", "blackout")]
    assert len(set(kinds)) == 2


def test_they_are_written_read_and_sent_to_other_processes(tmp_path):
    chosen = disturbed(fleet="BoB-0", until="1 min")
    (tmp_path / "mine.toml").write_text(to_toml(chosen), encoding="utf-8")
    assert load(tmp_path / "mine.toml") == chosen == pickle.loads(pickle.dumps(chosen))


def test_they_change_by_path():
    assert disturbed().with_(**{"disturbances.0.north": "2 kn"}).disturbances[0].north == pytest.approx(
        1.02889, abs=1e-5
    )


def test_lengths_of_none_of_them_grow_with_the_arena():
    from shoal.scenario.scaled import multiplied

    table = multiplied(disturbed(), {"m": 10.0})
    assert table["disturbances"][0]["east"] == disturbed().disturbances[0].east


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"kind": "curent"}, "no disturbance is of kind 'curent'"),
        ({"kind": "curent"}, "did you mean 'current'"),
        ({"est": 1.0}, "did you mean 'east'"),
        ({"gust": -1.0}, "greater than or equal to 0"),
        ({"east": "1 kg"}, "quantity in m/s"),
        ({"fleet": "BoB-7"}, "there are: BoB-1, BoB-0"),
        ({"since": 5.0, "until": 5.0}, "not after since"),
        ({"since": -1.0}, "greater than or equal to 0"),
    ],
)
def test_what_is_wrong_is_said_once(changes, says):
    with pytest.raises(ScenarioError) as error:
        disturbed(**changes)
    assert says in str(error.value)


def test_a_kind_must_be_given():
    with pytest.raises(ScenarioError, match="a disturbance needs a kind"):
        scenario(changes={"disturbances": [{"east": 1.0}]})
