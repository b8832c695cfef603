"""Stages on a card of which something is known when their kernel is compiled: what it rules out is no code then.

As a strategy is chosen by the type of its parameters, what is known is by the type of an address: one class for each
set of facts.
"""

from collections.abc import Iterable
from functools import cache
from typing import Any, NamedTuple

from numba import types
from numba.core import cgutils
from numba.extending import lower_builtin, type_callable

from shoal.compiler.late import compiles
from shoal.compiler.placed import stage_type, unowned

Fact = tuple[int, str, Any]  # field of the stage, name of a number in it, and the number
_FACTS: dict[Any, tuple[Fact, ...]] = {}


@cache
def place_of(facts: tuple[Fact, ...]) -> Any:
    """A function for kernels that makes of a stage's address what `read` takes."""
    if not compiles():
        return lambda stage: stage

    class Place(NamedTuple):
        address: int

    _FACTS[Place] = facts
    return Place


def read(stage: Any, field: int) -> Any:
    """One field of a stage, by its index, in kernels; see `part`."""
    return stage[field]


def with_aligned_records(kind: Any) -> Any:
    """The same type, where fields of records are read whole: else a card reads eight bytes one by one."""
    if isinstance(kind, types.BaseTuple):
        parts: Any = kind
        return types.BaseTuple.from_types([with_aligned_records(each) for each in parts], _class_of(kind))
    if isinstance(kind, types.Array) and isinstance(kind.dtype, types.Record):
        fields: Iterable[Any] = kind.dtype.fields.items()
        record = types.Record([(name, each._asdict()) for name, each in fields], kind.dtype.size, True)
        return types.Array(record, kind.ndim, kind.layout, readonly=not kind.mutable)
    return kind


def _class_of(kind: Any) -> Any:
    return getattr(kind, "instance_class", None)


@type_callable(read)
def _type_of_field(context):
    def typer(stage, field):
        known = _class_of(stage) in _FACTS and isinstance(field, types.IntegerLiteral)
        return with_aligned_records(stage_type()[field.literal_value]) if known else None

    return typer


@lower_builtin(read, types.BaseNamedTuple, types.IntegerLiteral)
def _load(context, builder, signature, arguments):
    stage, field = signature.args
    (address,) = cgutils.unpack_tuple(builder, arguments[0])
    pointer = builder.inttoptr(address, context.get_data_type(stage_type()).as_pointer())
    kind, there = signature.return_type, cgutils.gep_inbounds(builder, pointer, 0, field.literal_value)
    value = unowned(context, builder, kind, there)
    for which, name, number in _FACTS[stage.instance_class]:
        if which == field.literal_value:
            place = kind.fields.index(name)
            value = builder.insert_value(value, context.get_constant(kind[place], number), place)
    return value


def column(numbers: Any) -> Any:
    """Numbers (R,) as a matrix (R, 1) of the same memory, in kernels."""
    return numbers.reshape(-1, 1)


@type_callable(column)
def _type_of_column(context):
    return lambda numbers: types.Array(numbers.dtype, 2, "C") if isinstance(numbers, types.Array) else None


@lower_builtin(column, types.Array)
def _stand(context, builder, signature, arguments):
    flat = context.make_array(signature.args[0])(context, builder, arguments[0])
    array = context.make_array(signature.return_type)(context, builder)
    one, size = context.get_constant(types.intp, 1), context.get_constant(types.intp, 8)
    (rows,) = cgutils.unpack_tuple(builder, flat.shape)
    array.shape, array.strides = cgutils.pack_array(builder, [rows, one]), cgutils.pack_array(builder, [size, size])
    array.data, array.nitems, array.itemsize, array.parent = flat.data, rows, size, flat.parent
    array.meminfo = cgutils.get_null_value(array.meminfo.type)
    return array._getvalue()
