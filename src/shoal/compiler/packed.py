"""NamedTuples in memory that is elsewhere, such as a graphics card's: packed here, read there by kernels.

The layout is that of compiler/placed.py; only arrays are where the caller says.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numba import typeof, types
from numba.extending import lower_builtin, type_callable

from shoal.compiler.known import with_aligned_records
from shoal.compiler.late import compiles
from shoal.compiler.placed import layout, put, size_of, unowned

_ADDRESS = 32  # bytes from the beginning of an array's structure to where it says where its numbers are
_anything: Any = types.Any  # numba has no types that mypy sees


class Parts(NamedTuple):
    """What a NamedTuple consists of, in the order of its fields: arrays, where they are, and numbers."""

    arrays: list[Any]
    addresses: list[int]
    numbers: list[Any]


class Form:
    """How NamedTuples of the type of a first one lie in memory.

    Attributes
    ----------
    size : bytes of each
    """

    def __init__(self, first: Any) -> None:
        kind = typeof(first)
        self.size = size_of(kind)
        self._places: list[int] = []  # of arrays
        self._numbers: list[int] = []  # and of numbers
        self._find(first, layout(kind))
        self._words = np.array(self._places, np.int64) + _ADDRESS
        self._model = np.zeros(self.size, np.uint8)
        self._shapes: list[tuple[int, ...]] = []

    def _find(self, value: Any, where: Any) -> None:
        if isinstance(value, tuple):
            for each, place in zip(value, where, strict=True):
                self._find(each, place)
        else:
            (self._places if isinstance(value, np.ndarray) else self._numbers).append(where)

    def parts(self, value: Any) -> Parts:
        """The parts of one."""
        found = Parts([], [], [])
        _take_apart(value, found)
        return found

    def packed(self, parts: Parts, addresses: Sequence[int]) -> Any:
        """One as bytes, with its arrays at these addresses."""
        shapes = [array.shape for array in parts.arrays]
        if shapes != self._shapes:
            for array, place in zip(parts.arrays, self._places, strict=True):
                put(array, place, self._model)
            self._shapes = shapes
        room = self._model.copy()
        for number, place in zip(parts.numbers, self._numbers, strict=True):
            put(number, place, room)
        words = np.array(addresses, np.int64).view(np.uint8).reshape(-1, 8)
        room[self._words[:, None] + np.arange(8)] = words
        return room


def _take_apart(value: Any, found: Parts) -> None:
    if isinstance(value, tuple):
        for each in value:
            _take_apart(each, found)
    elif isinstance(value, np.ndarray):
        found.arrays.append(value)
        found.addresses.append(value.ctypes.data)
    else:
        found.numbers.append(value)


def reader(value: Any) -> Callable[[Any], Any]:
    """A function for kernels that reads a NamedTuple of the type of this one at an address."""

    def read(address):
        """What is there; without a compiler, the value stands for its address."""
        return address

    if compiles():
        kind = with_aligned_records(typeof(value))

        @type_callable(read)
        def type_of_read(context):
            return lambda address: kind

        @lower_builtin(read, _anything)
        def load(context, builder, signature, arguments):
            pointer = builder.inttoptr(arguments[0], context.get_data_type(kind).as_pointer())
            return unowned(context, builder, kind, pointer)

    return read
