"""Compile a kernel for other kernels only: typed and lowered, but neither optimized nor made into machine code.

Numba optimizes every function by itself and once more in each of its callers. An inner kernel is always inlined, so
all but the last time, in the entry kernel or phase, is lost: a third of a cold start (docs/decisions/0005-phases.md).
"""

from typing import Any

from numba._dynfunc import make_function
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder
from numba.core.compiler_machinery import register_pass
from numba.core.typed_passes import NativeLowering

_LIBRARY: Any = JITCodeLibrary
_LOWERING: Any = NativeLowering
_COMPILER: Any = CompilerBase
_PIPELINES: Any = DefaultPassBuilder
_register_pass: Any = register_pass  # numba has no types that mypy sees


class InlinedLibrary(_LIBRARY):  # type: ignore[misc]
    """The code of a kernel as its callers link it."""

    def _optimize_final_module(self) -> None:
        """Leave it to the callers."""

    def _finalize_final_module(self) -> None:
        """Nobody runs it: it is not handed to the engine that makes machine code."""
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True


@_register_pass(mutates_CFG=True, analysis_only=False)
class InlinedLowering(_LOWERING):  # type: ignore[misc]
    """Numba's lowering, into such a library."""

    _name = "inlined_lowering"

    def run_pass(self, state: Any) -> bool:
        """Lower, and let callers find the kernel under an object that stands for it."""
        state.library = InlinedLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
        state.library.enable_object_caching()
        state.flags.no_compile = True
        _LOWERING.run_pass(self, state)
        lowered = state.cr
        description = lowered.fndesc
        stand_in = make_function(
            description.lookup_module(), description.qualname, "", 0, lowered.env, (state.library,)
        )
        state.targetctx.insert_user_function(stand_in, description, [state.library])
        state.reload_init.extend(state.library._reload_init)
        state["cr"] = lowered._replace(cfunc=stand_in)
        return True


class InlinedCompiler(_COMPILER):  # type: ignore[misc]
    """Numba's own pipeline with that lowering."""

    def define_pipelines(self) -> list[Any]:
        """Return it."""
        pipeline = _PIPELINES.define_nopython_pipeline(self.state)
        pipeline.passes = [
            (InlinedLowering, what) if each is NativeLowering else (each, what) for each, what in pipeline.passes
        ]
        pipeline._finalized = False
        pipeline.finalize()
        return [pipeline]
