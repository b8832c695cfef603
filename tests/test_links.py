"""Every page of the documentation leads where it says: its relative links name files and headings that exist."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "THIRD_PARTY.md", *sorted((ROOT / "docs").rglob("*.md"))]
LINK = re.compile(r"""\]\(\s*<?([^)\s>]+)>?[^)]*\)|(?:src|href)="([^"]+)\"""")
ELSEWHERE = ("http://", "https://", "mailto:")


def prose(page):
    """A page without its code, where brackets are not links."""
    fenced = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    return re.sub(r"`[^`\n]*`", "", fenced)


def anchors(page):
    """What GitHub calls the headings of a page."""
    headings = re.findall(r"^#+ +(.+?) *$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(page):
    """Every link of a page that stays in the repository."""
    found = (markdown or html for markdown, html in LINK.findall(prose(page)))
    return [link for link in found if not link.startswith(ELSEWHERE)]


class TestLinks:
    @pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
    def test_lead_to_files_and_headings_that_exist(self, page):
        broken = []
        for link in links(page):
            name, _, heading = link.partition("#")
            target = page.parent / name if name else page
            if not target.exists() or (heading and target.suffix == ".md" and heading not in anchors(target)):
                broken.append(link)
        assert not broken

    def test_are_found(self):
        assert len(links(ROOT / "docs/reference/cli.md")) > 5  # those of README may be absolute: `make dist`
