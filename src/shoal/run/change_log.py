"""The log of changes: what was asked of a swarm while it ran, and at which step. With it, the run can be made again.

A text of JSON lines: the first says what was run, each other is one change, see docs/reference/change-log.md.
"""

import json
from collections.abc import Mapping, Sequence
from datetime import date, time
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import ValidationError

from shoal.core.errors import ScenarioError
from shoal.core.text import cut
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.run.changes import READER, Restart, Steering, words_of
from shoal.run.settings import Settings, Table
from shoal.scenario.strategy_choice import StrategyChoice

FORMAT = 1
LARGEST = 100_000_000  # bytes of a log's file
MOST = 100_000  # changes of a log


class Entry(NamedTuple):
    """A change, and the step from which it is so."""

    step: int
    steering: Steering


class Logged(NamedTuple):
    """What was run: its name, the raw table of its scenario, and the hash that the scenario had."""

    name: str
    table: Table
    hash: str


class ChangeLog(NamedTuple):
    """What was run and how it was changed.

    runs : one, or two side by side
    entries : in the order in which they were made; after a restart, steps begin at 0 again
    step : where the run was when the log was written
    results_version : of the Shoal that ran it
    """

    runs: tuple[Logged, ...]
    entries: tuple[Entry, ...]
    step: int
    results_version: int = RESULTS_VERSION

    def text(self) -> str:
        """Return the log as the text of a file."""
        head = {
            "shoal_changes": FORMAT,
            "shoal": VERSION,
            "results_version": self.results_version,
            "step": self.step,
            "runs": [{"name": each.name, "hash": each.hash, "scenario": each.table} for each in self.runs],
        }
        lines = [head, *({"step": step, **said.model_dump(exclude_none=True)} for step, said in self.entries)]
        return "".join(json.dumps(line, default=_as_json) + "\n" for line in lines)

    def settings(self, run: int) -> Settings:
        """Return the settings that a run began with.

        Raises
        ------
        ScenarioError : there is no such run, or its scenario is not here any more what it was
        TrackError, StrategyError : what it names cannot be loaded
        """
        if not 0 <= run < len(self.runs):
            raise ScenarioError("run", f"is {run}", f"the log is of {len(self.runs)}; count them from 0")
        name, table, known = self.runs[run]
        settings = Settings.of(table, where=name)
        if settings.scenario.hash != known:
            problem = f"is scenario {settings.scenario.hash} here; the log is of {known}"
            raise ScenarioError(name, problem, "restore the strategy or the track that it names")
        return settings

    def of_run(self, run: int) -> tuple[Entry, ...]:
        """Return the changes of one run; restarts are of all."""
        return tuple(each for each in self.entries if getattr(each.steering, "run", run) == run)

    @property
    def last(self) -> int:
        """Where the run ends that the log makes: where it was written, or later if its last change is."""
        later = [each.step for each in self.entries[-1:] if not isinstance(each.steering, Restart)]
        return max([self.step, *later])

    @property
    def note(self) -> str | None:
        """What to say of a log that another Shoal wrote; None: nothing."""
        if self.results_version == RESULTS_VERSION:
            return None
        return (
            f"the log is of results version {self.results_version}, this is {RESULTS_VERSION}: "
            "the run may not be the same to the bit"
        )


def since_restart(entries: Sequence[Entry]) -> int:
    """Return how many entries lie before the steps that count: the last restart and all before it."""
    return max((n + 1 for n, each in enumerate(entries) if isinstance(each.steering, Restart)), default=0)


def told(entries: Sequence[Entry]) -> list[dict[str, Any]]:
    """Return the changes as a record says them: step and words of each."""
    return [{"step": step, "words": words_of(steering)} for step, steering in entries]


def read_log(file: str | Path) -> ChangeLog:
    """Read a log of changes.

    Raises
    ------
    ScenarioError : no such file, or one that is no log
    """
    try:
        with Path(file).open("rb") as stream:
            content = stream.read(LARGEST + 1)
        text = content.decode("utf-8")
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "is not a text file"
        raise ScenarioError(str(file), reason, "name a log of changes, as the page saves it") from None
    if len(content) > LARGEST:
        raise ScenarioError(str(file), f"is larger than {LARGEST // 10**6} MB", "name a log of changes")
    return log_of(text, str(file))


def log_of(text: str, where: str = "log") -> ChangeLog:
    """Return the log that a text is.

    Parameters
    ----------
    where : what errors call it

    Raises
    ------
    ScenarioError : it is none
    """
    lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
    if len(lines) > MOST + 1:
        raise ScenarioError(where, f"holds {len(lines) - 1:,} changes", f"at most {MOST:,} can be made again")
    head = _object(lines[0][1] if lines else "", where, 1)
    if head.get("shoal_changes") != FORMAT:
        known = head.get("shoal_changes")
        problem = "is not a log of changes" if known is None else f"is a log of format {cut(str(known))}"
        raise ScenarioError(where, problem, "name a file that the page of `shoal watch` saved")
    try:
        runs = tuple(Logged(str(each["name"]), dict(each["scenario"]), str(each["hash"])) for each in head["runs"])
        step, version = int(head["step"]), int(head["results_version"])
        if not 1 <= len(runs) <= 2 or step < 0:
            raise ValueError
    except (KeyError, TypeError, ValueError):
        raise ScenarioError(f"{where}:1", "does not say what was run", "take the log from a backup") from None
    entries: list[Entry] = []
    for number, line in lines[1:]:
        entries.append(_entry(_object(line, where, number), f"{where}:{number}", len(runs), entries[-1:]))
    return ChangeLog(runs, tuple(entries), step, version)


def _as_json(value: Any) -> Any:
    """What a table may hold that JSON has no word for: dates, and strategies that are loaded."""
    if isinstance(value, (date, time)):
        return value.isoformat()
    if isinstance(value, StrategyChoice):
        return value.flat()
    raise TypeError(f"a log cannot hold a {type(value).__name__}")


def _entry(said: dict[str, Any], where: str, runs: int, before: list[Entry]) -> Entry:
    step = said.pop("step", None)
    least = 0 if not before or isinstance(before[0].steering, Restart) else before[0].step
    if type(step) is not int or not least <= step < 2**62:
        raise ScenarioError(where, f"step is {cut(str(step))}", f"give a step, {least:,} or later")
    try:
        steering = READER.validate_python(said)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        path = ".".join(str(part) for part in first["loc"])
        raise ScenarioError(f"{where} {path}".rstrip(), first["msg"], "see docs/reference/change-log.md") from None
    if not 0 <= getattr(steering, "run", 0) < runs:
        raise ScenarioError(where, "is of a run that the log does not have", f"name one from 0 to {runs - 1}")
    return Entry(step, steering)


def _object(line: str, where: str, number: int) -> dict[str, Any]:
    try:
        content = json.loads(line)
    except (ValueError, RecursionError):
        content = None
    if not isinstance(content, Mapping):
        fix = "name a file that the page of `shoal watch` saved"
        raise ScenarioError(f"{where}:{number}", "is not a line of a log of changes", fix)
    return dict(content)
