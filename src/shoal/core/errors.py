"""Errors a user can act on: each says where, what is wrong, and how to fix it."""

import difflib
import re
from collections.abc import Iterable

from shoal.core.text import cut, quoted, readable


class ShoalError(ValueError):
    """Base of every error Shoal raises on purpose; the command line exits with 2 on it.

    Parameters
    ----------
    where : the file, line, field or option at fault
    problem : what is wrong with it
    fix : what to do about it
    """

    def __init__(self, where: str, problem: str, fix: str) -> None:
        super().__init__(where, problem, fix)  # all three: workers pickle errors home

    def __str__(self) -> str:
        where, problem, fix = self.args
        return readable(f"{cut(where)}: {problem}\n  fix: {fix}")


class ScenarioError(ShoalError):
    """A scenario that cannot run."""


class TrackError(ShoalError):
    """A recorded track that cannot be used."""


class SeaError(ShoalError):
    """Currents, wind, a coast or a search area that cannot be used."""


class StrategyError(ShoalError):
    """A strategy that cannot be found, loaded or compiled."""


class PluginError(ShoalError):
    """An installed package that offers Shoal something, such as a metric, which cannot be used."""


class RecordError(ShoalError):
    """A record that cannot be written or read."""


class MessageError(ShoalError):
    """A report that cannot be sent, or read."""


class FleetError(ShoalError):
    """A fleet of buoys that cannot start or go on."""


class DeviceError(ShoalError):
    """A graphics card that is not there, or cannot do what is asked."""


class MissingExtraError(ShoalError):
    """An optional library is needed and absent."""

    @classmethod
    def of(cls, package: str, extra: str, why: str) -> "MissingExtraError":
        """Return the one sentence: what to install and why."""
        fix = f"pip install '.[{extra}]', in your clone of Shoal"
        return cls(package, f"is not installed, and {why} needs it", fix)


class UnknownNameError(ShoalError, KeyError):
    """A name that nothing has: of a metric, a table, a field."""

    @classmethod
    def of(cls, what: str, name: object, known: Iterable[str]) -> "UnknownNameError":
        """Return the error that says what there is, and what was probably meant."""
        names = list(known)
        return cls(
            f"{what} {quoted(name)}", "there is none of this name", f"{did_you_mean(str(name), names)}{_all(names)}"
        )


def no_attribute(owner: str, name: str, known: Iterable[str]) -> AttributeError:
    """Return the error that `owner` has no attribute `name`: it lists those `known`, and the one meant."""
    names = list(known)
    return AttributeError(f"{owner} has no attribute {name!r}; {did_you_mean(name, names)}{_all(names)}", name=name)


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return the question whether a known name was meant, a space after it; empty if none is near.

    Near is the path that ends in it, its plural, or the only name that ends in it; or else what is spelt alike, what
    has these initials, the only one with this part.
    """
    names = list(known)
    near = [each for each in names if each.endswith(f".{name}")][:1]
    near = near or [each for each in names if each.removesuffix("s") == name.removesuffix("s")][:1]
    near = near or _only(each for each in names if each.endswith(f"_{name}"))
    near = near or difflib.get_close_matches(name[:100], names, n=1)
    near = near or [each for each in names if len(name) > 1 and _initials(each) == name]
    near = near or [each for each in names if len(name) > 2 and name in each]
    return f"did you mean {near[0]!r}? " if len(near) == 1 else ""


def _only(names: Iterable[str]) -> list[str]:
    """These names if there is one, else none."""
    found = list(names)
    return found if len(found) == 1 else []


def _initials(name: str) -> str:
    return "".join(word[:1] for word in re.split(r"[_-]", name))


def _all(names: list[str]) -> str:
    return f"there are: {', '.join(names)}"


def reason_of(error: Exception) -> str:
    """What an error of Python or of a library says, in a line; a missing key is named as such."""
    if isinstance(error, KeyError):
        return f"it has no {error}"
    return " ".join(str(error).split())[:300] or type(error).__name__
