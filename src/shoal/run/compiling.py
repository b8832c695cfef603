"""The engine compiled for a strategy: whether it is, and is kept."""

from contextlib import suppress
from pathlib import Path

from shoal.compiler.interrupts import interrupts_wait as interrupts_wait
from shoal.compiler.kernel import cache_folder, why_uncached
from shoal.engine.ahead import cores as cores
from shoal.engine.ahead import how_far as how_far
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.schema import Scenario

BUOYS = "buoys-"  # what the engine is compiled for beside the strategies of simulated agents


def needs_compiling(scenario: Scenario, whose: str = "") -> bool:
    """Whether the first step will compile the engine for this strategy, or its BUOYS: once per version."""
    mark = _compiled_mark(crew_of(scenario), whose)
    return mark is None or not mark.exists()


def engine_is_compiled() -> bool:
    """Whether the parts of the engine that know no strategy are in the cache."""
    return any(cache_folder().glob("compiled-*"))


def why_not_kept(crew: Crew) -> str | None:
    """Why the compiled engine is not kept for the next process; None if it is."""
    if crew.made_of is None:
        return f"every time: what {crew.source} is made of cannot be told from its text and its numbers"
    why = why_uncached()
    return why and f"every time: {why}"


def mark_compiled(scenario: Scenario, whose: str = "") -> None:
    """Remember that this strategy's engine, or that of its BUOYS, is in the cache."""
    mark = _compiled_mark(crew_of(scenario), whose)
    if mark is not None:
        with suppress(OSError):  # only a message depends on it
            mark.touch()


def _compiled_mark(crew: Crew, whose: str) -> Path | None:
    if crew.made_of is None:
        return None
    return cache_folder() / "-".join(["compiled", whose + crew.name, *([crew.made_of] if crew.made_of else [])])
