"""Parts of a stage that kernels hand on whole, and without counting references to the arrays in them.

numba takes a NamedTuple apart into its numbers wherever a kernel is called, 350 of a swarm, and puts it together again
in the kernel: half of all code before kernels are inlined into each other. And it counts a reference to every array in
it, 50 of a swarm, and takes the pairs out again. What a stage points at is Python's for longer than any kernel runs
(placed.py); a kernel must make such a NamedTuple of nothing else, nor return one to Python.
"""

from typing import Any

from numba import types
from numba.core.boxing import unbox_tuple
from numba.core.datamodel.models import TupleModel
from numba.core.datamodel.registry import default_manager
from numba.extending import NativeValue, unbox

_MODEL: Any = TupleModel  # numba has no types that mypy sees
_manager: Any = default_manager
_unbox: Any = unbox
_unboxed: Any = unbox_tuple
_value: Any = NativeValue
_lent: set[type[Any]] = set()


def lend(*classes: type[Any]) -> None:
    """Hand NamedTuples of these classes on whole, and count no references in them, from now on in this process.

    Parameters
    ----------
    classes : of parts of a stage, before a kernel is compiled that has them as arguments; those of which all fields are
        of one type stay as numba has them
    """
    _lent.update(classes)


class _Borrowed(_MODEL):  # type: ignore[misc]
    def traverse(self, builder: Any) -> list[Any]:
        return []  # nothing in it is counted


class _Whole(_Borrowed):
    def get_argument_type(self) -> Any:
        return self.get_value_type()

    def as_argument(self, builder: Any, value: Any) -> Any:
        return value

    def from_argument(self, builder: Any, value: Any) -> Any:
        return value


def _model(manager: Any, kind: Any) -> Any:
    if kind.instance_class not in _lent:
        return _MODEL(manager, kind)
    return (_Whole if manager is _manager else _Borrowed)(manager, kind)  # a card has a manager, and calls, of its own


_manager.register(types.NamedTuple, _model)


@_unbox(types.NamedTuple)  # type: ignore[untyped-decorator]
def _from_python(kind: Any, given: Any, context: Any) -> Any:
    """As numba does; but what Python's call took of a part that is lent, it gives back by itself."""
    native = _unboxed(kind, given, context)
    if not isinstance(context.context.data_model_manager[kind], _Borrowed):
        return native

    def cleanup() -> None:
        if native.cleanup is not None:
            native.cleanup()
        for place, each in enumerate(kind):
            context.context.nrt.decref(context.builder, each, context.builder.extract_value(native.value, place))

    return _value(native.value, is_error=native.is_error, cleanup=cleanup)
