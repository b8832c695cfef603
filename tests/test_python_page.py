"""The page of the Python door lists every public name, and its first example runs; the package can be cited."""

import inspect
import re
import tomllib
from pathlib import Path

import shoal
from shoal.record.dataframe import TABLES

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs/reference/python.md").read_text(encoding="utf-8")
(NAMES,) = re.findall(r"\| name \|.*?\n\n", PAGE, flags=re.DOTALL)
CITATION = (ROOT / "CITATION.cff").read_text(encoding="utf-8")


def test_the_page_lists_the_public_names_and_no_others():
    assert sorted(re.findall(r"^\| `(\w+)", NAMES, flags=re.MULTILINE)) == sorted(dir(shoal))


def test_keywords_on_the_page_are_those_of_the_functions():
    for name, keywords in re.findall(r"^\| `(\w+)\(([^)]*)\)", NAMES, flags=re.MULTILINE):
        for keyword in re.findall(r"(\w+)=", keywords):
            assert keyword in inspect.signature(getattr(shoal, name)).parameters, (name, keyword)


def test_the_page_lists_every_table_of_a_record():
    told = {*re.findall(r'`to_pandas\("(\w+)"\)`', PAGE), "metrics"}  # the first is the default
    assert set(TABLES) <= told


def test_the_example_runs():
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)
    scope = {}
    exec(code.replace("20_000", "20"), scope)
    assert scope["record"].scenario.network.loss == 0.1


def test_the_version_is_one():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert re.search(r"^version: (\S+)$", CITATION, flags=re.MULTILINE).group(1) == shoal.__version__
    assert project["version"] == shoal.__version__


def test_the_citation_names_the_papers_authors_in_order():
    assert re.findall(r"family-names: (\S+)", CITATION) == ["Kwa", "Tokić", "Yue", "Bouffanais"]


def test_readme_and_citation_name_the_same_paper():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    title = re.search(r"  title: (.*Swarms.*)", CITATION).group(1)
    assert title in readme
    assert "2008.00696" in CITATION
    assert "2008.00696" in readme
    assert f"version   = {{{shoal.__version__}}}" in readme
