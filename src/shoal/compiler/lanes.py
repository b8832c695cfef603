"""Lanes: WIDTH agents side by side in a vector register, which a kernel handles as if they were one number.

    for i in range(0, lanes, WIDTH):
        limit = take(reach, i, everywhere(0.0))          WIDTH numbers of an array, from i on
        near = take(square, (j, i), limit) <= limit      a mask
        heard = either(near, heard + 1.0, heard)
        put(count, i, heard)

`take` takes as much as its last argument is, so that a kernel serves one agent as well as many, and in single precision
as well as in double. What is computed has the bits that it has one by one. LLVM makes vector code of loops over lanes,
too, but keeps their sums in memory, which costs as much as the arithmetic. What numba makes of these functions is in
vectors.py; without it lanes are small arrays of numpy. A branch cannot ask for a mask: functions with one do not
compile for lanes (see engine/arrivals.py).
"""

from importlib import import_module
from struct import Struct
from typing import Any

import numpy as np

from shoal.compiler.late import when_loaded

WIDTH = 8  # doubles of an AVX-512 register; LLVM splits them where registers are smaller


_DOUBLE, _WHOLE = Struct("=d"), Struct("=q")
SMALLEST_SINGLE, LARGEST_SINGLE = 2.0**-126, 3.4e38
FARTHEST = {"float64": 1e300, "float32": 1e38}
ALMOST_ONE = {"float64": 1.0 - 2.0**-52, "float32": 1.0 - 2.0**-23}


def everywhere(number: Any) -> Any:
    """The same number in all lanes."""
    return np.full(WIDTH, number)


def farthest(like: Any) -> Any:
    """A number that is finite, and larger than any square of a distance [m^2], as precise as `like`."""
    return np.full_like(like, FARTHEST[precision_of(np.asarray(like).dtype)])


def almost_one(like: Any) -> Any:
    """The largest number below 1 but one, as precise as `like`."""
    return np.full_like(like, ALMOST_ONE[precision_of(np.asarray(like).dtype)])


def precision_of(kind: Any) -> str:
    """Of a type of numbers or of lanes of them, NumPy's or numba's: float32, or float64 whatever else it is."""
    return "float32" if "float32" in (str(kind), str(getattr(kind, "kind", ""))) else "float64"


def narrow(number: Any) -> Any:
    """A number, or lanes, in single precision."""
    return number.astype(np.float32) if isinstance(number, np.ndarray) else np.float32(number)


def wide(number: Any) -> Any:
    """A number, or lanes, in double precision."""
    return number.astype(np.float64) if isinstance(number, np.ndarray) else float(number)


def counting(first: int) -> Any:
    """first, first + 1, ..."""
    return np.arange(first, first + WIDTH)


def take(array: Any, at: Any, like: Any) -> Any:
    """As many entries of an array from `at` on, an index or a pair of them, as `like` has."""
    if not isinstance(like, np.ndarray):
        return array[at]
    row, first = (array[at[0]], at[1]) if isinstance(at, tuple) else (array, at)
    taken = row[first : first + WIDTH].copy()
    return taken.astype(like.dtype) if {taken.dtype.kind, like.dtype.kind} == {"f"} else taken


def put(array: Any, at: Any, values: Any) -> None:
    """Write values into an array from `at` on, an index or a pair of them."""
    if not isinstance(values, np.ndarray):
        array[at] = values
        return
    row, first = (array[at[0]], at[1]) if isinstance(at, tuple) else (array, at)
    row[first : first + WIDTH] = values


def either(mask: Any, a: Any, b: Any) -> Any:
    """`a` where the mask is true, else `b`; both are evaluated."""
    return np.where(mask, a, b) if isinstance(mask, np.ndarray) else a if mask else b


def smaller(a: Any, b: Any) -> Any:
    """The smaller one in each lane, `a` where they are equal or one is NaN: Python's min."""
    return either(b < a, b, a)


def larger(a: Any, b: Any) -> Any:
    """The larger one in each lane: Python's max."""
    return either(b > a, b, a)


def bits_of(number: Any) -> Any:
    """The 64 bits of a number, as a whole one."""
    return _WHOLE.unpack(_DOUBLE.pack(number))[0]


def number_of(bits: Any) -> Any:
    """The number of 64 bits."""
    return _DOUBLE.unpack(_WHOLE.pack(bits))[0]


def gather(array: Any, at: Any, like: Any) -> Any:
    """The entries of an array at the indices that lanes are; numbers as precise as `like`."""
    return array[at].astype(like.dtype) if array.dtype.kind == "f" else array[at]


def truths(mask: Any) -> Any:
    """A mask as a whole number, a bit per lane."""
    return int(np.dot(mask, 1 << np.arange(WIDTH)))


def mask_of(word: Any) -> Any:
    """The mask of a whole number."""
    return (word >> np.arange(WIDTH)) & 1 != 0


def any_of(mask: Any) -> Any:
    """Whether it is true anywhere."""
    return np.any(mask)


def _say(numba: Any) -> None:
    import_module("shoal.compiler.vectors")


when_loaded(_say)
