"""Runs on a graphics card, which numba simulates: the same bits as on the processor, and what is refused."""

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import shoal
from shoal.core.errors import DeviceError, MissingExtraError, UnknownNameError
from shoal.run.on_card import check_device, why_not
from shoal.scenario.load import load
from shoal.strategies import CATALOGUE

TESTS = Path(__file__).resolve().parents[1]
CASES = [
    {"neighbors": 6},  # everybody
    {"network.range": 6.0, "network.loss": 0.2, "network.delay": 2},
    {"network.interval": 0.3, "network.delay": 1},
    {"network.adaptive": {"fewest": 2, "most": 5}},
    {"fleets.BoB-1.detection_probability": 0.6, "fleets.BoB-0.false_alarm_probability": 0.1},
    {"losses": [{"step": 4, "count": 3}]},
    {"fleets.BoB-0.max_acceleration": 0.5, "fleets.BoB-0.position_error": 0.2},
    {
        "targets": [
            {"kind": "line", "speed": 3.0, "radius": 0.5, "margin": 0.5},
            {"kind": "still", "radius": 0.5, "x": 1.0, "y": 2.0},
        ]
    },
    {"fleets.BoB-0.strategy": {"name": "encircle"}, "fleets.BoB-1.strategy": {"name": "knn-pso"}},
    {"motion.speed_rule": "divide"},
]


def simulated(task, *arguments, compiling=False):
    """What a task of tests/cards.py says, in a process with a simulated card."""
    pytest.importorskip("numba.cuda.simulator", reason="this numba has no simulator of cards")
    paths = [str(Path(shoal.__file__).parents[1]), str(TESTS)]
    flags = {"NUMBA_ENABLE_CUDASIM": "1", "PYTHONPATH": os.pathsep.join(paths)}
    flags |= {} if compiling else {"NUMBA_DISABLE_JIT": "1"}
    code = [sys.executable, "-m", "cards", task, *map(json.dumps, arguments)]
    done = subprocess.run(code, env={**os.environ, **flags}, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_every_strategy_ends_with_the_same_bits():
    found = simulated("strategies", sorted(CATALOGUE))
    assert found == {name: [] for name in CATALOGUE}


def test_radios_sensors_targets_and_teams_do_too():
    assert simulated("cases", CASES) == [[] for _ in CASES]


def test_records_and_sweeps_are_the_same_but_for_the_device():
    cpu, cuda = simulated("records")
    assert (cpu.pop("device"), cuda.pop("device")) == (None, "cuda: a simulated card")
    assert cpu == cuda


def test_so_are_those_of_many_agents():
    listed, cpu, cuda = simulated("many")
    assert listed == 3
    assert cpu.pop("device") != cuda.pop("device")
    assert cpu == cuda


def test_compiled_code_finds_its_arrays_in_an_arena():
    found = simulated("memory", compiling=True)
    assert found["read"] == [[0.0, 1.0, 0.0], [0.5, 1.0, 0.25], [1.0, 1.0, 0.5]]
    assert found["written"] == [[2.0, 101.0], [4.0, 102.0], [6.0, 103.0]]


def test_no_barrier_is_written_twice():
    """Python may copy the end of a function for each outcome of a condition: two barriers, none of which opens."""
    for file in sorted(Path(shoal.__file__).parent.glob("engine/gpu/*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            barriers = [each for each in ast.walk(node) if "syncthreads" in getattr(each, "attr", "")]
            if isinstance(node, ast.Return | ast.IfExp | ast.BoolOp):
                assert not barriers, f"{file.name}:{node.lineno}"
            if isinstance(node, ast.Call) and "syncthreads" in getattr(node.func, "attr", ""):
                conditions = [each for each in ast.walk(node) if isinstance(each, ast.IfExp | ast.BoolOp)]
                assert not conditions, f"{file.name}:{node.lineno}"


@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"motion.update_order": "sequential"}, "sequential"),
        ({"agents": 256, "neighbors": 5}, "255 agents"),
        ({"disturbances": [{"kind": "blackout", "since": 1.0, "until": 2.0}]}, "disturbances"),
        ({"commands": [{"step": 10, "order": "hold"}]}, "commands"),
        ({"network.hops": 2}, "network.hops"),
        ({"network.max_age": 2}, "network.max_age"),
    ],
)
def test_what_a_card_cannot_do_is_named(changes, word):
    assert word in why_not(load("oceans2020", **changes))


def test_what_it_can_is_not():
    assert why_not(load("oceans2020", agents=255)) is None


def test_land_is_refused():
    assert "land" in why_not(load("bay"))


def test_without_numba_cuda_one_sentence_says_what_to_install(monkeypatch):
    monkeypatch.delenv("NUMBA_ENABLE_CUDASIM", raising=False)
    monkeypatch.setitem(sys.modules, "numba_cuda", None)
    with pytest.raises(MissingExtraError, match="gpu"):
        check_device("cuda", ())


def test_without_a_card_one_sentence_says_so(monkeypatch):
    monkeypatch.delenv("NUMBA_ENABLE_CUDASIM", raising=False)
    monkeypatch.setitem(sys.modules, "numba_cuda", sys)
    if __import__("numba.cuda").cuda.is_available():
        pytest.skip("there is a card here")
    with pytest.raises(DeviceError, match="nvidia-smi"):
        check_device("cuda", ())


def test_another_device_is_refused():
    with pytest.raises(UnknownNameError, match="cuda"):
        check_device("tpu", ())
