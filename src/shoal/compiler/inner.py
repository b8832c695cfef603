"""The dispatcher of kernels that only kernels call."""

from typing import Any

import numba
from numba.core.registry import CPUDispatcher

# error_model="numpy": the check for division by zero would stop vectorization (2-3x slower). No fastmath: results
# would depend on the processor. nogil: one thread per run scales to all cores.
FLAGS: dict[str, Any] = {"error_model": "numpy", "nogil": True}

# forceinline: 12 % faster than LLVM's own choice. No wrappers: only Python needs them, and they are a third of all
# compile time, because every wrapper optimizes its kernel once more.
INNER_FLAGS = {**FLAGS, "forceinline": True, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


_typeof: Any = numba.typeof


class Inner(CPUDispatcher):
    """A kernel without wrappers; called from Python, it compiles a twin that has them.

    Objects that numba does not know, such as those that a test of a strategy makes up, are met in plain Python.
    """

    def __call__(self, *arguments: Any) -> Any:
        """Run the twin."""
        try:
            for argument in arguments:
                _typeof(argument)
        except ValueError:
            return self.py_func(*arguments)
        if not hasattr(self, "twin"):
            self.twin = numba.njit(self.py_func, **FLAGS)
        return self.twin(*arguments)
