"""A phase: a part of the engine that is compiled once for all strategies and called through its address.

Numba compiles whatever a kernel calls into the kernel, so everything that `rollout` calls is compiled anew for every
strategy. A phase is not: `rollout` gets its address as a number, and hands it the address of the stage, a NamedTuple of
everything that it works on. That takes most of the compiling off every strategy (docs/decisions/0005-phases.md).

    @phase
    def advance(here, number, other, key):
        swarm = part(here, SWARM)     the field of the stage that has this index

    here, held = put(stage); PHASE.address()     in Python; the stage is there while `held` lives
    enter(address, here, number, other, key)     in a kernel

All stages of a process have one type: what differs between strategies is no part of it.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba import cfunc, typeof, types
from numba.core import cgutils
from numba.extending import intrinsic, overload

from shoal.compiler.inner import FLAGS
from shoal.compiler.kernel import compiles, entry_kernel, kernel_cache

_ROOM = 1 << 15  # bytes for a stage, of which some 6,000 are used
_STAGE: list[Any] = []  # numba's type of the stage, once there is one


class Phase:
    """A function of (where the stage is, integer, integer, key) -> integer."""

    def __init__(self, function: Callable[..., int]) -> None:
        self.function = function
        self._compiled: Any = None

    def address(self) -> Any:
        """Where its machine code is; the function itself without a compiler."""
        if not compiles():
            return self.function
        if self._compiled is None:
            signature = types.int64(types.int64, types.int64, types.int64, types.uint64)
            with kernel_cache():
                self._compiled = cfunc(signature, cache=True, **FLAGS)(self.function)
        return self._compiled.address


def phase(function: Callable[..., int]) -> Phase:
    """Make a phase of a function."""
    return Phase(function)


def put(stage: Any) -> tuple[Any, Any]:
    """Put a stage where phases find it; returns where that is and what keeps it there."""
    if not compiles():
        return stage, stage
    if not _STAGE:
        _STAGE.append(typeof(stage))
    room = np.empty(_ROOM, np.uint8)
    if _put(stage, room) > _ROOM:
        raise AssertionError("the stage needs more room")
    return room.ctypes.data, (room, stage)


def part(here: Any, field: int) -> Any:
    """One field of the stage, by its index, in kernels."""
    return here[field]


def enter(address: Any, here: Any, number: int, other: int, key: Any) -> Any:
    """Run the phase at an address, in kernels."""
    return address(here, number, other, key)


@entry_kernel
def _put(stage, room):
    return _store(stage, room.ctypes.data)


_TUPLE: Any = types.BaseTuple  # NamedTuples, too
_as_kernel: Any = intrinsic
_as_literal_kernel: Any = intrinsic(prefer_literal=True)


@_as_kernel
def _store(context, stage, here):
    def build(context, builder, signature, arguments):
        kind = context.get_data_type(stage)
        context.pack_value(builder, stage, arguments[0], builder.inttoptr(arguments[1], kind.as_pointer()))
        return ir.Constant(ir.IntType(64), context.get_abi_sizeof(kind))

    return types.int64(stage, types.intp), build


@_as_literal_kernel
def _load(context, here, field):
    place, stage = field.literal_value, _STAGE[0]

    def build(context, builder, signature, arguments):
        pointer = builder.inttoptr(arguments[0], context.get_data_type(stage).as_pointer())
        return _unowned(context, builder, stage[place], cgutils.gep_inbounds(builder, pointer, 0, place))

    return stage[place](types.int64, field), build


def _unowned(context: Any, builder: Any, kind: Any, pointer: Any) -> Any:
    """The value at a pointer, with arrays that nobody counts references to: counting costs more than a step."""
    if isinstance(kind, _TUPLE):
        parts = [
            _unowned(context, builder, each, cgutils.gep_inbounds(builder, pointer, 0, place))
            for place, each in enumerate(kind)
        ]
        return context.make_tuple(builder, kind, parts)
    value = context.unpack_value(builder, kind, pointer)
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        return array._getvalue()
    return value


@_as_kernel
def _enter(context, address, here, number, other, key):
    def build(context, builder, signature, arguments):
        word = ir.IntType(64)
        kind = ir.FunctionType(word, [word] * 4)
        return builder.call(builder.inttoptr(arguments[0], kind.as_pointer()), arguments[1:])

    return types.int64(types.int64, types.int64, types.int64, types.int64, types.uint64), build


@overload(part, inline="always", prefer_literal=True)
def _part_kernel(here, field):
    return lambda here, field: _load(here, field)


@overload(enter, inline="always")
def _enter_kernel(address, here, number, other, key):
    return lambda address, here, number, other, key: _enter(address, here, number, other, key)
