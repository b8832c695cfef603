"""The graphics card: whether there is one, what it is called, and how kernels are compiled for it."""

import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from shoal.compiler.late import Kernel, compiler_errors
from shoal.compiler.reason import reason_in
from shoal.core.errors import DeviceError, MissingExtraError

REGISTERS = 128  # of a thread: so many that 8 runs of up to 63 agents share a multiprocessor
SIMULATED = "a simulated card"


def card_name() -> str:
    """The name of the card that runs happen on.

    Raises
    ------
    MissingExtraError : numba-cuda is absent
    DeviceError : there is no card, or its driver does not answer
    """
    api = _cuda()
    if simulated():
        return SIMULATED
    try:
        api.current_context()
        name = api.get_current_device().name
    except Exception as failure:  # of many kinds: no driver, no card, one that is too old or busy
        problem = f"no graphics card answers: {_first_line(failure)}"
        raise DeviceError("--device cuda", problem, "see that nvidia-smi lists one, or leave --device out") from None
    return name.decode() if isinstance(name, bytes) else str(name)


def simulated() -> bool:
    """Whether numba simulates a card, with threads of Python: for tests."""
    return os.environ.get("NUMBA_ENABLE_CUDASIM") == "1"


def _cuda() -> Any:
    """Numba's module for cards; that of numba itself is the simulator alone, the other is a package of its own."""
    try:
        if not simulated():
            import numba_cuda  # noqa: F401  (numba.cuda is its own then)
        from numba import cuda
    except ImportError:
        raise MissingExtraError.of("numba-cuda", "gpu", "--device cuda") from None
    return cuda


def _first_line(failure: BaseException) -> str:
    text = str(failure).strip() or type(failure).__name__
    return text.splitlines()[0]


def compiled(function: Callable[..., Any]) -> Any:
    """A kernel of the card, compiled when it is launched first."""
    from numba import cuda

    jit: Any = cuda.jit
    if simulated():
        return jit(function)
    return jit(function, max_registers=REGISTERS, lto=False)  # linked as it is: a linker that optimizes fuses


def numbers(count: int) -> Any:
    """So many numbers on the card, whatever they are."""
    from numba import cuda

    api: Any = cuda
    return api.device_array(count)


def finish() -> None:
    """Wait for the card."""
    from numba import cuda

    api: Any = cuda
    api.synchronize()


@contextmanager
def as_on_the_cpu() -> Iterator[None]:
    """Compile the engine's kernels, without fused multiply-add, which rounds once where the processor rounds twice.

    Numba has no option for it; this hands NVVM its own. It then writes mul.rn and add.rn, which nothing later fuses.
    Kernels are stand-ins (compiler/late.py), which numba-cuda does not know: it is handed what they stand for. None of
    them counts from the end of an array, so that no index is asked whether it is negative: that would be a third of
    all instructions.

    Raises
    ------
    DeviceError : something cannot be compiled for a card
    """
    if simulated():
        yield
        return
    from numba import types
    from numba.cuda import target as typing
    from numba.cuda.cudadrv import nvvm as module
    from numba.cuda.np import arrayobj as indexing

    nvvm: Any = module
    arrays: Any = indexing
    context: Any = typing.CUDATypingContext
    compile_ir, resolve, fix_index = nvvm.compile_ir, context.resolve_value_type, arrays.fix_integer_index

    def without_fma(code: Any, **options: Any) -> Any:
        return compile_ir(code, **{**options, "fma": False})

    def resolve_kernels(self: Any, value: Any) -> Any:
        return resolve(self, value.dispatcher if isinstance(value, Kernel) else value)

    def keep_index(context: Any, builder: Any, kind: Any, index: Any, size: Any) -> Any:
        return context.cast(builder, index, kind, types.intp)

    nvvm.compile_ir, context.resolve_value_type, arrays.fix_integer_index = without_fma, resolve_kernels, keep_index
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of launches of few runs, which cannot fill a card
            yield
    except compiler_errors() as error:
        raise DeviceError(
            "--device cuda", f"cannot compile this: {reason_in(str(error))}", "leave --device out"
        ) from error
    finally:
        nvvm.compile_ir, context.resolve_value_type, arrays.fix_integer_index = compile_ir, resolve, fix_index
