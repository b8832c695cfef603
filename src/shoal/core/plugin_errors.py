"""What goes wrong as the kernels of an installed package are compiled, as one error that names the package."""

from collections.abc import Iterator
from contextlib import contextmanager

from shoal.compiler.installed import offers, package_in, package_of
from shoal.compiler.late import compiler_errors
from shoal.compiler.reason import reason_in
from shoal.core.errors import PluginError


@contextmanager
def plugin_errors() -> Iterator[None]:
    """Turn what the compiler says of a package's metric, target or disturbance into one error.

    Raises
    ------
    PluginError : it cannot be compiled; nothing can run then, for the engine is compiled with it
    """
    try:
        yield
    except compiler_errors() as error:
        package = package_in(str(error)) or _any_package()
        if not package:
            raise
        raise _uncompiled(package, reason_in(str(error))) from error
    except KeyError as error:  # numba looked for a field of a record, and says nothing else
        if not (package := _any_package()):
            raise
        raise _uncompiled(package, f"{error.args[0]!r} is not a field of a record") from error


def _any_package() -> str:
    """All packages that offer something, where numba does not say whose kernel it was; empty if there is none."""
    return " or ".join(dict.fromkeys(package_of(entry) for entries in offers().values() for entry in entries))


def _uncompiled(package: str, reason: str) -> PluginError:
    return PluginError(package, f"a kernel of it cannot be compiled: {reason}", "fix or uninstall it")
