"""Write the table of THIRD_PARTY.md anew: what pip installs beside Shoal, and its licenses. Run by `make licenses`.

It is read from the metadata of what is installed beside this Python, which must hold every extra (`make licenses` takes
the developers' environment); what metadata do not say, or not clearly, is in `READ`.
"""

import re
import sys
import tomllib
from collections.abc import Iterable
from importlib.metadata import Distribution, distribution
from pathlib import Path
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "THIRD_PARTY.md"
START, END = "<!-- written by `make licenses` -->\n", "<!-- end -->\n"
LEFT_OUT = ("all", "dev")  # extras of extras; what only developers need
READ = {  # in the license files of these packages
    "eclipse-zenoh": "EPL-2.0 OR Apache-2.0",
    "numba": "BSD-2-Clause",
    "numba-cuda": "BSD-2-Clause",
}
_COPYLEFT = re.compile(r"\b(?:A|L)?GPL|\bMPL|\bEPL|\bCDDL|\bEUPL|\bCECILL|\bCC-BY-SA|General Public|Mozilla", re.I)
_SHORT = (  # words of older metadata, and the identifiers of SPDX; the first that fits
    (r"GNU Lesser General Public License v3.*|LGPLv3.*", "LGPL-3.0"),
    (r"Mozilla Public License 2\.0.*", "MPL-2.0"),
    (r"Eclipse Public License 2\.0.*", "EPL-2.0"),
    (r"Apache( Software License|[ -]2\.0|$).*", "Apache-2.0"),
    (r"(The )?MIT( License)?", "MIT"),
    (r"(3-Clause BSD|BSD 3-Clause).*", "BSD-3-Clause"),
    (r"(2-Clause BSD|BSD 2-Clause).*", "BSD-2-Clause"),
    (r"BSD( License)?", "BSD"),
    (r"Python Software Foundation License", "PSF-2.0"),
)


class Package(NamedTuple):
    """A package that comes with Shoal.

    Attributes
    ----------
    name : on the package index
    license : an identifier of SPDX where there is one
    by : extras that bring it, "core" for all
    named : whether Shoal itself asks for it
    """

    name: str
    license: str
    by: tuple[str, ...]
    named: bool


def main() -> int:
    """Write the table; 0, or 2 if the page has no place for it or a package is not installed."""
    before, start, rest = PAGE.read_text(encoding="utf-8").partition(START)
    _, end, after = rest.partition(END)
    try:
        if not end:
            raise LookupError(f"{PAGE.name}: has no place for the table\n  fix: put {START.strip()} and {END.strip()}")
        made = table(packages(asked_for(ROOT / "pyproject.toml")))
    except LookupError as error:
        print(error, file=sys.stderr)
        return 2
    PAGE.write_text(before + start + made + end + after, encoding="utf-8")
    return 0


def asked_for(project: Path) -> dict[str, list[Requirement]]:
    """Return what a pyproject.toml asks for, by extra, "core" first; an extra that holds another has what that has.

    Extras that only hold others, and what is for developers, are left out.
    """
    told = tomllib.loads(project.read_text(encoding="utf-8"))["project"]
    extras: dict[str, list[str]] = told["optional-dependencies"]

    def spelled_out(texts: Iterable[str]) -> list[Requirement]:
        each = [Requirement(text) for text in texts]
        held = [extras[extra] for one in each if one.name == told["name"] for extra in sorted(one.extras)]
        return [one for one in each if one.name != told["name"]] + [one for texts in held for one in spelled_out(texts)]

    own = {name: texts for name, texts in extras.items() if name not in LEFT_OUT}
    return {name: spelled_out(texts) for name, texts in {"core": told["dependencies"], **own}.items()}


def packages(asked: dict[str, list[Requirement]]) -> list[Package]:
    """Return every package that is brought, directly or by another, in the order of their names.

    Raises
    ------
    LookupError : one is not installed, and `READ` does not know it
    """
    brought = {extra: closure(needed) for extra, needed in asked.items()}
    named = {canonicalize_name(each.name) for needed in asked.values() for each in needed}
    found = []
    for name in sorted({name for names in brought.values() for name in names}):
        by = tuple(extra for extra, names in brought.items() if name in names)
        found.append(Package(name, license_of(name), ("core",) if "core" in by else by, name in named))
    return found


def closure(needed: Iterable[Requirement]) -> set[str]:
    """Return the names of these packages and of all that they need here; of one that is absent its own name only."""
    found: set[str] = set()
    waiting = [(canonicalize_name(each.name), frozenset(each.extras)) for each in needed]
    seen = set(waiting)
    while waiting:
        name, extras = waiting.pop()
        found.add(name)
        for text in (installed(name).requires or ()) if installed(name) else ():
            each = Requirement(text)
            asked = (canonicalize_name(each.name), frozenset(each.extras))
            wanted = not each.marker or any(each.marker.evaluate({"extra": extra}) for extra in ("", *extras))
            if wanted and asked not in seen:
                seen.add(asked)
                waiting.append(asked)
    return found


def installed(name: str) -> Distribution | None:
    """Return the metadata of a package, None if it is not installed."""
    try:
        return distribution(name)
    except ImportError:
        return None


def license_of(name: str) -> str:
    """Return the license that a package states.

    Raises
    ------
    LookupError : it is not installed, or states none, and `READ` does not know it
    """
    if name in READ:
        return READ[name]
    found = installed(name)
    if not found:
        raise LookupError(f"{name}: is not installed\n  fix: pip install '.[dev]', or read its license into READ")
    told = found.metadata
    if expression := told.get("License-Expression"):
        return expression
    word = told.get("License") or ""
    if re.fullmatch(r"[^\n=]{1,30}", word):  # not the whole text of one
        return short(word)
    classifiers = [each.split(" :: ") for each in told.get_all("Classifier") or ()]
    words = [each[-1] for each in classifiers if each[0] == "License" and each[-1] != "DFSG approved"]
    if not words:
        raise LookupError(f"{name}: states no license\n  fix: read it, into READ")
    return " and ".join(sorted({short(each) for each in words}))


def short(words: str) -> str:
    """Return the identifier that SPDX has for what older metadata say, or these words."""
    return next((name for pattern, name in _SHORT if re.fullmatch(pattern, words.strip())), words.strip())


def is_copyleft(words: str) -> bool:
    """Whether a license asks something of whoever passes changes or a whole on; not if another may be chosen."""
    return all(_COPYLEFT.search(each) for each in words.split(" OR "))


def table(found: Iterable[Package]) -> str:
    """Return the page's part: the copyleft packages in a line, then a row for each package."""
    found = list(found)
    copyleft = [f"{each.name} ({each.license}; {', '.join(each.by)})" for each in found if is_copyleft(each.license)]
    names = [f"**{each.name}**" if each.named else each.name for each in found]
    rows = [f"| {name} | {each.license} | {', '.join(each.by)} |" for name, each in zip(names, found, strict=True)]
    head = ["| package | license | comes with |", "| --- | --- | --- |"]
    return "\n".join([f"Copyleft: {', '.join(copyleft) or 'none'}.", "", *head, *rows, ""])


if __name__ == "__main__":
    sys.exit(main())
