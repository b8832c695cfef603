"""Errors a user can act on: each says where, what is wrong, and how to fix it."""

import difflib
from collections.abc import Iterable


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
        return f"{where}: {problem}\n  fix: {fix}"


class ScenarioError(ShoalError):
    """A scenario that cannot run."""


class TrackError(ShoalError):
    """A recorded track that cannot be used."""


class StrategyError(ShoalError):
    """A strategy that cannot be found, loaded or compiled."""


class RecordError(ShoalError):
    """A record that cannot be written or read."""


class MessageError(ShoalError):
    """A report that cannot be sent, or read."""


class MissingExtraError(ShoalError):
    """An optional library is needed and absent."""

    @classmethod
    def of(cls, package: str, extra: str, why: str) -> "MissingExtraError":
        """Return the one sentence: what to install and why."""
        return cls(package, f"is not installed, and {why} needs it", f"pip install 'shoal[{extra}]'")


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return the question whether a known name was meant, a space behind it; nothing if none is near."""
    near = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {near[0]!r}? " if near else ""
