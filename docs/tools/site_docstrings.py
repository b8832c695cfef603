"""Docstrings as the site shows them: sections become lists, examples become code. An extension of griffe."""

import re
from typing import Any

import griffe

SECTION = re.compile(r"^(\w[\w ]*)\n-{3,}\n", re.MULTILINE)
EXAMPLE = re.compile(r"(?:^(?:>>>|\.\.\.).*\n?)+", re.MULTILINE)


class Plain(griffe.Extension):
    """Rewrites every docstring before it is shown."""

    def on_instance(self, *, obj: griffe.Object, **_: Any) -> None:
        """Griffe calls this for each module, class, function and attribute that it read."""
        if obj.docstring:
            obj.docstring.value = shown(obj.docstring.value)


def shown(docstring: str) -> str:
    """Markdown of a docstring in the style of numpy, whose entries read `name : what it is`."""
    head, *sections = SECTION.split(docstring)
    parts = [head.rstrip()]
    for title, body in zip(sections[::2], sections[1::2], strict=True):
        parts.append(f"**{title}**\n\n{listed(body)}")
    text = "\n\n".join(parts)
    return EXAMPLE.sub(lambda match: f"\n```pycon\n{match.group().rstrip()}\n```\n", text)


def listed(body: str) -> str:
    """Entries of a section as a list, and what follows an empty line as it stands."""
    entries, _, rest = body.partition("\n\n")
    entries = re.sub(r"\n +", " ", entries.strip())
    lines = [entry_of(line) for line in entries.splitlines()]
    return "\n".join(lines) + (f"\n\n{rest.strip()}" if rest.strip() else "")


def entry_of(line: str) -> str:
    """`name, other : words` with its names as code; a line without names as it stands."""
    names, colon, words = line.partition(" : ")
    if not colon or not re.fullmatch(r"[\w*]+(, [\w*]+)*", names):
        return f"- {line}"
    return f"- {', '.join(f'`{name}`' for name in names.split(', '))}: {words}"
