"""Lanes of kernels compute what plain Python does with one number after the other, to the bit."""

import math

import numpy as np
import pytest

from shoal.compiler.kernel import can_compile, entry_kernel, kernel
from shoal.compiler.lanes import (
    WIDTH,
    any_of,
    bits_of,
    counting,
    either,
    everywhere,
    gather,
    larger,
    mask_of,
    number_of,
    put,
    smaller,
    take,
    truths,
)
from shoal.compiler.late import load

RANDOM = np.random.default_rng(12)
ODD = [0.0, -0.0, 1.0, -1.0, np.inf, -np.inf, np.nan, 5e-324]
A = np.array([*ODD, *RANDOM.normal(size=WIDTH)])
B = np.array([*RANDOM.normal(size=WIDTH), *ODD])


@kernel
def one(a, b, k):
    """Of two numbers and a whole one."""
    c = (a + b) * 2.0 - a / (b + 3.0) + math.sqrt(abs(a)) - (-b)
    d = max(a, b) - min(a, 0.5) + (a < b) * 3.0 + (-k)
    return either((a <= b) & (k > 1) | (a != a), c, d) + (k + 1) * 0.5 + 2 / (k + 0.5) + number_of(bits_of(a) >> 1)


@entry_kernel
def by_lanes(a, b, k, out):
    for i in range(0, a.size, WIDTH):
        none = everywhere(0.0)
        put(out, i, one(take(a, i, none), take(b, i, none), take(k, i, none)))


@entry_kernel
def one_by_one(a, b, k, out):
    for i in range(a.size):
        put(out, i, one(take(a, i, 0.0), take(b, i, 0.0), take(k, i, 0)))


def test_are_as_good_as_numbers():
    k = RANDOM.integers(-3, 4, A.size)
    together, apart = np.empty(A.size), np.empty(A.size)
    by_lanes(A, B, k, together)
    one_by_one(A, B, k, apart)
    assert together.tobytes() == apart.tobytes()
    with np.errstate(all="ignore"):
        plain = [one.py_func(a, b, i) for a, b, i in zip(A, B, k.tolist(), strict=True)]
    assert np.array_equal(together, plain, equal_nan=True)


@entry_kernel
def handle(rows, flags, at, words, out):
    none = everywhere(0.0)
    row = take(rows, (1, 2), none)
    mask = take(flags, 1, none)
    out[0] = truths(mask)
    out[1] = truths(mask_of(words[0]) & (counting(3) > 4))
    out[2] = 1 if any_of(mask_of(words[1])) else 0
    put(rows, (0, 1), either(mask, gather(rows[2], take(at, 0, none), none), smaller(row, larger(4.0, none))))
    put(out, 3, row + 0.75)


@pytest.mark.parametrize("compiled", [True, False])
def test_are_taken_put_gathered_and_asked(compiled):
    rows = np.arange(3 * 12, dtype=float).reshape(3, 12)
    flags = np.array([0, 1, 0, 1, 1, 0, 0, 1, 1], bool)
    at = np.array([7, 6, 5, 4, 3, 2, 1, 0], np.int32)
    words, out = np.array([0b10101010, 0], np.uint8), np.zeros(3 + WIDTH, np.int64)
    (handle if compiled else handle.py_func)(rows, flags, at, words, out)
    assert out[:3].tolist() == [0b11001101, 0b10101000, 0]
    assert out[3:].tolist() == [14, 15, 16, 17, 18, 19, 20, 21]  # whole numbers, toward zero
    assert rows[0].tolist() == [0, 31, 4, 29, 28, 4, 4, 25, 24, 9, 10, 11]


@kernel
def branches(a):
    return 1.0 if a > 0.0 else 2.0


@kernel
def chooses(a):
    return either(a > 0.0, 1.0, 2.0)


def test_a_branch_cannot_ask_for_a_mask():
    load()
    from shoal.compiler.vectors import FLOATS

    assert can_compile(chooses, FLOATS)
    assert not can_compile(branches, FLOATS)
