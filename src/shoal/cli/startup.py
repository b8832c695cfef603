"""What the command line does to start sooner."""

import sys


def load_compiler() -> None:
    """Import numba without scipy.linalg, which it looks for to compile matrix products; no kernel has one.

    That is a quarter of a second of every run. It is done to our own process only, never by the library.
    """
    wanted = "scipy.linalg.cython_blas"
    if wanted in sys.modules or "numba" in sys.modules:
        return
    sys.modules[wanted] = None  # type: ignore[assignment]  # Python's way to say: not there
    try:
        import numba.np.arraymath  # noqa: F401
    finally:
        del sys.modules[wanted]
