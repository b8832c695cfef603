"""Strategies of installed packages: entry points of the group "shoal.strategies", each named as its strategy.

A package is imported when its strategy is asked for, or all are listed; one that fails never harms the others.
"""

from importlib.metadata import EntryPoint, entry_points

from shoal.core.errors import StrategyError
from shoal.strategies import CATALOGUE, Strategy

GROUP = "shoal.strategies"


def installed_names() -> list[str]:
    """Names of the strategies that installed packages offer, none of them imported."""
    return sorted({entry.name for entry in entry_points(group=GROUP)})


def load_installed(name: str) -> Strategy | None:
    """The strategy of this name that an installed package offers, added to the catalogue; None if none does.

    Raises
    ------
    StrategyError : the package fails to import, or does not define the strategy that it offers
    """
    offered = {_package(entry): entry for entry in entry_points(group=GROUP, name=name)}
    if not offered:
        return None
    if len(offered) > 1:
        packages = " and ".join(sorted(offered))
        raise StrategyError(f"strategy {name!r}", f"is offered by {packages}", "uninstall all but one")
    package, entry = offered.popitem()
    if name not in CATALOGUE:
        _import(entry, package)
    if name not in CATALOGUE:
        problem = f"{entry.value} defines no strategy called {name!r}, as its entry point says"
        raise StrategyError(package, problem, "name the entry point as the strategy, or uninstall the package")
    if CATALOGUE[name].builtin:
        problem = f"offers a strategy called {name!r}, as a built-in one is"
        raise StrategyError(package, problem, "give it a name of its own, or uninstall the package")
    return CATALOGUE[name]


def load_all_installed() -> list[StrategyError]:
    """Add every strategy that installed packages offer to the catalogue; return what went wrong with the others."""
    wrong = []
    for name in installed_names():
        try:
            load_installed(name)
        except StrategyError as error:
            wrong.append(error)
    return wrong


def _import(entry: EntryPoint, package: str) -> None:
    """Import a package's module; what it defines is catalogued unless the name is taken, or the import fails."""
    before = dict(CATALOGUE)
    added: dict[str, Strategy] = {}
    try:
        entry.load()
        added = dict(CATALOGUE)
    except (Exception, SystemExit) as error:
        reason = error.args[1] if isinstance(error, StrategyError) else f"{type(error).__name__}: {error}"
        raise StrategyError(package, f"{entry.value} cannot be imported: {reason}", "update or uninstall it") from error
    finally:
        CATALOGUE.clear()
        CATALOGUE.update(added | before)


def _package(entry: EntryPoint) -> str:
    return f"package {entry.dist.name!r}" if entry.dist else f"entry point {entry.value!r}"
