"""Find dead links of a site: python docs/tools/dead_links.py FOLDER. Exit code 1 and a line each if there are any."""

import sys
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class Page(HTMLParser):
    """What a page names: `ids` to be linked to, `links` to others, `loads` what a browser fetches for it."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: set[str] = set()
        self.loads: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Keep the names and addresses of a tag."""
        given = {name: value for name, value in attrs if value}
        self.ids |= {given[name] for name in ("id", "name") if name in given}
        if "href" in given:
            (self.links if tag == "a" else self.loads).add(given["href"])
        if "src" in given:
            self.loads.add(given["src"])


def main(folder: Path) -> int:
    """Print each dead link, and each file that would be fetched from elsewhere; return the exit code."""
    found = sorted(faults(folder))
    for fault in found:
        print(fault)
    print(f"{len(list(folder.rglob('*.html')))} pages, {len(found)} dead links or outside loads")
    return int(bool(found))


def faults(folder: Path) -> Iterator[str]:
    """One line for each link that leads nowhere, and for each load from another host."""
    pages = {file: Page(file.read_text(encoding="utf-8")) for file in folder.resolve().rglob("*.html")}
    for file, page in pages.items():
        if file.name == "404.html":  # is served at any address: its links start at the root
            continue
        where = file.relative_to(folder.resolve())
        for link in page.links | page.loads:
            parts = urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loads and parts.scheme != "data":
                    yield f"{where}: loads {link}"
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            target = target / "index.html" if target.is_dir() else target
            if not target.exists():
                yield f"{where}: {link}: no such file"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].ids:
                yield f"{where}: {link}: no such heading"


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
