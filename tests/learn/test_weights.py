"""Weights are parameters of a strategy; a file with others as defaults is a strategy like any."""

import pytest

from scenarios import scenario
from shoal.learn.errors import LearnError
from shoal.learn.weights import bounds_of, rewritten, source_text, trial, weights_of
from shoal.scenario.crew import crew_of
from shoal.scenario.load import load

ENCIRCLE = scenario("oceans2020", {"strategy": "encircle"})
TWO = (
    "from typing import Annotated, NamedTuple\nimport shoal\n"
    "class Två(NamedTuple):\n    é: float = 1.0; gain: float = (\n        -2.5  # why\n    )\n    count: int = 3\n"
    "@shoal.strategy('två'.replace('å', 'a') if 0 else 'two', params=Två)\n"
    "def two(me, heard, memory, params, draw):\n    return params.gain, params.é\n"
)


def written(tmp_path, text):
    file = tmp_path / "mine.py"
    file.write_text(text, encoding="utf-8")
    return str(file)


def test_all_numbers_with_decimals_are_weights_within_their_ranges():
    weights = {weight.name: weight for weight in weights_of(ENCIRCLE)}
    assert list(weights) == list(ENCIRCLE.strategy.params)
    assert (weights["spread"].low, weights["spread"].high) == (0.0, 1.0)
    assert weights["ring"].low == pytest.approx(0.0095)  # a length stays one
    low, high = bounds_of([weights["spread"]])[0]
    assert weights["spread"].start + low * weights["spread"].scale == pytest.approx(0.0)
    assert weights["spread"].start + high * weights["spread"].scale == pytest.approx(1.0)


def test_a_trial_has_other_weights_and_the_same_code():
    weights = weights_of(ENCIRCLE, ["push", "lead"])
    tried = trial(ENCIRCLE, weights, [0.5, 0.2])
    params = crew_of(tried).params
    assert (params.push, params.lead) == (0.5, 0.2)
    assert params.ring == ENCIRCLE.strategy.params["ring"]
    assert type(params) is ENCIRCLE.strategy.owner.params


def test_the_text_of_a_built_in_strategy_becomes_one_of_its_own(tmp_path):
    owner, weights = ENCIRCLE.strategy.owner, weights_of(ENCIRCLE)
    values = [weight.start * 0.9 for weight in weights]
    file = written(tmp_path, rewritten(source_text(ENCIRCLE.strategy), owner, "my-ring", weights, values))
    mine = load("oceans2020", strategy=file).strategy
    assert mine.name == "my-ring"
    assert [mine.params[weight.name] for weight in weights] == values


def test_a_default_that_follows_the_scenario_is_said_for_the_paper_s():
    bay = load("bay", strategy="encircle")
    (weight,) = [each for each in weights_of(bay) if each.name == "ring"]
    assert weight.start == bay.strategy.params["ring"] > 10.0
    assert weight.default(2 * weight.start) == pytest.approx(1.9)


def test_defaults_are_found_wherever_on_a_line_they_stand(tmp_path):
    chosen = load("oceans2020", strategy=written(tmp_path, TWO.replace("'två'.replace('å', 'a') if 0 else ", "")))
    text = source_text(chosen.strategy)
    changed = rewritten(text, chosen.strategy.owner, "other", weights_of(chosen), [0.25, 4.0])
    assert "é: float = 0.25; gain: float = (\n        4.0  # why" in changed
    assert '@shoal.strategy("other"' in changed
    assert changed.replace("0.25", "1.0").replace("4.0 ", "-2.5 ").replace('"other"', "'two'") == text


@pytest.mark.parametrize(
    ("text", "names", "what"),
    [
        (TWO, [], "does not declare its name in plain sight"),
        (TWO, ["gan", "é"], "did you mean 'gain'"),
        (TWO, ["gain"], "1 parameters that are numbers with decimals"),
    ],
)
def test_what_cannot_be_learned_or_written_is_refused(tmp_path, text, names, what):
    chosen = load("oceans2020", strategy=written(tmp_path, text))
    owner = chosen.strategy.owner

    def write():
        rewritten(text, owner, "mine", weights := weights_of(chosen, names), [1.0] * len(weights))

    with pytest.raises(LearnError, match=what):
        write()
