"""Compile what runs need before they begin, one strategy after the other, and say which."""

from collections.abc import Callable, Iterable, Iterator

from shoal.experiments.executors import Done, Executor, Task
from shoal.run.compiling import engine_is_compiled, mark_compiled, needs_compiling
from shoal.run.simulation import Simulation
from shoal.scenario.crew import crew_of


def compiled_first(execute: Executor, tell: Callable[[str], None]) -> Executor:
    """Return an executor that compiles the strategies of its tasks first; `tell` gets a line for each.

    Threads would wait for each other: numba compiles one function at a time. Strategies are compiled once
    per version, those from a file once per version of all that they are made of, if that can be told.

    Raises
    ------
    StrategyError : a strategy from a file that cannot be compiled or run; nothing has run then
    """

    def run(tasks: Iterable[Task]) -> Iterator[Done]:
        wanted = list(tasks)
        scenarios = {crew_of(cell.scenario).params.__class__: cell.scenario for cell, _ in wanted}
        pending = [each for each in scenarios.values() if needs_compiling(each)]
        for number, scenario in enumerate(pending, 1):
            long = "some seconds each" if engine_is_compiled() else "and the engine, once: a minute or so"
            tell(f"compiling {crew_of(scenario).name} ({number} of {len(pending)}, {long})")
            Simulation(scenario).advance(1)
            mark_compiled(scenario)
        yield from execute(wanted)

    return run


def say_nothing(message: str) -> None:
    """What a library is told, which never prints."""
