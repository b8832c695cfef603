"""The relative links of a page made absolute, to be read where its repository is not, as on a package index.

One base address serves all: that of the repository's files, such as https://example.org/shoal/blob/main. Hosts show a
file at /blob/ (or /src/) as a page around it; a picture is its bytes, at /raw/, and a folder is at /tree/. Where an
address has no such part, everything is right below it.
"""

import re
from pathlib import Path, PurePosixPath
from urllib.parse import urlsplit

_CODE = re.compile(r"^```.*?^```[^\n]*$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
_TARGET = re.compile(r"""(?<=\]\()\s*<?([^)\s>]+)|(?:src|href)="([^"]+)"|^\[[^\]]+\]:\s*<?([^\s>]+)""", re.MULTILINE)
_ELSEWHERE = re.compile(r"[a-zA-Z][a-zA-Z0-9+.-]*:|//")
_PICTURES = (".png", ".gif", ".svg", ".jpg", ".jpeg", ".webp", ".mp4")


def base_address(text: str) -> str:
    """Return a base address without the slashes at its end.

    Raises
    ------
    ValueError : it is no http or https address of a folder
    """
    parts = urlsplit(text)
    plain = not re.search(r"[\s<>\"'()]", text)
    if parts.scheme not in ("http", "https") or not parts.hostname or parts.query or parts.fragment or not plain:
        raise ValueError(
            f"BASE: {text!r} is no address of a repository's files\n"
            "  fix: give one such as https://example.org/shoal/blob/main"
        )
    return text.rstrip("/")


def absolute(page: Path, base: str, root: Path) -> str:
    """Return the text of a page with its relative links made absolute; links inside code stay as they are.

    Parameters
    ----------
    page : a Markdown file in the repository
    base : what `base_address` returns
    root : the folder of the repository

    Raises
    ------
    ValueError : links lead to no file of the repository
    """
    text = page.read_text(encoding="utf-8")
    lost: list[str] = []

    def replaced(match: re.Match[str]) -> str:
        (target,) = (each for each in match.groups() if each)
        if _ELSEWHERE.match(target):
            return match[0]
        path, mark, heading = target.partition("#")
        file = (page.parent / path).resolve() if path else page.resolve()
        if not file.exists() or not file.is_relative_to(root.resolve()):
            lost.append(target)
            return match[0]
        address = f"{_base_of(file, base)}/{PurePosixPath(file.relative_to(root.resolve()))}"
        return match[0].replace(target, address + mark + heading)

    pieces, start = [], 0
    for code in _CODE.finditer(text):
        pieces += [_TARGET.sub(replaced, text[start : code.start()]), code[0]]
        start = code.end()
    pieces.append(_TARGET.sub(replaced, text[start:]))
    if lost:
        raise ValueError(f"{page.name}: links lead nowhere: {', '.join(lost)}\n  fix: name files of the repository")
    return "".join(pieces)


def _base_of(file: Path, base: str) -> str:
    """The base address for this kind of file."""
    if file.suffix.lower() in _PICTURES:
        view = "/blob/" if "/blob/" in base else "/src/"
        return base.replace(view, "/raw/", 1)
    return base.replace("/blob/", "/tree/", 1) if file.is_dir() else base
