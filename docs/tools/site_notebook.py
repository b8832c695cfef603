"""A notebook as a page of Markdown: its text, its code and what the code showed."""

import base64
import json
import re
from pathlib import Path
from typing import Any


def notebook_page(notebook: Path) -> tuple[str, dict[str, bytes]]:
    """Markdown of a notebook as it was run last, and its pictures by the name of their file."""
    parts, pictures = [], {}
    for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            parts.append(text)
            continue
        parts.append(fenced(text, "python"))
        for output in cell["outputs"]:
            shown, picture = output_of(output, f"{notebook.stem}-{len(pictures) + 1}.png")
            parts.append(shown)
            pictures |= picture
    return "\n\n".join(parts) + "\n", pictures


def output_of(output: dict[str, Any], name: str) -> tuple[str, dict[str, bytes]]:
    """One output as a notebook shows it: a picture, else a table, else text."""
    if output["output_type"] == "stream":
        return fenced("".join(output["text"]).rstrip(), "text"), {}
    data = {kind: "".join(lines) for kind, lines in output["data"].items()}
    if "image/png" in data:
        return f"![What the cell above draws]({name})", {name: base64.b64decode(data["image/png"])}
    if "text/html" in data:
        table = re.sub(r"<style.*?</style>", "", data["text/html"], flags=re.DOTALL).strip()
        lines = table.replace("\n", "&#10;")  # an empty line would end the HTML
        return f'<div class="output">{lines}</div>', {}
    return fenced(data["text/plain"], "text"), {}


def fenced(text: str, language: str) -> str:
    """A block of code."""
    return f"```{language}\n{text}\n```"
