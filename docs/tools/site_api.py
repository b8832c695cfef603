"""The page of the Python functions and classes, which mkdocstrings fills from their docstrings."""

import ast
from pathlib import Path

MODULES = ("shoal.learn.env",)  # public, and not in `import shoal`


def api_page(root: Path) -> str:
    """Markdown with a directive for every public name, in the order of `shoal.__all__`."""
    tree = ast.parse((root / "src/shoal/__init__.py").read_text(encoding="utf-8"))
    (names,) = (
        ast.literal_eval(node.value)
        for node in tree.body
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__"
    )
    targets = [f"shoal.{name}" for name in names if not name.startswith("__") and name != "plot"] + [*MODULES]
    head = "# Functions and classes\n\nFrom their docstrings; [Python](python.md) is the shorter list.\n"
    return head + "".join(f"\n::: {target}\n" for target in targets)
