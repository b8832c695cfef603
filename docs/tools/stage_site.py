"""Stage the pages of the site: python docs/tools/stage_site.py FOLDER. `make docs` builds the site from them."""

import re
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from site_api import api_page
from site_links import place_of, turned
from site_notebook import notebook_page
from site_sources import folder_page, source_page

ROOT = Path(__file__).resolve().parents[2]
ASSETS = ("site.css", "site.js", "iframe-worker.js")  # named in zensical.toml
EMBED = re.compile(r"^<!-- embed (\S+) -->$", re.MULTILINE)  # shown as it is in the site, and nowhere else
BEGINNINGS = ("- ", "|")  # of lists and tables
CELL = re.compile(r"`[^`\n]*`")


def main(folder: Path) -> None:
    """Write all pages and pictures, into a folder that is emptied before."""
    shutil.rmtree(folder, ignore_errors=True)
    waiting = [*pages_of_docs(), PurePosixPath("README.md"), PurePosixPath("CHANGELOG.md")]
    done: set[PurePosixPath] = set()
    while waiting:
        file = waiting.pop()
        if file not in done:
            done.add(file)
            waiting += staged(file, folder)
    write(folder / "reference/api.md", api_page(ROOT).encode())
    for name in ASSETS:
        write(folder / name, (ROOT / "docs/tools" / name).read_bytes())


def pages_of_docs() -> list[PurePosixPath]:
    """Every page of docs/, whether or not another links to it."""
    files = (ROOT / "docs").rglob("*")
    return [PurePosixPath(file.relative_to(ROOT)) for file in files if file.suffix in (".md", ".ipynb")]


def staged(file: PurePosixPath, folder: Path) -> set[PurePosixPath]:
    """Write one file or folder of the repository, and return what its page links to."""
    is_folder = (ROOT / file).is_dir()
    place = folder / place_of(file, folder=is_folder)
    if is_folder:
        text, found = turned(folder_page(file, ROOT), file / "index.md", ROOT)
    elif file.suffix == ".ipynb":
        page, pictures = notebook_page(ROOT / file)
        text, found = turned(page, file, ROOT)
        for name, picture in pictures.items():
            write(place.parent / name, picture)
    elif file.suffix == ".md":
        text, found = turned((ROOT / file).read_text(encoding="utf-8"), file, ROOT)
    elif place.suffix == ".md":
        text, found = source_page(file, ROOT), set()
    else:
        write(place, (ROOT / file).read_bytes())
        return set()
    write(place, as_python_markdown(text).encode())
    return found


def as_python_markdown(text: str) -> str:
    """The same page for Python-Markdown, which shows the backslash of a \\| in code, and embeds what is to be seen."""
    lines = [unescaped(line) if line.startswith("|") else line for line in apart(text.splitlines())]
    return EMBED.sub(r'<iframe src="\1" title="A replay" loading="lazy"></iframe>', "\n".join(lines)) + "\n"


def apart(lines: list[str]) -> Iterator[str]:
    """Lines with an empty one before each list and table, which Python-Markdown needs."""
    first, code = "", False  # the line that the paragraph began with; within a block of code
    for line in lines:
        code ^= line.lstrip().startswith(("```", "~~~"))
        if not code and line.startswith(BEGINNINGS) and first and not first.startswith(BEGINNINGS):
            yield ""
            first = line
        yield line
        first = (first or line) if line else ""


def unescaped(row: str) -> str:
    """A row of a table whose code has no escaped bars: bars in code part no cells."""
    return CELL.sub(lambda code: code.group().replace("\\|", "|"), row)


def write(file: Path, data: bytes) -> None:
    """Write a file, and the folders that it is in."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(data)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
