"""A stage in memory: a NamedTuple of everything that phases work on, where a number says where it is.

    Placed.room, one block of bytes                 Placed.stage, Python's NamedTuple

    address -> | world  | agents: 50                world.agents
               |        | time_step: 0.1            world.time_step
               | swarm  | x: data, shape, ... --->  swarm.x, NumPy's array and the numbers in it
               |        | y: data, shape, ... --->  swarm.y
               | ...    |

Who owns what, and for how long:

- The block is the Placed's, and so are the arrays that it points at, through `Placed.stage`. Both live as long as the
  Placed does: whoever hands the address to a kernel keeps the Placed until the kernel is back.
- Arrays are shared: what a kernel writes into them, Python sees, and the other way round.
- Numbers in the block are copies: after a change of one (World, Radio) the stage is placed again.
- Kernels own nothing. `part` reads arrays without counting references, which would cost more than a step; so a kernel
  must neither keep such an array nor return it to Python.

All stages of a process, and of a cache of compiled code, have one type: that of the model which `all_like` names. It is
made of compiled sources alone, whose hash names the cache. A stage of another type is refused before it is written.
"""

from collections.abc import Callable
from functools import cache
from struct import pack_into
from typing import Any

import numpy as np
from llvmlite import ir
from numba import typeof, types
from numba.core import cgutils
from numba.core.registry import cpu_target
from numba.extending import lower_builtin, type_callable

from shoal.compiler.late import compiles

_MODEL: list[Callable[[], Any]] = []  # makes a stage, however small, of the type that all have


def all_like(model: Callable[[], Any]) -> Callable[[], Any]:
    """Decorate the function that makes a model of all stages."""
    _MODEL[:] = [model]
    return model


class Placed:
    """A stage where phases find it.

    Attributes
    ----------
    stage : what was placed
    address : where, for kernels, as long as this object lives; the stage itself without a compiler

    Raises
    ------
    TypeError : the stage is of another type than the model
    """

    def __init__(self, stage: Any) -> None:
        self.stage = stage
        self.address = stage
        if compiles():
            _refuse_other_types(stage)
            self.room = np.zeros(_size(), np.uint8)
            self.address = self.room.ctypes.data
            put(stage, _layout(), self.room)

    def change(self, field: int, value: Any) -> None:
        """Put another value, of the same type, where a field of the stage is: where numbers change, such as a run's."""
        self.stage = type(self.stage)(*(value if at == field else each for at, each in enumerate(self.stage)))
        if compiles():
            put(value, _layout()[field], self.room)
        else:
            self.address = self.stage


def part(stage: Any, field: int) -> Any:
    """One field of the stage at an address, by its index, in kernels."""
    return stage[field]


@cache
def stage_type() -> Any:
    """The type that all stages have."""
    return typeof(_MODEL[0]())


@cache
def _leaves_of_model() -> dict[str, Any]:
    return dict(_leaves(_MODEL[0](), "stage"))


def _refuse_other_types(stage: Any) -> None:
    """Compare with the model, leaf by leaf."""
    wanted = _leaves_of_model()
    given = dict(_leaves(stage, "stage"))
    for name in sorted(wanted.keys() | given.keys()):
        if wanted.get(name) != given.get(name):
            raise TypeError(f"{name} is {given.get(name, 'missing')}, where all have {wanted.get(name, 'nothing')}")


def _leaves(value: Any, name: str) -> Any:
    """Name and kind of every number and array in nested NamedTuples: what numba makes different types of."""
    if isinstance(value, np.ndarray):
        layout = "C" if value.flags.c_contiguous else "F" if value.flags.f_contiguous else "A"
        flags = "" if value.flags.aligned and value.flags.writeable else " (read-only or unaligned)"
        yield name, f"{_word(value.dtype)}[{', '.join(':' * value.ndim)}] in {layout} order{flags}"
    elif isinstance(value, tuple):
        for field, each in zip(value._fields, value, strict=True):  # type: ignore[attr-defined]
            yield from _leaves(each, f"{name}.{field}")
    else:
        yield name, _word(np.asarray(value).dtype)


@cache
def _word(dtype: Any) -> str:
    """What a dtype is called; NumPy takes its time to say it."""
    return str(dtype)


def put(value: Any, where: Any, room: Any) -> None:
    """Write a value to its place in a room, as kernels read it: of arrays, what numba's array structure says."""
    if isinstance(value, tuple):
        for each, place in zip(value, where, strict=True):
            put(each, place, room)
    elif isinstance(value, np.ndarray):
        address = value.ctypes.data
        form = f"=2Q2qQ{2 * value.ndim}q"
        pack_into(form, room, where, 0, 0, value.size, value.itemsize, address, *value.shape, *value.strides)
    else:
        number = np.asarray(value)
        room[where : where + number.nbytes] = np.frombuffer(number.tobytes(), np.uint8)


@cache
def _layout() -> Any:
    return layout(stage_type())


@cache
def _size() -> int:
    return size_of(stage_type())


@cache
def layout(whole_kind: Any) -> Any:
    """Where in a block each number and array of a NamedTuple's type is: offsets in nested lists, one per NamedTuple."""
    target = cpu_target.target_context
    data = target.codegen().target_data

    def offsets(kind: Any, start: int) -> Any:
        if not isinstance(kind, _TUPLE):
            return start
        whole = target.get_data_type(kind)
        if isinstance(whole, ir.ArrayType):  # of a NamedTuple whose fields are all alike
            size = whole.element.get_abi_size(data)
            return [offsets(each, start + size * place) for place, each in enumerate(kind)]
        laid = whole._get_ll_global_value_type(data)  # once: `whole.get_element_offset` parses it for every field
        return [offsets(each, start + data.get_element_offset(laid, place)) for place, each in enumerate(kind)]

    return offsets(whole_kind, 0)


@cache
def size_of(kind: Any) -> int:
    """Bytes of a value of a type in memory."""
    target = cpu_target.target_context
    return int(target.get_abi_sizeof(target.get_data_type(kind)))


_TUPLE: Any = types.BaseTuple  # NamedTuples, too


@type_callable(part)
def _type_of_part(context):
    def typer(stage, field):
        return stage_type()[field.literal_value] if isinstance(field, types.IntegerLiteral) else None

    return typer


@lower_builtin(part, types.Integer, types.IntegerLiteral)
def _load(context, builder, signature, arguments):
    place, stage = signature.args[1].literal_value, stage_type()
    pointer = builder.inttoptr(arguments[0], context.get_data_type(stage).as_pointer())
    return unowned(context, builder, stage[place], cgutils.gep_inbounds(builder, pointer, 0, place))


def borrow(value: Any) -> Any:
    """The same NamedTuple with arrays to which nobody counts references, for an entry kernel that writes to many.

    It is an argument from Python, which has it for longer than the kernel runs. (To name an array that is counted costs
    more than to write a number.)
    """
    return value


@type_callable(borrow)
def _type_of_borrowed(context):
    return lambda value: value if isinstance(value, _TUPLE) else None


@lower_builtin(borrow, _TUPLE)
def _borrow(context, builder, signature, arguments):
    return _without_owners(context, builder, signature.return_type, arguments[0])


def _without_owners(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    """A value with its arrays' owners set to nobody."""
    if isinstance(kind, _TUPLE):
        parts = [
            _without_owners(context, builder, each, builder.extract_value(value, place))
            for place, each in enumerate(kind)
        ]
        return context.make_tuple(builder, kind, parts)
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        return array._getvalue()
    return value


def unowned(context: Any, builder: Any, kind: Any, pointer: Any) -> Any:
    """The value at a pointer, with arrays that nobody counts references to: their owner is set to nobody (null)."""
    if isinstance(kind, _TUPLE):
        parts = [
            unowned(context, builder, each, cgutils.gep_inbounds(builder, pointer, 0, place))
            for place, each in enumerate(kind)
        ]
        return context.make_tuple(builder, kind, parts)
    value = context.unpack_value(builder, kind, pointer)
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        return array._getvalue()
    return value
