"""shoal new-strategy: a strategy and its test, to start your own from."""

import keyword
import re
from importlib import resources
from pathlib import Path

from shoal.cli.output import write
from shoal.core.errors import StrategyError


def new_strategy(name: str, /, *, folder: Path = Path()) -> None:
    """Write a strategy that runs and a test that passes, to start your own from: NAME.py and test_NAME.py.

    Parameters
    ----------
    name
        What scenarios will call it, such as zigzag or zig-zag; the files are named by it with _ for -.
    folder
        Where to write them.
    """
    from shoal.strategies import CATALOGUE

    module = name.replace("-", "_")
    if not re.fullmatch(r"[a-z][a-z0-9]*([-_][a-z0-9]+)*", name) or keyword.iskeyword(module):
        raise StrategyError(f"name {name!r}", "is not a strategy name", "write lower-case words, such as zig-zag")
    if name in CATALOGUE:
        raise StrategyError(f"name {name!r}", "is a strategy that comes with Shoal", "choose another")
    words = {"NAME": name, "MODULE": module, "CLASS": module.title().replace("_", "")}
    texts = {folder / f"{module}.py": "strategy.txt", folder / f"test_{module}.py": "test.txt"}
    _write({file: _filled(template, words) for file, template in texts.items()})
    write(
        f"wrote {' and '.join(str(file) for file in texts)}\n"
        f"try:  shoal run oceans2020 --strategy {folder / f'./{module}.py'} --steps 20000\n"
        f"test: pytest {folder / f'test_{module}.py'}\n"
    )


def _filled(template: str, words: dict[str, str]) -> str:
    text = (resources.files("shoal.cli") / "templates" / template).read_text(encoding="utf-8")
    return re.sub("|".join(words), lambda match: words[match.group()], text)


def _write(texts: dict[Path, str]) -> None:
    """Write all files or none."""
    written: list[Path] = []
    try:
        for file, text in texts.items():
            with file.open("x", encoding="utf-8") as stream:
                written.append(file)
                stream.write(text)
    except BaseException as error:
        for half in written:
            half.unlink()
        if isinstance(error, FileExistsError):
            raise StrategyError(str(file), "exists already", "choose another name or folder") from None
        if isinstance(error, OSError):
            raise StrategyError(str(file), f"cannot be written: {error.strerror}", "choose another folder") from None
        raise
