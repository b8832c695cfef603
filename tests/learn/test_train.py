"""What is learned is a strategy file that runs everywhere."""

import numpy as np
import pytest

from buoys import differences, tape_of
from commands import shoal
from scenarios import scenario
from shoal.core.errors import MissingExtraError
from shoal.learn.train import Terms, train
from shoal.run.simulation import Simulation

pytest.importorskip("cmaes", reason="learning needs cmaes: pip install '.[learn]'")
IDS = (0, 14, 15, 49)
QUICK = Terms(budget=1.5, steps=500, jobs=1)


@pytest.fixture(scope="module")
def learned(tmp_path_factory):
    """Compiled once: some 10 s."""
    return train("linear", "oceans2020", tmp_path_factory.mktemp("learn") / "my_policy.py", terms=QUICK)


def test_it_stands_above_a_swarm_that_stands_still(learned):
    assert learned.learned.mean > 0.8  # a motionless lattice: 0.75
    assert len(learned.learned.runs) == len(learned.start.runs) == 10
    assert learned.generations > 0


def test_the_file_is_a_strategy_with_the_weights_as_defaults(learned):
    chosen = scenario("oceans2020", {"strategy": {"file": str(learned.file)}})
    assert chosen.strategy.name == learned.name == "my-policy"
    assert chosen.strategy.params == pytest.approx(learned.weights, rel=1e-15)


def test_buoys_decide_as_the_engine_does_to_the_bit(learned):
    chosen = scenario("oceans2020", {"steps": 300, "strategy": {"file": str(learned.file)}})
    tape = tape_of(chosen, 300)
    assert differences(tape, chosen, IDS) == []
    assert np.hypot(tape.command_x, tape.command_y).mean() > 0.3


def test_the_fresh_runs_are_those_of_the_next_seed(learned):
    chosen = scenario("oceans2020", {"steps": 2000, "seed": 2, "strategy": {"file": str(learned.file)}})
    simulation = Simulation(chosen, 3)
    simulation.advance(2000)
    tally = simulation.tally
    assert learned.learned.runs[3] == pytest.approx(tally.on_target.sum() / tally.present.sum())


def test_an_interrupt_keeps_what_was_found(learned, tmp_path):
    def stop(generation, share):
        raise KeyboardInterrupt

    file = tmp_path / "stopped.py"
    with pytest.raises(KeyboardInterrupt):
        train(str(learned.file), "oceans2020", file, terms=QUICK, report=stop)
    assert scenario("oceans2020", {"strategy": {"file": str(file)}}).strategy.name == "stopped"
    assert [each.name for each in tmp_path.glob("*.*")] == ["stopped.py"]


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["linear", "--out", "Mine.py"], "does not give a strategy its name"),
        (["linear", "--out", "encircle.py"], "comes with Shoal"),
        (["linear", "--out", "nowhere/mine.py"], "there is no folder"),
        (["linear", "--budget", "3 m"], "--budget"),
        (["linear", "--budget", "0 s"], "give a time above 0"),
        (["no-such-strategy"], "no strategy is called"),
        (["adrift"], "0 parameters that are numbers"),
        (["encircle", "--vary", "rin", "--vary", "push"], "did you mean 'ring'"),
    ],
)
def test_what_cannot_be_done_is_one_sentence_and_leaves_no_file(words, what, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    code, out, err = shoal(capsys, "learn", *words)
    assert (code, out) == (2, "")
    assert what in err
    assert "fix:" in err
    assert list(tmp_path.iterdir()) == []


def test_without_the_library_one_sentence_says_what_to_install(learned, tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "cmaes", None)
    with pytest.raises(MissingExtraError, match=r"pip install '\.\[learn\]'"):
        train(str(learned.file), "oceans2020", tmp_path / "mine.py", terms=QUICK)
