"""Damage that can befall a file: seeded, so that every failure can be seen again."""

import json
import os
import random
from pathlib import Path
from typing import Any

NASTY = (
    None, True, False, 0, -1, 1, 2**31, 2**63, 2**70, 10**30, 0.0, -0.5, 1e308, "", "x", "1", "\ud800", "../../x",
    "\x1b[2J", [], [1], [[]], {}, {"a": 1}, "NaN",
)  # fmt: skip


def hurt_bytes(file: Path, chance: random.Random) -> str:
    """Change the bytes of a file in some way; return what was done."""
    content = bytearray(file.read_bytes())
    size = len(content)
    at = chance.randrange(size or 1)
    what = chance.choice(("flip", "flip", "flip", "cut", "zeros", "noise", "insert", "double", "move", "gone", "empty"))
    match what:
        case "flip":
            for _ in range(chance.choice((1, 1, 2, 20))):
                content[chance.randrange(size)] ^= 1 << chance.randrange(8)
        case "cut":
            del content[at:]
        case "zeros":
            content[at : at + 64] = bytes(len(content[at : at + 64]))
        case "noise":
            content[at : at + 512] = chance.randbytes(len(content[at : at + 512]))
        case "insert":
            content[at:at] = chance.randbytes(chance.randrange(1, 40))
        case "double":
            content += content[at:]
        case "move":
            content = content[at:] + content[:at]
        case "gone":
            file.unlink()
            return what
        case "empty":
            content = bytearray()
    os.unlink(file)  # never through a link to the original
    file.write_bytes(content)
    return f"{what} at {at} of {size}"


def hurt_json(tree: Any, chance: random.Random) -> str:
    """Change one value of a tree of dicts and lists in some way; return what was done."""
    path: list[Any] = []
    holder = tree
    while True:
        places = list(holder) if isinstance(holder, dict) else list(range(len(holder)))
        place = chance.choice(places)
        path.append(place)
        value = holder[place]
        if not (isinstance(value, (dict, list)) and value and chance.random() < 0.85):
            break
        holder = value
    what = chance.choice(("nasty", "nasty", "number", "gone", "swap", "add", "deep", "wrap"))
    match what:
        case "number" if isinstance(value, (int, float)) and not isinstance(value, bool):
            holder[place] = chance.choice((value + 1, -value, value * 2, value / 2, int(value), value * 1e9))
        case "gone":
            del holder[place]
        case "swap":
            other = chance.choice(places)
            holder[place], holder[other] = holder[other], holder[place]
        case "add":
            if isinstance(holder, dict):
                holder[f"{place}_too"] = value
            else:
                holder.append(value)
        case "deep":
            for _ in range(chance.choice((3, 300))):
                value = [value]
            holder[place] = value
        case "wrap":
            holder[place] = {str(place): value}
        case _:
            holder[place] = chance.choice(NASTY)
    return f"{what} of {'.'.join(map(str, path))}"


def same_json(one: Any, other: Any) -> bool:
    """Whether two trees say the same, types included."""
    return json.dumps(one, sort_keys=True) == json.dumps(other, sort_keys=True)
