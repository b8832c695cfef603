"""import shoal gives what it says, whatever was imported before."""

import inspect
import re
import subprocess
import sys

import pytest

import shoal


@pytest.mark.parametrize("name", shoal.__all__)
def test_every_public_name_is_there(name):
    assert getattr(shoal, name) is not None


def test_a_name_that_is_not_there_is_answered_with_those_that_are():
    with pytest.raises(AttributeError, match=r"there are: .*simulate"):
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
        "assert 'shoal.study.plot' not in sys.modules\n"
        "assert callable(shoal.plot.snapshot)\n"
        "assert 'matplotlib' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True)


class TestDiscovery:
    """Tab, dir and help show what there is, from the first moment."""

    def fresh(self, script):
        done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
        return done.stdout

    def test_dir_lists_the_public_names_and_nothing_else(self):
        assert self.fresh("import shoal; print(*dir(shoal))").split() == sorted(shoal.__all__)

    def test_dir_imports_nothing(self):
        heavy = "numba", "pydantic", "matplotlib"
        script = f"import shoal, sys; dir(shoal); print(*[name for name in {heavy} if name in sys.modules])"
        assert self.fresh(script).split() == []

    def test_help_describes_every_name(self):
        text = self.fresh("import pydoc, shoal; print(pydoc.render_doc(shoal, renderer=pydoc.plaintext))")
        for name in shoal.__all__:
            described = f"\n    {name}" in text or f"\n    class {name}(" in text
            assert described or name in ("plot", "__version__"), name  # a module; VERSION

    def test_the_docstring_names_every_name(self):
        missing = [name for name in shoal.__all__ if name not in shoal.__doc__ and name != "__version__"]
        assert missing == []

    @pytest.mark.parametrize(
        ("wrong", "meant"),
        [("metrics", "list_metrics"), ("strategies", "list_strategies"), ("simulte", "simulate"), ("Recrd", "Record")],
    )
    def test_a_name_that_is_not_there_is_answered_with_the_one_meant(self, wrong, meant):
        script = f"import shoal\ntry: shoal.{wrong}\nexcept AttributeError as error: print(error)"
        assert f"did you mean '{meant}'?" in self.fresh(script)

    def test_figures_too(self):
        assert "snapshot" in dir(shoal.plot)
        with pytest.raises(AttributeError, match="did you mean 'snapshot'"):
            shoal.plot.snapshto  # noqa: B018


def public_functions():
    """Every function of the package, of its figures, and every method of its classes, by its name."""
    for owner in (shoal, shoal.plot):
        for name in owner.__all__:
            value = getattr(owner, name)
            if inspect.isfunction(value):
                yield name, value
            elif inspect.isclass(value):
                methods = {each: getattr(value, each) for each in vars(value) if not each.startswith("_")}
                yield from ((f"{name}.{each}", method) for each, method in methods.items() if callable(method))


@pytest.mark.parametrize(("name", "function"), [pytest.param(*each, id=each[0]) for each in sorted(public_functions())])
def test_a_public_function_names_each_of_its_arguments_in_its_docstring(name, function):
    arguments = [each for each in inspect.signature(function).parameters if each != "self"]
    assert [each for each in arguments if not re.search(rf"\b{each}\b", inspect.getdoc(function) or "")] == []


@pytest.mark.slow
def test_a_users_script_passes_a_strict_type_checker(tmp_path):
    pytest.importorskip("mypy", reason="mypy is not installed")
    script = tmp_path / "mine.py"
    script.write_text(
        "import shoal\n"
        "scenario: shoal.Scenario = shoal.load('oceans2020', neighbors=10).with_(**{'network.loss': 0.1})\n"
        "record: shoal.Record = shoal.simulate(scenario, runs=2, steps=100)\n"
        "low, high = record.estimate('xi').ci95 or (0.0, 1.0)\n"
        "x: float = float(record.trajectories[0].x[0, 0]) + low + high\n"
        "best: str = shoal.compare(['encircle'], scenario, runs=2).baseline\n"
        "fields: list[str] = shoal.sweep(scenario, {'neighbors': range(10, 30, 10)}).fields\n"
        "k: object = shoal.tune(scenario, {'neighbors': (5, 40)}, maximize='time_on_target').best['neighbors']\n"
        "worth: float = shoal.design(scenario, {'BoB-1': (0, 30, 3)}).front[0].more.mean\n"
        "unit: str = shoal.list_metrics()['xi'].unit\n"
        "notes: list[str] = shoal.check(scenario)\n"
        "shoal.plot.save(shoal.plot.summary(record), 'figure.png')\n"
    )
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache", script]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
