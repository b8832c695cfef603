"""The paper to read is short, stands alone, and says where everything is."""

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import pytest

from shoal import reference


def test_it_is_short():
    assert len(inspect.getsource(reference).splitlines()) < 120


def test_it_imports_nothing_of_ours_and_no_compiler():
    tree = ast.parse(inspect.getsource(reference))
    imported = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    imported |= {name.name for node in ast.walk(tree) if isinstance(node, ast.Import) for name in node.names}
    assert imported == {"dataclasses", "functools", "typing", "numpy"}
    loaded = "import sys, shoal.reference; assert 'numba' not in sys.modules"
    assert subprocess.run([sys.executable, "-c", loaded], check=False).returncode == 0


@pytest.mark.parametrize("what", ["Eq. 1", "Eq. 2", "Eq. 3", "Eq. 4", "Eq. 5", "Eq. 6", "Eq. 7", "Eq. 8"])
def test_every_equation_of_the_paper_is_named_once(what):
    body = inspect.getsource(reference).split('"""', 2)[2]
    assert body.count(what) == 1


def test_both_algorithms_are_methods_of_that_name():
    assert "Algorithm 1, adaptive repulsion" in inspect.getdoc(reference.Paper.algorithm_1)
    assert "Algorithm 2, dynamic k-nearest network PSO with adaptive repulsion" in inspect.getdoc(
        reference.Paper.algorithm_2
    )


ROOT = Path(__file__).resolve().parents[1]
(ROWS,) = re.findall(r"\| paper \| to read.*?\n\n", (ROOT / "README.md").read_text(encoding="utf-8"), flags=re.DOTALL)
PLACES = [
    (label, name, link or "src/shoal/reference.py")
    for label, read, engine in re.findall(r"^\| (\w+\.? \d): [^|]+\| ([^|]+) \| ([^|]+) \|$", ROWS, flags=re.MULTILINE)
    for cell in (read, engine)
    for name, link in re.findall(r"`(\w+)`(?: in \[[^\]]*\]\(([^)]*)\))?", cell)
]


def test_readme_says_where_everything_of_the_paper_is():
    assert {label for label, _, _ in PLACES} == {
        "Algorithm 1",
        "Algorithm 2",
        *(f"Eq. {n}" for n in range(1, 9)),
    }


@pytest.mark.parametrize(("label", "name", "file"), PLACES)
def test_what_readme_names_is_there_and_says_so_itself(label, name, file):
    text = (ROOT / file).read_text(encoding="utf-8")
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef) and node.name == name]
    assert [label in ast.get_source_segment(text, function) for function in functions] == [True]
