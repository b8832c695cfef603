"""Links of a page, absolute: judged by a Markdown parser that knows nothing of how they were found."""

from pathlib import Path

import pytest
from absolute_links import absolute, base_address
from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parents[2]
BASE = "https://example.org/shoal/blob/main"


def targets(text):
    """Where the links and pictures of a page lead."""
    waiting, found = MarkdownIt().parse(text), []
    while waiting:
        token = waiting.pop()
        waiting += token.children or []
        found += [token.attrs[name] for name in ("href", "src") if name in token.attrs]
    return found


def seen(text):
    """The words and the code that a reader sees."""
    inside = (each for token in MarkdownIt().parse(text) for each in token.children or [token])
    return [each.content for each in inside if each.type in ("text", "code_inline", "fence")]


@pytest.fixture
def made(tmp_path):
    """A function: the text of a page made absolute, in a repository with a page, a picture and a folder."""
    (tmp_path / "docs").mkdir()
    for name in ("docs/a.md", "docs/a.png"):
        (tmp_path / name).write_text("")

    def made(text, base=BASE):
        (tmp_path / "README.md").write_text(text)
        return absolute(tmp_path / "README.md", base, tmp_path)

    return made


class TestReadme:
    def test_every_link_is_absolute_and_leads_to_a_file(self):
        before = targets((ROOT / "README.md").read_text(encoding="utf-8"))
        after = targets(absolute(ROOT / "README.md", BASE, ROOT))
        assert len(after) == len(before) > 50
        for old, new in zip(before, after, strict=True):
            if "://" not in old:
                path, mark, heading = old.partition("#")
                path = path or "README.md"
                view = "raw" if path.endswith((".png", ".gif")) else "tree" if (ROOT / path).is_dir() else "blob"
                old = f"https://example.org/shoal/{view}/main/{path}{mark}{heading}"
            assert new == old

    def test_what_is_no_link_stays_as_it_is(self):
        page = ROOT / "README.md"
        words = [seen(text) for text in (page.read_text(encoding="utf-8"), absolute(page, BASE, ROOT))]
        assert len(words[0]) > 100
        assert words[0] == words[1]


@pytest.mark.parametrize(
    ("link", "address"),
    [
        ("[a](docs/a.md#part)", f"[a]({BASE}/docs/a.md#part)"),
        ("![a](docs/a.png)", "![a](https://example.org/shoal/raw/main/docs/a.png)"),
        ("[![a](docs/a.png)](docs)",
         "[![a](https://example.org/shoal/raw/main/docs/a.png)](https://example.org/shoal/tree/main/docs)"),
        ("[`a`](docs/a.md)", f"[`a`]({BASE}/docs/a.md)"),
        ("[a][b]\n\n[b]: docs/a.md", f"[a][b]\n\n[b]: {BASE}/docs/a.md"),
        ('<img src="docs/a.png">', '<img src="https://example.org/shoal/raw/main/docs/a.png">'),
        ("[here](#part)", f"[here]({BASE}/README.md#part)"),
        ("[a](https://example.com/docs/a.md)", "[a](https://example.com/docs/a.md)"),
        ("`[a](docs/a.md)`", "`[a](docs/a.md)`"),
        ("```\n[a](lost.md)\n```", "```\n[a](lost.md)\n```"),
    ],
)  # fmt: skip
def test_a_link(made, link, address):
    assert made(link) == address


@pytest.mark.parametrize(
    ("base", "picture"),
    [
        ("https://example.org/shoal/src/branch/main", "https://example.org/shoal/raw/branch/main/docs/a.png"),
        ("https://example.org/files", "https://example.org/files/docs/a.png"),
    ],
)
def test_pictures_are_raw_where_the_host_has_such_an_address(made, base, picture):
    assert made("![a](docs/a.png)", base) == f"![a]({picture})"


@pytest.mark.parametrize("link", ["[a](lost.md)", "[a](../outside.md)"])
def test_a_link_that_leads_out_of_the_repository_is_refused(made, tmp_path, link):
    (tmp_path.parent / "outside.md").write_text("")
    with pytest.raises(ValueError, match=r"README.md: links lead nowhere: .*\.md\n  fix: "):
        made(link)


class TestBaseAddress:
    def test_slashes_at_its_end_do_not_count(self):
        assert base_address(f"{BASE}//") == BASE

    @pytest.mark.parametrize("text", ["main", "ftp://a.org/x", "https://", f"{BASE}?a=1", f"{BASE}#a", f"{BASE})"])
    def test_what_is_no_address_of_files_is_refused(self, text):
        with pytest.raises(ValueError, match=r"^BASE: .*\n  fix: give one such as https://"):
            base_address(text)
