"""What the command line does to start sooner, and what it says while it cannot."""

import sys
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING

from shoal.cli.progress import note

SECONDS_BETWEEN_LINES = 10.0

if TYPE_CHECKING:
    from shoal.scenario.schema import Scenario


def load_compiler() -> None:
    """Import numba without what it looks for and we do not need: a tenth of a short run.

    It asks for scipy's version, and reads settings by yaml if there is a file of them. It is done to our own process
    only, never by the library.
    """
    from shoal.run.compiling import interrupts_wait

    if "numba" in sys.modules:
        return
    unneeded = ["scipy", "yaml"][: 1 if Path(".numba_config.yaml").exists() else 2]
    hidden = [each for each in unneeded if each not in sys.modules]
    sys.modules.update(dict.fromkeys(hidden))  # type: ignore[arg-type]  # None is Python's way to say: not there
    try:
        with interrupts_wait():
            import numba  # noqa: F401
    finally:
        for each in hidden:
            del sys.modules[each]


def tell_of_compiling(scenario: "Scenario", whose: str = "") -> None:
    """Say so if the first step will compile the engine for this strategy, or for its buoys; and how far it is."""
    from shoal.run.compiling import cores, engine_is_compiled, needs_compiling, why_not_kept
    from shoal.scenario.crew import crew_of

    if not needs_compiling(scenario, whose):
        return
    crew = crew_of(scenario)
    once = why_not_kept(crew) or ("once per version of Shoal" if crew.builtin else "once per version of its files")
    if engine_is_compiled():
        note(f"compiling strategy {crew.name!r} into the engine, {once}: some 10 s")
        return
    how = f"a minute of processor time or so, on {cores()} cores" if cores() > 1 else "a minute or so"
    note(f"compiling the engine for strategy {crew.name!r}, {once}: {how}")
    threading.Thread(target=_tell_how_far, daemon=True).start()


def _tell_how_far() -> None:
    """Say it from time to time, while it is under way."""
    from shoal.run.compiling import how_far

    begun = time.monotonic()
    time.sleep(SECONDS_BETWEEN_LINES)
    while parts := how_far():
        done, of = parts
        note(f"compiled {done} of {of} parts that all strategies share, in {time.monotonic() - begun:.0f} s")
        time.sleep(SECONDS_BETWEEN_LINES)
