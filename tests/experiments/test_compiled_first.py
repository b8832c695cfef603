"""Strategies are compiled before the runs, and whoever waits is told how long."""

from types import SimpleNamespace

import pytest

from scenarios import scenario
from shoal.experiments import compiled_first


@pytest.mark.parametrize(("warm", "long"), [(True, "some seconds each"), (False, "and the engine, once: a minute or")])
def test_the_first_line_says_whether_the_engine_is_compiled_too(warm, long, monkeypatch):
    stood_in = {
        "needs_compiling": lambda chosen: True,
        "engine_is_compiled": lambda: warm,
        "mark_compiled": lambda chosen: None,
        "Simulation": lambda chosen: SimpleNamespace(advance=lambda steps: None),
    }
    for name, instead in stood_in.items():
        monkeypatch.setattr(compiled_first, name, instead)
    told, tasks = [], [(SimpleNamespace(scenario=scenario("oceans2020")), 0)]
    assert list(compiled_first.compiled_first(lambda wanted: iter(wanted), told.append)(tasks)) == tasks
    assert len(told) == 1
    assert told[0].startswith("compiling knn-pso (1 of 1, ")
    assert long in told[0]
