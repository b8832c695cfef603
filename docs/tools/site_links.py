"""Where each file of the repository is in the site, and the links of a page turned to match."""

import os
import re
from pathlib import Path, PurePosixPath

CODE = re.compile(r"(^ *```.*?^ *``` *$|`[^`\n]+`)", re.MULTILINE | re.DOTALL)  # in which brackets are no links
LINK = re.compile(r"""(\]\(\s*<?|(?:src|href)=")([^)\s>"]+)""")
ELSEWHERE = ("http://", "https://", "mailto:", "data:", "#")
SHOWN = (".md", ".html", ".png", ".gif")  # files of docs/ that the site has as they are
PLACES = {"README.md": "overview.md", "CHANGELOG.md": "changelog.md", "THIRD_PARTY.md": "third-party.md"}


def place_of(file: PurePosixPath, *, folder: bool) -> PurePosixPath:
    """Where a file or folder of the repository is in the site: pages of docs/ at its root, sources under source/."""
    if str(file) in PLACES:
        return PurePosixPath(PLACES[str(file)])
    inside = file.relative_to("docs") if file.is_relative_to("docs") else None
    if folder:
        return (inside or "source" / file) / "index.md"
    if inside and file.suffix == ".ipynb":
        return inside.with_suffix(".md")
    if inside and file.suffix in SHOWN:
        return inside
    return PurePosixPath("source", f"{file}.md")


def turned(text: str, page: PurePosixPath, root: Path) -> tuple[str, set[PurePosixPath]]:
    """The text of a page with its links as the site needs them, and the files and folders that they lead to.

    Parameters
    ----------
    text : Markdown
    page : where it is in the repository
    root : of the repository; a link to what is not there stays as it is, for the site's own check to find
    """
    found: set[PurePosixPath] = set()
    here = place_of(page, folder=False).parent

    def turn(match: re.Match[str]) -> str:
        opening, link = match.groups()
        name, sharp, heading = link.partition("#")
        if link.startswith(ELSEWHERE):
            return match.group()
        target = PurePosixPath(os.path.normpath(page.parent / name))
        if not (root / target).exists():
            return match.group()
        found.add(target)
        place = place_of(target, folder=(root / target).is_dir())
        return f"{opening}{os.path.relpath(place, here)}{sharp}{heading}"

    parts = CODE.split(text)
    return "".join(part if number % 2 else LINK.sub(turn, part) for number, part in enumerate(parts)), found
