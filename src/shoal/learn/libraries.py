"""The libraries of environments: what ours are derived from, and what is said where they are not installed."""

from importlib import import_module
from typing import Any

from shoal.core.errors import MissingExtraError


def needed(package: str, why: str) -> Any:
    """Return a package of the extra `rl`.

    Raises
    ------
    MissingExtraError : it is not installed
    """
    try:
        return import_module(package)
    except ImportError as error:
        raise MissingExtraError.of(package, "rl", why) from error


def _class(module: str, name: str) -> Any:
    """A class to derive from; `object` where there is none: `needed` says so when one is made."""
    try:
        return getattr(import_module(module), name)
    except ImportError:
        return object


GYMNASIUM_VECTOR_ENV: Any = _class("gymnasium.vector", "VectorEnv")
PETTINGZOO_PARALLEL_ENV: Any = _class("pettingzoo", "ParallelEnv")
