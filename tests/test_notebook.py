"""The notebook of the docs runs, every cell of it, and what it shows is what this version gives."""

import ast
import json
import linecache
import os
import re
from pathlib import Path

import pytest

from shoal.core.version import RESULTS_VERSION
from shoal.strategies import CATALOGUE

NOTEBOOKS = sorted((Path(__file__).resolve().parents[1] / "docs").rglob("*.ipynb"))
EXTRAS = ("matplotlib", "pandas", "scipy.stats")


def cells_of(notebook, kind="code"):
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == kind]


def run_cell(text, number, scope):
    """Execute a cell and show its last expression, as a notebook does; its text can be looked up."""
    name = f"<cell {number}>"
    linecache.cache[name] = len(text), None, text.splitlines(keepends=True), name
    *body, last = ast.parse(text).body
    shows = isinstance(last, ast.Expr)
    exec(compile(ast.Module(body if shows else [*body, last], []), name, "exec"), scope)
    if shows:
        value = eval(compile(ast.Expression(last.value), name, "eval"), scope)
        looks = [getattr(value, look)() for look in ("_repr_html_", "_repr_png_", "__repr__") if hasattr(value, look)]
        assert any(looks)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda notebook: notebook.stem)
class TestNotebook:
    """Every notebook under docs."""

    def test_every_cell_runs(self, notebook, tmp_path, monkeypatch):
        for extra in EXTRAS:
            pytest.importorskip(extra, reason="the notebook needs pip install '.[plots,sweep]'")
        monkeypatch.chdir(tmp_path)
        before, scope = dict(CATALOGUE), {"__name__": "__main__"}
        try:
            for number, text in enumerate(cells_of(notebook)):
                run_cell(text, number, scope)
        finally:
            CATALOGUE.clear()
            CATALOGUE.update(before)
        assert os.listdir(tmp_path) == []

    def test_its_outputs_are_those_of_this_results_version(self, notebook):
        shown = notebook.read_text(encoding="utf-8")
        assert re.findall(r"results version (\d+)", shown) == [str(RESULTS_VERSION)], "run `make notebook`"

    def test_it_was_run_from_top_to_bottom_without_an_error(self, notebook):
        cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
        code = [cell for cell in cells if cell["cell_type"] == "code"]
        assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
        assert [each for cell in code for each in cell["outputs"] if each["output_type"] == "error"] == []
        assert sum("image/png" in each.get("data", {}) for cell in code for each in cell["outputs"]) >= 3

    def test_it_is_small(self, notebook):
        assert notebook.stat().st_size < 300_000

    def test_it_links_to_what_is_there(self, notebook):
        for text in cells_of(notebook, "markdown"):
            for link in re.findall(r"\]\(([^)#]+)", text):
                assert (notebook.parent / link).exists(), link
