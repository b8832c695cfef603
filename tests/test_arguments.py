"""No function takes more than eight arguments, but for the commands, whose options are the user's."""

import ast
import inspect
from pathlib import Path

import pytest

import shoal
from shoal.core.errors import StrategyError

ROOT = Path(shoal.__file__).parent
MOST = 8


def counted(arguments):
    plain = [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
    return len(plain) + sum(each is not None for each in (arguments.vararg, arguments.kwarg))


def functions(text):
    """Name and number of arguments of every function, method and lambda, nested ones too."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
            yield getattr(node, "name", "lambda"), counted(node.args)


def test_the_count_sees_every_kind_of_argument_and_function():
    text = (
        "class A:\n    def f(self, a, /, b, *c, d=1, **e):\n        async def g(x): pass\n        return lambda y: y\n"
    )
    assert sorted(functions(text)) == [("f", 6), ("g", 1), ("lambda", 1)]


def test_no_function_outside_the_command_line_takes_more_than_eight():
    files = [file for file in sorted(ROOT.rglob("*.py")) if file.relative_to(ROOT).parts[0] != "cli"]
    long = {
        f"{file.relative_to(ROOT)}: {name}": count
        for file in files
        for name, count in functions(file.read_text(encoding="utf-8"))
        if count > MOST
    }
    assert long == {}


class TestKeywordsDeclaredOnce:
    """Those that a class declares are listed by help() and taken as before."""

    def test_of_a_sweep_stand_in_its_signature_with_their_defaults(self):
        known = inspect.signature(shoal.sweep).parameters
        assert list(known)[:4] == ["scenario", "vary", "runs", "mode"]
        assert known["max_runs"].default == 50
        assert known["changes"].kind is inspect.Parameter.VAR_KEYWORD

    def test_of_a_strategy_stand_there_and_no_others(self):
        known = inspect.signature(shoal.strategy).parameters
        assert known["params"].default is inspect.Parameter.empty
        assert {"memory", "tells", "sums", "influence"} < set(known)
        assert all(each.kind is not inspect.Parameter.VAR_KEYWORD for each in known.values())

    @pytest.mark.parametrize("function", [shoal.compare, shoal.sweep, shoal.tune, shoal.design, shoal.strategy])
    def test_each_is_explained_in_the_docstring(self, function):
        for name in inspect.signature(function).parameters:
            assert name in function.__doc__

    def test_a_misspelt_word_of_a_strategy_is_answered_with_the_one_meant(self):
        with pytest.raises(StrategyError, match=r"has no 'memmory'\n  fix: did you mean 'memory'\?"):
            shoal.strategy("mine", params=tuple, memmory={})

    def test_a_strategy_without_params_is_told_what_to_write(self):
        with pytest.raises(StrategyError, match=r"class Params\(NamedTuple\)"):
            shoal.strategy("mine")(lambda me, heard, memory, params, draw: (0.0, 0.0))
