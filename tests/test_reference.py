"""The paper to read is short, stands alone, and says where everything is."""

import ast
import inspect
import subprocess
import sys

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
    assert "Adaptive repulsion" in inspect.getdoc(reference.Paper.algorithm_1)
    assert "k-nearest network PSO with adaptive repulsion" in inspect.getdoc(reference.Paper.algorithm_2)
