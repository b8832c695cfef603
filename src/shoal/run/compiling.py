"""The engine compiled for a strategy: whether it is, and is kept."""

from pathlib import Path

from shoal.compiler.kernel import cache_folder, why_uncached
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario

BUOYS = "buoys-"  # what the engine is compiled for beside the strategies of simulated agents


def needs_compiling(scenario: Scenario, whose: str = "") -> bool:
    """Whether the first step will compile the engine for this strategy, or its BUOYS: once per version."""
    crew = crew_of(scenario)
    return not crew.builtin or not _compiled_mark(whose + crew.name).exists()


def engine_is_compiled() -> bool:
    """Whether the parts of the engine that know no strategy are in the cache."""
    return any(cache_folder().glob("compiled-*"))


def why_not_kept(crew: Crew) -> str | None:
    """Why the compiled engine is not kept for the next process; None if it is."""
    if not crew.builtin:
        return "a file of yours is compiled every time"
    why = why_uncached()
    return why and f"every time: {why}"


def mark_compiled(scenario: Scenario, whose: str = "") -> None:
    """Remember that this strategy's engine, or that of its BUOYS, is in the cache."""
    crew = crew_of(scenario)
    if crew.builtin:
        try:
            _compiled_mark(whose + crew.name).touch()
        except OSError:
            return  # only a message depends on it


def _compiled_mark(name: str) -> Path:
    return cache_folder() / f"compiled-{name}"
