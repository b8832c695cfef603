import sys

import pytest

from shoal.core.errors import MissingExtraError
from shoal.experiments.asker import Asker
from shoal.experiments.objective import objective
from shoal.experiments.variable import parse_variable

VARIABLES = [
    parse_variable(each) for each in ("neighbors=5:40", "strategy.delta=0.002:0.05", "strategy=knn-pso,pursuit")
]
GOALS = [objective("time_on_target", 1)]


def asked(seed, sampler="tpe", count=14):
    asker = Asker(VARIABLES, GOALS, sampler, seed)
    points = []
    for _ in range(count):
        trial, point = asker.ask()
        asker.tell(trial, [point["neighbors"] / 40])
        points.append(point)
    return points


@pytest.mark.parametrize("sampler", ["tpe", "random"])
def test_the_seed_decides_what_is_asked(sampler):
    assert asked(1, sampler) == asked(1, sampler) != asked(2, sampler)


def test_values_are_those_of_the_variables():
    for point in asked(3):
        assert 5 <= point["neighbors"] <= 40
        assert 0.002 <= point["strategy.delta"] <= 0.05
        assert point["strategy"] in ("knn-pso", "pursuit")


def test_what_is_preferred_is_asked_next():
    asker, wanted = Asker(VARIABLES, GOALS, "tpe", 1), {"neighbors": 7, "strategy.delta": 0.01, "strategy": "pursuit"}
    asker.prefer(wanted)
    assert asker.ask()[1] == wanted


def test_what_is_known_from_elsewhere_is_learned_unless_it_is_out_of_range():
    asker = Asker(VARIABLES, GOALS, "tpe", 1)
    asker.learn({"neighbors": 7, "strategy.delta": 0.01, "strategy": "pursuit"}, [0.5])
    asker.learn({"neighbors": 49, "strategy.delta": 0.01, "strategy": "pursuit"}, [0.9])
    asker.learn({"neighbors": 7, "strategy.delta": None, "strategy": "pursuit"}, [0.9])
    assert [each.values for each in asker._study.trials] == [[0.5]]


def test_without_optuna_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "optuna", None)
    with pytest.raises(MissingExtraError, match=r"optuna: is not installed, .*\n  fix: pip install '\.\[tune\]'"):
        Asker(VARIABLES, GOALS, "tpe", 1)
