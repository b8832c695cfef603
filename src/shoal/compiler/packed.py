"""NamedTuples in memory that is elsewhere, such as a graphics card's: packed here, read there by kernels.

The layout is that of compiler/placed.py; only arrays are where the caller says.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import typeof, types
from numba.extending import lower_builtin, type_callable

from shoal.compiler.kernel import compiles
from shoal.compiler.placed import layout, put, size_of, unowned

_anything: Any = types.Any  # numba has no types that mypy sees
Where = Callable[[Any], int]  # the address of an array's first element, there


def packed(value: Any, where: Where) -> Any:
    """A NamedTuple as bytes; of its arrays, the form, and the address that `where` says."""
    kind = typeof(value)
    room = np.zeros(size_of(kind), np.uint8)
    put(value, layout(kind), room, where)
    return room


def reader(value: Any) -> Callable[[Any], Any]:
    """A function for kernels that reads a NamedTuple of the type of this one at an address."""

    def read(address):
        """What is there; without a compiler, the value stands for its address."""
        return address

    if compiles():
        kind = typeof(value)

        @type_callable(read)
        def type_of_read(context):
            return lambda address: kind

        @lower_builtin(read, _anything)
        def load(context, builder, signature, arguments):
            pointer = builder.inttoptr(arguments[0], context.get_data_type(kind).as_pointer())
            return unowned(context, builder, kind, pointer)

    return read
