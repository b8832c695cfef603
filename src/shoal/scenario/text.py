"""The text of a scenario with other values: its comments, its order and all that is not changed stay."""

import re
import tomllib
from collections.abc import Mapping
from typing import Any

import tomli_w

from shoal.core.errors import ShoalError
from shoal.scenario.load import load
from shoal.scenario.schema import Scenario

_HEADER = re.compile(r"\s*(\[\[?)\s*([\w.\-]+)\s*\]\]?\s*(?:#.*)?")
_PAIR = re.compile(r"(\s*([\w\-]+)\s*=\s*)(.*)")

Table = Mapping[str, Any]


def rewritten(text: str, scenario: Scenario) -> str | None:
    """Return a scenario's text with the values of another of the same tables; None where lines alone cannot say it.

    Numbers and words on a line of their own, as in the presets, are replaced, and defaults that are others now are
    written; a comment behind a value that changes goes, for it may explain the old one.

    Parameters
    ----------
    text : TOML that loads
    scenario : what the text is to load as
    """
    old = load(tomllib.loads(text)).model_dump(mode="json")
    new = scenario.model_dump(mode="json")
    counts: dict[str, int] = {}
    blocks = [_Block(old, new)]
    for line in text.splitlines():
        if header := _HEADER.fullmatch(line):
            bracket, name = header.groups()
            counts[name] = counts.get(name, -1) + 1
            number = counts[name] if bracket == "[[" else None
            blocks.append(_Block(_part(old, name, number), _part(new, name, number)))
        blocks[-1].add(line)
    written = "\n".join(line for block in blocks for line in block.finished()) + "\n"
    try:
        return written if load(tomllib.loads(written)) == scenario else None
    except (tomllib.TOMLDecodeError, ShoalError):
        return None


class _Block:
    """The lines from one header to the next.

    Parameters
    ----------
    old, new : the values of its table before and now
    """

    def __init__(self, old: Table, new: Table) -> None:
        self._changed = {
            key: value
            for key, value in new.items()
            if isinstance(value, (bool, int, float, str)) and value != old.get(key)
        }
        self._lines: list[str] = []
        self._last = 0  # the number of lines up to the last pair

    def add(self, line: str) -> None:
        """Take a line, with the value that is now."""
        if pair := _PAIR.fullmatch(line):
            start, key, _ = pair.groups()
            if key in self._changed:
                line = start + _value(self._changed.pop(key))
            self._last = len(self._lines) + 1
        self._lines.append(line)

    def finished(self) -> list[str]:
        """The lines, and behind the last pair what was not written before."""
        fresh = [f"{key} = {_value(value)}" for key, value in self._changed.items()]
        return [*self._lines[: self._last], *fresh, *self._lines[self._last :]]


def _part(table: Any, name: str, number: int | None) -> Table:
    """The table that a header names; an empty one where it is not found as simply."""
    for key in name.split("."):
        table = table.get(key) if isinstance(table, Mapping) else None
    if number is not None and isinstance(table, list) and number < len(table):
        table = table[number]
    return table if isinstance(table, Mapping) else {}


def _value(value: Any) -> str:
    return tomli_w.dumps({"value": value}).partition("=")[2].strip()
