"""Files that declare themselves: of a folder of ours, or of an installed package that offers one as an entry point.

A file declares itself by giving one name, such as MEASUREMENT, a value at its top level. What it declares has a name;
an entry point is named the same. Files that do not say it are in the folder for other reasons and are not imported.
"""

import importlib
import pkgutil
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from types import ModuleType
from typing import Any, Generic, Protocol, TypeVar

from shoal.compiler.installed import offers, package_of
from shoal.core.errors import PluginError, ShoalError


class Named(Protocol):
    """What a file declares."""

    @property
    def name(self) -> str:
        """By which it is asked for, and by which its entry point is called."""


Kind = TypeVar("Kind", bound=Named)


@dataclass(frozen=True)
class Declared(Generic[Kind]):
    """What a file declares, and the installed package that it is from; None: it is built in."""

    value: Kind
    package: str | None = None


def declared(folder: str, mark: str, kind: type[Kind], group: str) -> tuple[list[Declared[Kind]], list[PluginError]]:
    """Return what the files of a folder declare, sorted by name, then what packages do; and what is wrong with others.

    Parameters
    ----------
    folder : the package whose files declare themselves, such as "shoal.metrics"
    mark : the name that they give a value, such as MEASUREMENT
    kind : the type of that value
    group : of entry points, one of `compiler.installed.GROUPS`, each "name = module" or "name = module:mark"
    """
    builtin = (Declared(getattr(module, mark)) for module in import_marked(folder, mark))
    found = sorted(builtin, key=lambda each: each.value.name)
    names = {each.value.name for each in found}
    by_name: dict[str, list[EntryPoint]] = {}
    for entry in offers()[group]:
        by_name.setdefault(entry.name, []).append(entry)
    wrong = []
    for name, entries in by_name.items():
        try:
            found.append(_of_package(name, entries, mark, kind, name in names))
        except PluginError as error:
            wrong.append(error)
    return found, wrong


def is_offered(name: str, group: str) -> bool:
    """Whether an installed package offers something of this name, be it broken or not."""
    return any(entry.name == name for entry in offers()[group])


def import_marked(folder: str, mark: str) -> list[ModuleType]:
    """Import the modules in a folder whose top level says a name, such as MEASUREMENT; they are sorted by theirs."""
    modules = []
    for each in pkgutil.iter_modules(importlib.import_module(folder).__path__, f"{folder}."):
        finder: Any = each.module_finder
        if mark in finder.find_spec(each.name).loader.get_code(each.name).co_names:
            modules.append(importlib.import_module(each.name))
    return modules


def _of_package(name: str, entries: list[EntryPoint], mark: str, kind: type[Kind], builtin: bool) -> Declared[Kind]:
    what = mark.lower()
    packages = sorted({package_of(entry) for entry in entries})
    if len(entries) > 1:
        raise PluginError(f"{what} {name!r}", f"is offered by {' and '.join(packages)}", "uninstall all but one")
    entry, package = entries[0], packages[0]
    if builtin:
        problem = f"offers a {what} called {name!r}, as a built-in one is"
        raise PluginError(package, problem, "give it a name of its own, or uninstall the package")
    value = _load(entry, package)
    value = getattr(value, mark, None) if isinstance(value, ModuleType) else value
    if not isinstance(value, kind):
        problem = f"{entry.value} declares no {what}: {mark} is not a {kind.__name__}"
        raise PluginError(package, problem, f"let it hold {mark} = {kind.__name__}(...), or uninstall the package")
    if value.name != name:
        problem = f"{entry.value} declares the {what} {value.name!r}, but its entry point says {name!r}"
        raise PluginError(package, problem, "name the entry point as what it declares, or uninstall the package")
    return Declared(value, package)


def _load(entry: EntryPoint, package: str) -> Any:
    try:
        return entry.load()
    except (Exception, SystemExit) as error:
        reason = error.args[1] if isinstance(error, ShoalError) else f"{type(error).__name__}: {error}"
        raise PluginError(package, f"{entry.value} cannot be imported: {reason}", "fix or uninstall it") from error
