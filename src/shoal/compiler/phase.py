"""A phase: a part of the engine that is compiled once for all strategies and called through its address.

Numba compiles whatever a kernel calls into the kernel, so everything that `rollout` calls is recompiled for every
strategy. A phase is not: it is called through a number, the address of its machine code, and is handed another, the
address of the stage (compiler/placed.py). That takes most of the compiling off every strategy
(docs/decisions/0005-phases.md).

    @phase
    def advance(stage, number, first, batch, key):
        swarm = part(stage, SWARM)

    enter(address, stage, number, first, batch, key)     in a kernel; the address is that of `PHASE.address()`
"""

from collections.abc import Callable
from typing import Any

from llvmlite import ir
from numba import types
from numba.core.ccallback import CFunc
from numba.core.registry import cpu_target
from numba.extending import intrinsic, overload

from shoal.compiler.inner import FLAGS
from shoal.compiler.kernel import keep
from shoal.compiler.late import compiles

_callback: Any = CFunc  # numba has no types that mypy sees
_SIGNATURE = types.int64(types.int64, types.int64, types.int64, types.int64, types.uint64)


class Phase:
    """A function of (address of the stage, three integers, key) -> integer."""

    def __init__(self, function: Callable[..., int]) -> None:
        self.name = function.__name__
        self.function = function
        self._compiled: Any = None

    def address(self) -> Any:
        """Where its machine code is; the function itself without a compiler."""
        if not compiles():
            return self.function
        if self._compiled is None:
            compiled = self._callback()
            compiled.compile()
            self._compiled = compiled
        return self._compiled.address

    def is_kept(self) -> bool:
        """Whether its machine code is in the cache."""
        return bool(self._callback()._cache.file(_SIGNATURE, cpu_target.target_context).exists())

    def _callback(self) -> Any:
        kinds = (_SIGNATURE.args, _SIGNATURE.return_type)
        return keep(_callback(self.function, kinds, {}, FLAGS), self.function)


def phase(function: Callable[..., int]) -> Phase:
    """Make a phase of a function."""
    return Phase(function)


def enter(address: Any, stage: Any, number: int, first: int, batch: int, key: Any) -> Any:
    """Run the phase at an address, in kernels."""
    return address(stage, number, first, batch, key)


_as_kernel: Any = intrinsic


@_as_kernel
def _enter(context, address, stage, number, first, batch, key):
    def build(context, builder, signature, arguments):
        word = ir.IntType(64)
        kind = ir.FunctionType(word, [word] * 5)
        return builder.call(builder.inttoptr(arguments[0], kind.as_pointer()), arguments[1:])

    return types.int64(types.int64, *_SIGNATURE.args), build


@overload(enter, inline="always")
def _enter_kernel(address, stage, number, first, batch, key):
    return lambda address, stage, number, first, batch, key: _enter(address, stage, number, first, batch, key)
