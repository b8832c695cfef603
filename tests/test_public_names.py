"""import shoal gives what it says, whatever was imported before."""

import subprocess
import sys

import pytest

import shoal


@pytest.mark.parametrize("name", shoal.__all__)
def test_every_public_name_is_there(name):
    assert getattr(shoal, name) is not None


def test_a_name_that_is_not_there_is_answered_with_those_that_are():
    with pytest.raises(AttributeError, match=r"it has: .*simulate"):
        shoal.simulator  # noqa: B018


def test_simulate_is_a_function_after_every_module_was_imported():
    script = (
        "import importlib, pkgutil, shoal\n"
        "for module in pkgutil.walk_packages(shoal.__path__, 'shoal.'):\n"
        "    if '__main__' not in module.name: importlib.import_module(module.name)\n"
        "names = [name for name in shoal.__all__ if name[0].islower() and name != 'plot']\n"
        "assert all(callable(getattr(shoal, name)) for name in names)"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


def test_plot_is_there_at_first_use_and_matplotlib_at_the_first_figure():
    script = (
        "import sys, shoal\n"
        "assert 'shoal.plot' not in sys.modules\n"
        "assert callable(shoal.plot.snapshot)\n"
        "assert 'matplotlib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)
