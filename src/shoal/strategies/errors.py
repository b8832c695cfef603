"""What goes wrong in a user's strategy as it is compiled or run, as one error that names its line."""

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from shoal.compiler.late import compiler_errors
from shoal.compiler.reason import reason_in
from shoal.core.errors import StrategyError
from shoal.strategies.contract import Strategy
from shoal.strategies.plugins import line_in


@contextmanager
def strategy_errors(strategies: Sequence[Strategy]) -> Iterator[None]:
    """Turn what the compiler says, or what a user's strategy raises, into one error; those of ours pass as they are.

    Parameters
    ----------
    strategies : those that run inside, of each fleet

    Raises
    ------
    StrategyError : a user's strategy cannot be compiled, or raised an error
    """
    own = [each for each in strategies if not each.builtin]
    if not own:
        yield
        return
    name, source = "+".join(dict.fromkeys(each.name for each in own)), own[0].source
    try:
        yield
    except compiler_errors() as error:
        raise _uncompiled(name, source, str(error)) from error
    except Exception as error:
        line = line_in(error.__traceback__, source)
        if isinstance(error, KeyError) and line is None:  # numba looked for a field of a record
            problem = f"{error.args[0]!r} is not a field of a memory, or is not told"
            raise _uncompiled(name, source, problem) from error
        raise StrategyError(
            f"{source}:{line}" if line else source,
            f"strategy {name!r} raised {type(error).__name__}: {error}",
            "return a velocity at every step",
        ) from error


def _uncompiled(name: str, source: str, compiler_text: str) -> StrategyError:
    lines = re.findall(re.escape(source) + r'[",(: ]+(?:line )?(\d+)', compiler_text)
    return StrategyError(
        ":".join([source, *lines[-1:]]),
        f"strategy {name!r} cannot be compiled: {_reason(compiler_text)}",
        "kernels take numbers, math, branches and loops; see docs/how-to/own-strategy.md",
    )


def _reason(compiler_text: str) -> str:
    """The one line of the compiler's pages that says most, without the types of all arguments."""
    if counted := re.search(r"influence returns \d+ numbers?, but[^;\n]*", compiler_text):
        return counted.group()
    if re.search(r"failed to unpack|unify return type|setitem\(array\(float64", compiler_text):
        return "a function does not return what it should: decide returns two numbers, influence one for each sum"
    return reason_in(compiler_text)
