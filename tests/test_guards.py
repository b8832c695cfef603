"""What a run refuses rather than spoil."""

import numpy as np
import pytest

import shoal
from shoal.core.errors import RecordError, ScenarioError, StrategyError
from shoal.scenario.load import read_table, scenario_from


@pytest.fixture
def simulation():
    return shoal.Simulation(shoal.load("oceans2020"))


def test_time_goes_forward(simulation):
    with pytest.raises(ScenarioError, match="ask for 0 or more"):
        simulation.advance(-5)
    assert simulation.number == 0


@pytest.mark.parametrize("lost", ["number", "swarm.vx", "targets.x"])
def test_a_saved_state_that_lacks_something_changes_nothing(simulation, tmp_path, lost):
    other = shoal.Simulation(shoal.load("oceans2020"))
    other.advance(50)
    state = other.state()
    del state[lost]
    np.savez(tmp_path / "state.npz", **state)
    before = {name: np.array(part) for name, part in simulation.state().items()}
    with pytest.raises(RecordError):
        simulation.restore(tmp_path / "state.npz")
    after = simulation.state()
    assert all(np.array_equal(before[name], after[name]) for name in before)


def test_numbers_that_are_not_finite_end_the_run(simulation):
    simulation.advance(10)
    with pytest.raises(StrategyError, match="not finite"), simulation.edit() as now:
        now.swarm.vx[3] = np.nan  # as a strategy that divides by zero would leave it
    with pytest.raises(StrategyError, match="not finite"):
        simulation.advance(1)


def test_numbers_that_are_not_finite_do_not_hang_the_run(simulation):
    with pytest.raises(StrategyError, match="not finite"), simulation.edit() as now:
        now.swarm.x[3] = np.nan
    with pytest.raises(StrategyError, match="not finite"):
        simulation.advance(20)


def test_a_file_with_a_byte_order_mark_is_read(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(shoal.to_toml(shoal.load("oceans2020")), encoding="utf-8-sig")
    assert shoal.load(file) == shoal.load("oceans2020")


@pytest.mark.parametrize("word", ["name", "file", "source"])
def test_a_parameter_cannot_have_a_word_of_the_table(tmp_path, word):
    file = tmp_path / "mine.py"
    file.write_text(
        "from typing import NamedTuple\nimport shoal\n"
        f"class P(NamedTuple):\n    {word}: float = 1.0\n"
        "@shoal.strategy('mine', params=P)\ndef mine(me, heard, memory, params, draw):\n    return 0.0, 0.0\n"
    )
    with pytest.raises(StrategyError, match="word of the"):
        scenario_from(read_table("oceans2020") | {"strategy": {"file": str(file)}})
