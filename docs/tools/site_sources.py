"""Pages of the site for what its pages link to and what is no page: sources, and folders of them."""

from pathlib import Path, PurePosixPath

UNSEARCHED = "---\nsearch:\n  exclude: true\n---\n\n"
LANGUAGES = {".py": "python", ".toml": "toml", ".sh": "sh", ".cff": "yaml"}
HIDDEN = ("__pycache__", "__init__.py")


def source_page(file: PurePosixPath, root: Path) -> str:
    """A file of the repository, as a page that the search leaves out."""
    text = (root / file).read_text(encoding="utf-8").rstrip()
    return f"{UNSEARCHED}# {file.name}\n\n`{file}`\n\n~~~~~~{LANGUAGES.get(file.suffix, 'text')}\n{text}\n~~~~~~\n"


def folder_page(folder: PurePosixPath, root: Path) -> str:
    """What is in a folder, one link a line; links are those of the repository."""
    files = sorted(each for each in (root / folder).iterdir() if each.is_file() and each.name not in HIDDEN)
    lines = [f"- [{each.name if each.suffix != '.md' else title_of(each)}]({each.name})" for each in files]
    return f"{UNSEARCHED}# {folder.name.capitalize()}\n\n`{folder}`\n\n" + "\n".join(lines) + "\n"


def title_of(page: Path) -> str:
    """The first heading of a page."""
    return page.read_text(encoding="utf-8").split("\n", 1)[0].lstrip("# ")
