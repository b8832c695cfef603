"""While numba compiles, Python looks for garbage rarely; afterwards as before."""

import gc

import pytest

from shoal.compiler.garbage import RARELY, look_as_before, look_rarely


@pytest.fixture(autouse=True)
def thresholds():
    """Those of now are there afterwards."""
    before = gc.get_threshold()
    yield
    gc.set_threshold(*before)


def test_while_somebody_compiles_it_is_looked_for_rarely():
    gc.set_threshold(700, 10, 10)
    look_rarely()
    look_rarely()  # another thread, or a kernel in a kernel
    assert gc.get_threshold() == RARELY
    look_as_before()
    assert gc.get_threshold() == RARELY
    look_as_before()
    assert gc.get_threshold() == (700, 10, 10)


def test_who_never_looks_or_more_rarely_is_left_alone():
    for own in [(0, 10, 10), (1_000_000, 100, 2000)]:
        gc.set_threshold(*own)
        look_rarely()
        assert gc.get_threshold() == own
        look_as_before()
        assert gc.get_threshold() == own


def test_an_end_without_a_beginning_changes_nothing():
    """Another thread compiled already when numba was first listened to."""
    gc.set_threshold(700, 10, 10)
    look_as_before()
    assert gc.get_threshold() == (700, 10, 10)


def test_numba_says_when_it_compiles():
    numba = pytest.importorskip("numba")
    from shoal.compiler.late import compiles, load

    if not compiles():
        pytest.skip("nothing is compiled")
    load()
    seen = []

    @numba.extending.overload(test_numba_says_when_it_compiles)
    def typed():
        seen.append(gc.get_threshold())
        return lambda: 1

    gc.set_threshold(700, 10, 10)
    assert numba.njit(lambda: test_numba_says_when_it_compiles())() == 1
    assert seen == [RARELY]
    assert gc.get_threshold() == (700, 10, 10)
