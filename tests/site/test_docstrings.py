"""Docstrings become Markdown that reads well."""

import sys
from importlib import import_module
from types import SimpleNamespace

import pytest

DOCSTRING = """Run it.

>>> run("a")
>>> run("b")

Parameters
----------
name, other : what to run, and
    what not
runs : how many
More of it.

Raises
------
ScenarioError : it cannot run

The end."""


@pytest.fixture
def shown(monkeypatch):
    """The function, where griffe is or is not: of griffe it needs nothing."""
    monkeypatch.setitem(sys.modules, "griffe", SimpleNamespace(Extension=object, Object=object))
    return import_module("site_docstrings").shown


def test_sections_are_lists_and_examples_are_code(shown):
    assert shown(DOCSTRING).splitlines() == [
        "Run it.",
        "",
        "",
        "```pycon",
        '>>> run("a")',
        '>>> run("b")',
        "```",
        "",
        "**Parameters**",
        "",
        "- `name`, `other`: what to run, and what not",
        "- `runs`: how many",
        "- More of it.",
        "",
        "**Raises**",
        "",
        "- `ScenarioError`: it cannot run",
        "",
        "The end.",
    ]


def test_a_docstring_without_sections_stays_as_it_is(shown):
    assert shown("One line: with a colon.") == "One line: with a colon."
