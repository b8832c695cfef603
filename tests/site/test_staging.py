"""The pages that `make docs` builds the site from: what is staged, and where links lead."""

import re
import tomllib
from pathlib import Path, PurePosixPath

import pytest

import shoal
from site_links import place_of, turned
from stage_site import ROOT, as_python_markdown, main

NAV = tomllib.loads((ROOT / "zensical.toml").read_text(encoding="utf-8"))["project"]["nav"]


def pages_of(nav):
    """The pages that the navigation names, in its order."""
    for entry in nav:
        for below in entry.values():
            yield from pages_of(below) if isinstance(below, list) else [below]


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    folder = tmp_path_factory.mktemp("stage")
    main(folder)
    return folder


class TestNavigation:
    """Every page is in it once."""

    def test_names_pages_that_are_staged(self, stage):
        assert [page for page in pages_of(NAV) if not (stage / page).is_file()] == []

    def test_names_every_page_once(self, stage):
        staged = {str(page.relative_to(stage)) for page in stage.rglob("*.md")}
        linked = ("source/", "decisions/")  # from other pages only
        own = {page for page in staged if not page.startswith(linked) and not page.endswith("/index.md")}
        assert sorted(pages_of(NAV)) == sorted({*own, "decisions/index.md"})


class TestLinks:
    """A link leads to the same thing as in the repository."""

    @pytest.mark.parametrize(
        ("file", "folder", "place"),
        [
            ("README.md", False, "overview.md"),
            ("docs/how-to/watch.md", False, "how-to/watch.md"),
            ("docs/tutorials/research-day.ipynb", False, "tutorials/research-day.md"),
            ("docs/images/bay.png", False, "images/bay.png"),
            ("docs/decisions", True, "decisions/index.md"),
            ("src/shoal/reference.py", False, "source/src/shoal/reference.py.md"),
            ("benchmarks/peers", True, "source/benchmarks/peers/index.md"),
        ],
    )
    def test_places(self, file, folder, place):
        assert str(place_of(PurePosixPath(file), folder=folder)) == place

    def test_are_turned_outside_of_code_only(self):
        text = "[a](docs/how-to/watch.md#go-back) `[a](README.md)` [b](https://example.org/README.md)\n"
        shown, found = turned(text, PurePosixPath("README.md"), ROOT)
        assert shown == text.replace("docs/how-to", "how-to")
        assert found == {PurePosixPath("docs/how-to/watch.md")}

    def test_that_lead_nowhere_are_left_for_the_check(self):
        text = "[a](missing.md)"
        assert turned(text, PurePosixPath("README.md"), ROOT) == (text, set())

    def test_of_staged_pages_lead_to_staged_files(self, stage):
        dead = []
        for page in stage.rglob("*.md"):
            prose = re.sub(r"^ *(```|~~~~~~).*?^ *\1|`[^`\n]*`", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
            for link in re.findall(r"""(?:\]\(|src=")([^)\s#"]+)""", prose):
                if not link.startswith("http") and not (page.parent / link).is_file():
                    dead.append((str(page.relative_to(stage)), link))
        assert dead == []


class TestPages:
    """What the site has beside the pages of the repository."""

    def test_the_notebook_with_what_it_drew(self, stage):
        page = (stage / "tutorials/research-day.md").read_text()
        pictures = re.findall(r"!\[.*\]\((.*\.png)\)", page)
        assert len(pictures) >= 3
        assert all((stage / "tutorials" / name).read_bytes().startswith(b"\x89PNG") for name in pictures)
        assert "<style" not in page
        assert "<table" in page

    def test_every_public_name(self, stage):
        named = re.findall(r"^::: shoal\.(\w+)$", (stage / "reference/api.md").read_text(), flags=re.MULTILINE)
        assert sorted(named) == sorted({*dir(shoal)} - {"plot", "__version__"})

    def test_a_source_says_what_the_file_says(self, stage):
        shown = (stage / "source/src/shoal/reference.py.md").read_text()
        assert (ROOT / "src/shoal/reference.py").read_text().strip() in shown

    def test_the_replay_is_embedded(self, stage):
        page = stage / "tutorials/see-a-swarm.md"
        (frame,) = re.findall(r'<iframe src="([^"]+)"', page.read_text())
        assert (page.parent / frame).read_bytes() == Path(ROOT, "docs/replay/oceans2020.html").read_bytes()

    def test_bars_in_code_of_tables_are_not_escaped(self):
        assert as_python_markdown("| `a\\|b` | c\\|d |") == "| `a|b` | c\\|d |\n"
        assert as_python_markdown("`a\\|b`") == "`a\\|b`\n"

    def test_lists_and_tables_stand_apart(self):
        assert as_python_markdown("a:\n- b\nlazy\n- c\n\n|d|") == "a:\n\n- b\nlazy\n- c\n\n|d|\n"
        assert as_python_markdown("<!-- e -->\n|f|\n|g|") == "<!-- e -->\n\n|f|\n|g|\n"
        assert as_python_markdown("```\na\n- b\n```") == "```\na\n- b\n```\n"
