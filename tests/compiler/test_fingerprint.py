"""What a user's functions are made of has one hash: whatever may change their machine code changes it."""

import importlib
import sys

import pytest

from shoal.compiler.fingerprint import fingerprint

MINE = """
import math
import helper
from helper import GAIN, weighed
from shoal.strategies.parts import inverse_power

TABLE = helper.read()

def mine(x):
    total = 0.0
    for each in TABLE:
        total += weighed(each) * GAIN + helper.inner.shifted(x)
    return math.sqrt(total) + inverse_power(x, 1.0, 2.0)
"""
HELPER = """
import numpy as np
import inner
from shoal.compiler.kernel import kernel
GAIN = 2.0

def read():
    return np.loadtxt("table.txt")

@kernel
def weighed(x):
    return x + 1
"""
INNER = """
def shifted(x):
    return x + 3
"""
FILES = {"mine.py": MINE, "helper.py": HELPER, "inner.py": INNER, "table.txt": "1 2 3"}


@pytest.fixture
def hashed(tmp_path, monkeypatch):
    """The hash of `mine` of files with these changes, in a folder that is like new."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)

    def hash_of(changes=None, facts=()):
        for name, text in {**FILES, **(changes or {})}.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        for name in ("helper", "inner", "mine"):
            sys.modules.pop(name, None)
        importlib.invalidate_caches()
        module = importlib.import_module("mine")
        return fingerprint([module.mine], *facts)

    yield hash_of
    for name in ("helper", "inner", "mine"):
        sys.modules.pop(name, None)


def test_the_same_files_have_the_same(hashed):
    assert hashed() == hashed() is not None


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("mine.py", "total = 0.0", "total = 1.0"),
        ("helper.py", "GAIN = 2.0", "GAIN = 3.0"),
        ("helper.py", "x + 1", "x - 1"),
        ("inner.py", "x + 3", "x + 4"),
        ("table.txt", "1 2 3", "1 2 4"),
        ("table.txt", "1 2 3", "1 2"),
    ],
)
def test_a_change_of_whatever_is_compiled_is_another(hashed, name, old, new):
    assert old in FILES[name]
    assert hashed() != hashed({name: FILES[name].replace(old, new)})


def test_so_is_what_the_environment_says(hashed, monkeypatch):
    files = {"helper.py": HELPER.replace("GAIN = 2.0", "import os\nGAIN = float(os.environ['GAIN'])")}
    found = []
    for gain in ("1.0", "2.0"):
        monkeypatch.setenv("GAIN", gain)
        found.append(hashed(files))
    assert None not in found
    assert found[0] != found[1]


def test_and_what_else_is_compiled_in(hashed):
    assert hashed(facts=("a",)) != hashed(facts=("b",))


@pytest.mark.parametrize(
    "text",
    [
        "GAIN = object()",
        "GAIN = [1.0]",
        "class Gain: value = 1.0\nGAIN = Gain()",
        "from functools import lru_cache\nGAIN = lru_cache(print)",
        "from numba.extending import overload\nGAIN = 2.0",
    ],
)
def test_where_something_cannot_be_told_there_is_none(hashed, text):
    assert hashed({"helper.py": HELPER.replace("GAIN = 2.0", text)}) is None


def test_a_text_that_is_executed_has_none():
    """Its functions are of no module, under whose name another process could look up what they need."""
    scope = {"__name__": "nowhere"}
    exec("def half(x):\n    return x / 2", scope)
    assert fingerprint([scope["half"]]) is None
