"""What goes wrong in a user's strategy as it is compiled or run, as one error that names its line."""

import re
from collections.abc import Iterator
from contextlib import contextmanager

from shoal.compiler.kernel import NumbaError
from shoal.core.errors import StrategyError
from shoal.scenario.crew import Crew
from shoal.strategies.plugins import line_in

_TELLS = "rror|nknown|not defined|resolve|nvalid|No implementation"
_SILENT = "Failed in nopython mode|Rejected as|^During|^File "


@contextmanager
def strategy_errors(crew: Crew) -> Iterator[None]:
    """Turn what the compiler says, or what the strategy raises, into one error; our own strategies' pass as they are.

    Raises
    ------
    StrategyError : the strategy cannot be compiled, or raised an error
    """
    try:
        yield
    except NumbaError as error:
        if crew.builtin:
            raise
        raise _uncompiled(crew, str(error)) from error
    except Exception as error:
        if crew.builtin:
            raise
        line = line_in(error.__traceback__, crew.source)
        if isinstance(error, KeyError) and line is None:  # numba looked for a field of a record
            raise _uncompiled(crew, f"{error.args[0]!r} is no field of a memory, or is not told") from error
        raise StrategyError(
            f"{crew.source}:{line}" if line else crew.source,
            f"strategy {crew.name!r} raised {type(error).__name__}: {error}",
            "return a velocity at every step",
        ) from error


def _uncompiled(crew: Crew, told: str) -> StrategyError:
    lines = re.findall(re.escape(crew.source) + r'[",(: ]+(?:line )?(\d+)', told)
    return StrategyError(
        ":".join([crew.source, *lines[-1:]]),
        f"strategy {crew.name!r} cannot be compiled: {_reason(told)}",
        "kernels take numbers, math, branches and loops; see docs/how-to/own-strategy.md",
    )


def _reason(told: str) -> str:
    """The one line of the compiler's pages that says most, without the types of all arguments."""
    if counted := re.search(r"influence returns \d+ numbers?, but[^;\n]*", told):
        return counted.group()
    if re.search(r"failed to unpack|unify return type|setitem\(array\(float64", told):
        return "a function does not return what it should: decide returns two numbers, influence one for each sum"
    lines = [line.strip() for line in told.splitlines() if line.strip()]
    saying = [line for line in lines if not re.search(_SILENT, line)] or lines
    reason = next((line for line in reversed(saying) if re.search(_TELLS, line)), saying[0])
    return re.sub(r"(of type \w+)\(.*", r"\1", reason)
