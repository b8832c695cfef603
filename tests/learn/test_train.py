"""What is learned is a strategy file that runs everywhere."""

import re

import numpy as np
import pytest

from buoys import differences, tape_of
from commands import shoal
from scenarios import scenario
from shoal.cli.learn import _Progress
from shoal.core.errors import MissingExtraError
from shoal.learn.search import Generation
from shoal.learn.train import Kept, Stopped, Terms, train
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


def stop(*_):
    raise KeyboardInterrupt


def test_an_interrupt_keeps_the_best_and_says_what_it_measured_of_it(learned, tmp_path):
    file = tmp_path / "stopped.py"
    with pytest.raises(Stopped) as stopped:
        train(str(learned.file), "oceans2020", file, terms=QUICK, report=stop)
    best = stopped.value.kept
    kept = scenario("oceans2020", {"strategy": {"file": str(file)}}).strategy
    assert kept.name == "stopped"
    assert list(kept.params.values()) == pytest.approx(list(best.weights), rel=1e-15)
    assert stopped.value.generations == 1
    assert best.is_better == (best.score > best.start)
    assert not best.is_better or list(kept.params.values()) != list(learned.weights.values())
    assert 0.8 < best.start <= best.score <= 1.0
    assert [each.name for each in tmp_path.glob("*.*")] == ["stopped.py"]


def test_another_interrupt_leaves_the_comparison_out(learned, tmp_path, monkeypatch):
    monkeypatch.setattr("shoal.learn.train._best_of", stop)
    with pytest.raises(Stopped) as stopped:
        train(str(learned.file), "oceans2020", tmp_path / "stopped.py", terms=QUICK, report=stop)
    assert stopped.value.kept is None


@pytest.mark.parametrize(
    ("best", "said"),
    [
        (None, r"which was not compared with the start; to judge it: shoal compare \S+stopped.py"),
        (Kept([], 0.931, 0.921, True), r"0.931 of the time on target, 0.921 at the start, in 8 runs .* optimistic; to"),
        (Kept([], 0.921, 0.921, False), r"1 generations found nothing better than the start \(0.921 .* holds"),
    ],
)
def test_the_command_says_before_it_compiles_and_what_it_kept(best, said, learned, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("shoal.cli.learn.tell_of_compiling", lambda chosen: told.append(chosen.strategy.name))
    monkeypatch.setattr("shoal.cli.learn._Progress.__call__", stop)
    monkeypatch.setattr("shoal.learn.train._best_of", (lambda *_: best._replace(weights=weights)) if best else stop)
    told, weights = [], np.array(list(learned.weights.values()))
    code, out, err = shoal(capsys, "learn", learned.file, "--out", tmp_path / "stopped.py", "--jobs", 1, "--steps", 500)
    assert (code, out, told) == (130, "", ["my-policy"])
    assert re.search(said, err)


def test_progress_shows_the_best_so_far(monkeypatch, capsys):
    monkeypatch.setattr("shoal.cli.learn.SECONDS_BETWEEN_LINES", 0.0)
    progress = _Progress()
    for number, best in enumerate((0.953, 0.931), 1):
        progress(Generation(number, 0.6, best, np.zeros(2)), 0.1 * number)
    *_, last = capsys.readouterr().err.splitlines()
    assert last.endswith("20 %: generation 2, its candidates 0.600 on target, the best so far 0.953")


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


def test_the_template_is_no_strategy_and_whoever_runs_it_is_told_what_is(capsys):
    for words in (["run", "oceans2020", "--strategy", "linear"], ["compare", "linear", "knn-pso"]):
        code, _, err = shoal(capsys, *words)
        assert code == 2
        assert "linear is a template: `shoal learn linear` makes learned.py of it" in err
