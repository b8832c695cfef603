"""What numba makes of lanes (lanes.py): values of LLVM's vector types, with the operators of numbers.

Operators are taught to numba by their types and their code, not as functions in Python, which it would compile one by
one for every kind of arguments.
"""

import math
import operator
from collections.abc import Callable
from functools import partial
from itertools import product
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.errors import TypingError
from numba.core.imputils import lower_builtin
from numba.core.typing.templates import AbstractTemplate, infer_global, signature
from numba.extending import models, register_model

from shoal.compiler.lanes import (
    ALMOST_ONE,
    FARTHEST,
    LARGEST_SINGLE,
    SMALLEST_SINGLE,
    WIDTH,
    almost_one,
    any_of,
    bits_of,
    counting,
    either,
    everywhere,
    farthest,
    gather,
    larger,
    mask_of,
    narrow,
    number_of,
    precision_of,
    put,
    smaller,
    take,
    truths,
    wide,
)

_TYPE: Any = types.Type  # numba has no types that mypy sees
_MODEL: Any = models.PrimitiveModel
_TEMPLATE: Any = AbstractTemplate
_learn: Any = infer_global
_signature: Any = signature
_utilities: Any = cgutils
_TUPLE: Any = types.BaseTuple
_code_of: Any = lower_builtin
_model_of: Any = register_model


class Lanes(_TYPE):  # type: ignore[misc]
    """WIDTH numbers, or truths, of a kind."""

    def __init__(self, kind: Any, element: Any) -> None:
        self.kind = kind
        self.vector = ir.VectorType(element, WIDTH)
        super().__init__(name=f"Lanes({kind})")

    @property
    def key(self) -> Any:
        """What makes two of them the same."""
        return self.kind


FLOATS = Lanes(types.float64, ir.DoubleType())
SINGLES = Lanes(types.float32, ir.FloatType())
WHOLE = Lanes(types.int64, ir.IntType(64))
MASK = Lanes(types.boolean, ir.IntType(1))
_SIZES = {
    types.float64: 8,
    types.float32: 4,
    types.int64: 8,
    types.int32: 4,
    types.boolean: 1,
}  # in bytes: of what lanes are made of


@_model_of(Lanes)
class _Vector(_MODEL):  # type: ignore[misc]
    def __init__(self, manager: Any, lanes: Lanes) -> None:
        super().__init__(manager, lanes, lanes.vector)


def _common(*kinds: Any) -> Lanes:
    """The lanes that numbers of these kinds become together: a number beside lanes in single precision is rounded."""
    lanes = [each for each in kinds if each in (FLOATS, SINGLES)]
    inner = [getattr(each, "kind", each) for each in lanes or kinds]
    if types.float64 in inner:
        return FLOATS
    return SINGLES if types.float32 in inner else WHOLE


def _are_numbers(*kinds: Any) -> bool:
    """Whether these are lanes, or lanes and numbers."""
    numbers = (Lanes, types.Float, types.Integer, types.Boolean)
    return any(isinstance(each, Lanes) for each in kinds) and all(isinstance(each, numbers) for each in kinds)


def _widened(context: Any, builder: Any, value: Any, kind: Any, to: Lanes) -> Any:
    """A number, or lanes of another kind, as lanes."""
    if not isinstance(kind, Lanes):
        if to is SINGLES and isinstance(value, ir.Constant):
            value = ir.Constant(value.type, _in_range(value.constant))
        return _spread(builder, context.cast(builder, value, kind, to.kind), to)
    if kind is to:
        return value
    if kind is MASK:
        return builder.zext(value, to.vector) if to is WHOLE else builder.uitofp(value, to.vector)
    if kind is WHOLE:
        return builder.sitofp(value, to.vector)
    if to is WHOLE:
        return builder.fptosi(value, to.vector)
    return builder.fptrunc(value, to.vector) if to is SINGLES else builder.fpext(value, to.vector)


def _in_range(number: Any) -> Any:
    """A constant as single precision has it: what keeps a division from zero is not zero, and no bound infinite."""
    size = abs(number)
    if not 0.0 < size < math.inf or SMALLEST_SINGLE <= size <= LARGEST_SINGLE:
        return number
    return math.copysign(min(max(size, SMALLEST_SINGLE), LARGEST_SINGLE), number)


def _spread(builder: Any, scalar: Any, to: Lanes) -> Any:
    word = ir.IntType(32)
    one = builder.insert_element(ir.Constant(to.vector, ir.Undefined), scalar, word(0))
    return builder.shuffle_vector(one, one, ir.Constant(ir.VectorType(word, WIDTH), [0] * WIDTH))


def _teach(function: Any, kind_of: Callable[..., Any], code: Callable[..., Any], *counts: int) -> None:
    """Teach numba a function of lanes.

    Parameters
    ----------
    function : as kernels name it
    kind_of : the type of what it returns by those of its arguments; None where it is not for these
    code : makes LLVM's code, of (context, builder, types of arguments, arguments, type of the result)
    counts : how many arguments it takes
    """

    class Template(_TEMPLATE):  # type: ignore[misc]
        def generic(self, arguments: Any, keywords: Any) -> Any:
            """The signature for these arguments."""
            result = kind_of(*arguments) if len(arguments) in counts and not keywords else None
            return None if result is None else _signature(result, *arguments)

    def write(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return code(context, builder, signature.args, arguments, signature.return_type)

    _learn(function)(Template)
    for count in counts:
        for kinds in product((types.Any, Lanes), repeat=count):
            if Lanes in kinds or function not in _SHARED:  # with numbers, whose code is numba's
                _code_of(function, *kinds)(write)


_OPERATORS = ("add", "sub", "mul", "truediv", "rshift", "lt", "le", "gt", "ge", "eq", "ne", "and_", "or_", "pow", "neg")
_SHARED = {*(getattr(operator, name) for name in _OPERATORS), max, min, abs, math.sqrt}


def _binary(symbol: Any, build: Callable[..., Any], result: Lanes | None = None, floats: bool = False) -> None:
    """Teach a binary operator, which `build` makes of (builder, x, y, their lanes)."""

    def kind_of(a: Any, b: Any) -> Any:
        if not _are_numbers(a, b):
            return None
        common = _common(a, b)
        return result or (FLOATS if floats and common is WHOLE else common)

    def code(context: Any, builder: Any, kinds: Any, arguments: Any, _: Any) -> Any:
        common = _common(*kinds)
        to = FLOATS if floats and common is WHOLE else common
        x, y = (_widened(context, builder, *each, to) for each in zip(arguments, kinds, strict=True))
        return build(builder, x, y, to)

    _teach(symbol, kind_of, code, 2)


_binary(operator.add, lambda builder, x, y, to: (builder.add if to is WHOLE else builder.fadd)(x, y))
_binary(operator.sub, lambda builder, x, y, to: (builder.sub if to is WHOLE else builder.fsub)(x, y))
_binary(operator.mul, lambda builder, x, y, to: (builder.mul if to is WHOLE else builder.fmul)(x, y))
_binary(operator.truediv, lambda builder, x, y, to: builder.fdiv(x, y), floats=True)


_binary(operator.rshift, lambda builder, x, y, to: builder.ashr(x, y))  # of whole numbers


def _compared(sign: str, builder: Any, x: Any, y: Any, to: Lanes) -> Any:
    if to is WHOLE:
        return builder.icmp_signed(sign, x, y)
    return builder.fcmp_unordered(sign, x, y) if sign == "!=" else builder.fcmp_ordered(sign, x, y)


def _extreme(sign: str, builder: Any, a: Any, b: Any, to: Lanes) -> Any:
    """As Python does: the first where they are equal, or one is NaN."""
    return builder.select(_compared(sign, builder, b, a, to), b, a)


for _name, _sign in {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "ne": "!="}.items():
    _binary(getattr(operator, _name), partial(_compared, _sign), MASK)

for _function, _sign in {max: ">", min: "<"}.items():
    _binary(_function, partial(_extreme, _sign))


def _logic(symbol: Any, method: str) -> None:
    def kind_of(a: Any, b: Any) -> Any:
        truths = all(each is MASK or isinstance(each, types.Boolean) for each in (a, b))
        return MASK if truths and MASK in (a, b) else None

    def code(context: Any, builder: Any, kinds: Any, arguments: Any, _: Any) -> Any:
        both = zip(arguments, kinds, strict=True)
        return getattr(builder, method)(
            *(each if kind is MASK else _spread(builder, each, MASK) for each, kind in both)
        )

    _teach(symbol, kind_of, code, 2)


_logic(operator.and_, "and_")
_logic(operator.or_, "or_")


def _of_llvm(function: Any, name: str, count: int, taken: Callable[..., bool]) -> None:
    """Teach a function of numbers that LLVM has for vectors; of whole ones it is of doubles."""

    def kind_of(*kinds: Any) -> Any:
        return (SINGLES if _common(*kinds) is SINGLES else FLOATS) if taken(*kinds) else None

    def code(context: Any, builder: Any, kinds: Any, arguments: Any, to: Any) -> Any:
        lanes = [_widened(context, builder, *each, to) for each in zip(arguments, kinds, strict=True)]
        kind = ir.FunctionType(to.vector, [to.vector] * count)
        full = f"llvm.{name}.v{WIDTH}f{to.kind.bitwidth}"
        return builder.call(_utilities.get_or_insert_function(builder.module, kind, full), lanes)

    _teach(function, kind_of, code, count)


_of_llvm(math.sqrt, "sqrt", 1, lambda x: x in (FLOATS, SINGLES, WHOLE))
_of_llvm(abs, "fabs", 1, lambda x: x in (FLOATS, SINGLES))
_of_llvm(operator.pow, "pow", 2, lambda x, y: isinstance(x, Lanes) and isinstance(y, types.Float))  # whole: not by pow


def _negated(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    return builder.neg(arguments[0]) if result is WHOLE else builder.fneg(arguments[0])


_teach(operator.neg, lambda x: x if x in (FLOATS, SINGLES, WHOLE) else None, _negated, 1)


def _kind_of_either(mask: Any, a: Any, b: Any) -> Any:
    if mask is MASK or _are_numbers(a, b):
        return _common(a, b)
    return _common(a, b).kind


def _picked(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    values = zip(arguments[1:], kinds[1:], strict=True)
    if not isinstance(result, Lanes):
        return builder.select(arguments[0], *(context.cast(builder, *each, result) for each in values))
    return builder.select(arguments[0], *(_widened(context, builder, *each, result) for each in values))


def _as_word(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    return builder.zext(builder.bitcast(arguments[0], ir.IntType(WIDTH)), ir.IntType(64))


def _as_mask(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    word = context.cast(builder, arguments[0], kinds[0], types.int64)
    return builder.bitcast(builder.trunc(word, ir.IntType(WIDTH)), MASK.vector)


def _is_any(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    if kinds[0] is not MASK:
        return arguments[0]
    word = ir.IntType(WIDTH)
    return builder.icmp_unsigned("!=", builder.bitcast(arguments[0], word), word(0))


def _everywhere(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    return _widened(context, builder, arguments[0], kinds[0], result)


def _counted(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    first = _widened(context, builder, arguments[0], kinds[0], WHOLE)
    return builder.add(first, ir.Constant(WHOLE.vector, list(range(WIDTH))))


def _as_bits(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    return builder.bitcast(arguments[0], context.get_value_type(result))


_teach(bits_of, lambda x: None if x is SINGLES else WHOLE if x is FLOATS else types.int64, _as_bits, 1)
_teach(number_of, lambda x: FLOATS if x is WHOLE else types.float64, _as_bits, 1)


def _extreme_of(sign: str) -> Callable[..., Any]:
    """`smaller` and `larger` of lanes, and of numbers, which become lanes for it and are one again."""

    def code(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
        to = _common(*kinds)
        a, b = (_widened(context, builder, *each, to) for each in zip(arguments, kinds, strict=True))
        chosen = _extreme(sign, builder, a, b, to)
        return chosen if result is to else builder.extract_element(chosen, ir.IntType(32)(0))

    return code


def _kind_of_extreme(a: Any, b: Any) -> Any:
    return _common(a, b) if _are_numbers(a, b) else _common(a, b).kind


def _constant_of(numbers: dict[str, float]) -> Callable[..., Any]:
    """A number that depends on the precision."""

    def code(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
        number = context.get_constant(getattr(result, "kind", result), numbers[precision_of(result)])
        return _spread(builder, number, result) if isinstance(result, Lanes) else number

    return code


def _as_precise(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    if isinstance(result, Lanes):
        return _widened(context, builder, arguments[0], kinds[0], result)
    return context.cast(builder, arguments[0], kinds[0], result)


_teach(narrow, lambda x: SINGLES if isinstance(x, Lanes) else types.float32, _as_precise, 1)
_teach(wide, lambda x: FLOATS if isinstance(x, Lanes) else types.float64, _as_precise, 1)
_teach(farthest, lambda like: like, _constant_of(FARTHEST), 1)
_teach(almost_one, lambda like: like, _constant_of(ALMOST_ONE), 1)
_teach(smaller, _kind_of_extreme, _extreme_of("<"), 2)
_teach(larger, _kind_of_extreme, _extreme_of(">"), 2)
_teach(either, _kind_of_either, _picked, 3)
_teach(truths, lambda mask: types.int64 if mask is MASK else None, _as_word, 1)
_teach(mask_of, lambda word: MASK, _as_mask, 1)
_teach(any_of, lambda mask: types.boolean, _is_any, 1)
_teach(everywhere, lambda number: _common(number), _everywhere, 1)
_teach(counting, lambda first: WHOLE, _counted, 1)


def _kind_of_take(array: Any, at: Any, like: Any) -> Any:
    _check(array)
    if not isinstance(like, Lanes):
        return array.dtype
    if array.dtype is types.boolean:
        return MASK
    return like if isinstance(array.dtype, types.Float) and like in (FLOATS, SINGLES) else _common(array.dtype)


def _taken(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    array, at, like = kinds
    where = _pointer(context, builder, array, at, arguments)
    if not isinstance(like, Lanes):
        return context.unpack_value(builder, array.dtype, where)
    block = ir.VectorType(where.type.pointee, WIDTH)
    loaded = builder.load(builder.bitcast(where, block.as_pointer()))
    loaded.align = _SIZES[array.dtype]
    if result is MASK:
        return builder.icmp_unsigned("!=", loaded, ir.Constant(block, [0] * WIDTH))
    if array.dtype is types.int32:
        return builder.sext(loaded, result.vector)
    return _widened(context, builder, loaded, _common(array.dtype), result)


def _gathered(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    array = kinds[0]
    held = context.make_array(array)(context, builder, arguments[0])
    lanes = ir.Constant(result.vector, ir.Undefined)
    for lane in map(ir.IntType(32), range(WIDTH)):
        entry = builder.gep(held.data, [builder.extract_element(arguments[1], lane)])
        value = context.cast(builder, context.unpack_value(builder, array.dtype, entry), array.dtype, result.kind)
        lanes = builder.insert_element(lanes, value, lane)
    return lanes


def _put(context: Any, builder: Any, kinds: Any, arguments: Any, result: Any) -> Any:
    array, at, values = kinds
    where = _pointer(context, builder, array, at, arguments)
    if isinstance(values, Lanes):
        written = _widened(context, builder, arguments[2], values, _common(array.dtype))
        where = builder.bitcast(where, written.type.as_pointer())
        builder.store(written, where).align = _SIZES[array.dtype]
    else:
        context.pack_value(builder, array.dtype, context.cast(builder, arguments[2], values, array.dtype), where)
    return context.get_dummy_value()


def _check(array: Any) -> Any:
    if array.layout != "C" or array.ndim > 2 or array.dtype not in _SIZES:
        raise TypingError(f"lanes are not taken of {array}")
    return types.void


def _pointer(context: Any, builder: Any, array: Any, at: Any, arguments: Any) -> Any:
    """Where an array has the entry `at`, an index or a pair of them."""
    held = context.make_array(array)(context, builder, arguments[0])
    if not isinstance(at, _TUPLE):
        return builder.gep(held.data, [context.cast(builder, arguments[1], at, types.intp)])
    row, first = (
        context.cast(builder, builder.extract_value(arguments[1], n), kind, types.intp) for n, kind in enumerate(at)
    )
    columns = _utilities.unpack_tuple(builder, held.shape)[1]
    return builder.gep(held.data, [builder.add(first, builder.mul(row, columns))])


_teach(take, _kind_of_take, _taken, 3)
_teach(gather, _kind_of_take, _gathered, 3)
_teach(put, lambda array, at, values: _check(array), _put, 3)
