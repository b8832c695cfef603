"""References to arrays in parts that are lent are given back when a kernel was called from Python."""

import sys
from typing import NamedTuple

import numba
import numpy as np
import pytest

from shoal.compiler.borrowed import lend
from shoal.compiler.late import compiles

pytestmark = pytest.mark.skipif(not compiles(), reason="without a compiler nothing is counted")


class Lent(NamedTuple):
    """A part of a stage, and one in it."""

    x: object
    inner: object = 0


class Own(NamedTuple):
    """Any other."""

    x: object
    inner: object = 0


lend(Lent)


@numba.njit
def first(part):
    """Read, through a name and a view."""
    again = part
    return again.x[1:][0]


@pytest.mark.parametrize("kinds", [(Lent, Lent), (Own, Lent), (Lent, Own), (Own, Own)])
def test_a_call_leaves_none(kinds):
    x, y = np.arange(3.0), np.arange(3.0)
    outer, inner = kinds
    before = sys.getrefcount(x), sys.getrefcount(y)
    for _ in range(5):
        assert first(outer(x, inner(y))) == 1.0
    assert (sys.getrefcount(x), sys.getrefcount(y)) == before
