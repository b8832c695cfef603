"""numba comes when it is needed, and nobody waits for another thread's kernel."""

from threading import Event, Thread

import pytest

from shoal.compiler.kernel import kernel
from shoal.compiler.late import Kernel, compiles

pytestmark = pytest.mark.skipif(not compiles(), reason="without a compiler kernels are plain functions")


def test_a_kernel_is_made_once_and_knows_its_function():
    made = []

    def doubled(x):
        """Twice."""
        return 2 * x

    late = Kernel(doubled, lambda function: made.append(function) or function)
    assert (late.__name__, late.__doc__, late.py_func) == ("doubled", "Twice.", doubled)
    assert made == []
    assert late(4) == late(2) + 4 == 8
    assert made == [doubled]


def test_one_that_is_being_made_holds_up_no_other():
    """Threads that compile hold numba's lock, and ours: a lock of kernels beside them would be one too many."""
    begun, go_on = Event(), Event()

    def slowly(function):
        begun.set()
        assert go_on.wait(60.0)
        return function

    slow = Kernel(len, slowly)
    thread = Thread(target=lambda: slow("x"), daemon=True)
    thread.start()
    assert begun.wait(60.0)
    other = []
    second = Thread(target=lambda: other.append(Kernel(len, lambda function: function)("xy")), daemon=True)
    second.start()
    second.join(10.0)
    go_on.set()
    thread.join(60.0)
    assert other == [2]


def test_two_that_are_made_at_once_are_one():
    late = Kernel(len, lambda function: late.__dict__.setdefault("dispatcher", "of another thread"))
    assert late.dispatcher == "of another thread"


def test_what_is_no_kernel_s_is_none():
    with pytest.raises(AttributeError):
        kernel(lambda x: x)._no_such_thing  # noqa: B018
