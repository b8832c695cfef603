"""What the command line does to start sooner, and what it says while it cannot."""

import sys
from typing import TYPE_CHECKING

from shoal.cli.progress import note

if TYPE_CHECKING:
    from shoal.scenario.schema import Scenario


def load_compiler() -> None:
    """Import numba without scipy.linalg, which it looks for to compile matrix products; no kernel has one.

    That is a quarter of a second of every run. It is done to our own process only, never by the library.
    """
    wanted = "scipy.linalg.cython_blas"
    if wanted in sys.modules or "numba" in sys.modules:
        return
    sys.modules[wanted] = None  # type: ignore[assignment]  # Python's way to say: not there
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        del sys.modules[wanted]


def tell_of_compiling(scenario: "Scenario", whose: str = "") -> None:
    """Say so if the first step will compile the engine for this strategy, or for its buoys."""
    from shoal.run.compiling import engine_is_compiled, needs_compiling, why_not_kept
    from shoal.scenario.crew import crew_of

    if needs_compiling(scenario, whose):
        crew, seconds = crew_of(scenario), 5 if engine_is_compiled() else 20
        once = why_not_kept(crew) or "once per version of Shoal"
        note(f"compiling the engine for strategy {crew.name!r} (about {seconds} s, {once})")
