"""The house: rooms, and the arrows between them.

A room is the first name under `shoal`, or a module in its root. That no arrow points up is for import-linter.
"""

import ast
from pathlib import Path

import shoal

ROOT = Path(shoal.__file__).parent


def modules():
    """The syntax tree of every module by its name without `shoal.`."""
    return {
        ".".join(file.relative_to(ROOT).with_suffix("").parts): ast.parse(file.read_text(encoding="utf-8"))
        for file in sorted(ROOT.rglob("*.py"))
    }


def arrows():
    """Ordered pairs of rooms of which the first imports from the second, lazily too."""
    trees = modules()
    found = set()
    for name, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.level:
                raise AssertionError(f"{name} imports relatively: say the whole name")
            if isinstance(node, ast.ImportFrom):
                targets = [f"{node.module}.{each.name}" for each in node.names]
            elif isinstance(node, ast.Import):
                targets = [each.name for each in node.names]
            else:
                continue
            for target in targets:
                if target.startswith("shoal."):
                    found.add((name.split(".")[0], target.split(".")[1]))
    return {(one, other) for one, other in found if one != other}


def test_arrows_do_not_become_more():
    """Ask a room that is pointed at already, or lower the bound: fewer than 98."""
    assert len(arrows()) <= 97


def test_no_two_rooms_point_at_each_other_even_by_a_detour():
    down = {}
    for one, other in arrows():
        down.setdefault(one, set()).add(other)
    done = set()

    def descend(room, path):
        assert room not in path, f"a circle: {' -> '.join([*path, room])}"
        if room not in done:
            for other in down.get(room, ()):
                descend(other, [*path, room])
            done.add(room)

    for room in list(down):
        descend(room, [])
