"""Entry points of installed packages whose files are compiled into the engine, and the sources behind them."""

import importlib.util
from collections.abc import Iterator
from functools import cache
from importlib.machinery import ModuleSpec, PathFinder
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path

GROUPS = ("shoal.metrics", "shoal.targets", "shoal.disturbances")


@cache
def offers() -> dict[str, list[EntryPoint]]:
    """What installed packages offer in each group, sorted; nothing of theirs is imported."""
    known = entry_points()
    return {group: sorted(known.select(group=group), key=lambda each: (each.name, each.value)) for group in GROUPS}


def offered_sources() -> Iterator[bytes]:
    """Whatever decides which kernels of other packages are compiled, and from what: names and files, in order."""
    for group, entries in offers().items():
        for entry in entries:
            yield f"{group} {entry.name} = {entry.value}\n".encode()
            for path in _files(entry.module):
                yield path.read_bytes()


def package_in(text: str) -> str | None:
    """The package, of those that offer something, which a text names a file of; None if it names none."""
    for entries in offers().values():
        for entry in entries:
            if any(str(path) in text for path in _files(entry.module)):
                return package_of(entry)
    return None


def package_of(entry: EntryPoint) -> str:
    """Whose an entry point is, as errors say it."""
    return f"package {entry.dist.name!r}" if entry.dist else f"entry point {entry.value!r}"


def _files(module: str) -> list[Path]:
    """The files of the package that a module is in, or of the module if it is in none; none if there is none."""
    spec = _outermost(module)
    if spec is None or spec.origin is None:
        return []
    origin = Path(spec.origin)
    if spec.submodule_search_locations is not None:
        return sorted(origin.parent.rglob("*.py"))
    return [origin] if origin.is_file() else []


def _outermost(module: str) -> ModuleSpec | None:
    """The outermost package that a module is in, past namespaces that packages share; it is not imported."""
    first, *inner = module.split(".")
    try:
        spec = importlib.util.find_spec(first)
    except (ImportError, ValueError):
        return None
    name = first
    for part in inner:
        if spec is None or spec.origin is not None:
            break
        name = f"{name}.{part}"
        spec = PathFinder.find_spec(name, spec.submodule_search_locations)
    return spec
