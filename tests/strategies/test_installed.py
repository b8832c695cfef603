"""Strategies of installed packages are found by their names; one that is broken harms nobody."""

import json
import os
import subprocess
import sys

import pytest

ZIGZAG = '''
from typing import NamedTuple
import shoal

class Zigzag(NamedTuple):
    every: shoal.Seconds = 2.0

@shoal.strategy("zigzag", params=Zigzag, reference="Sailors, always")
def zigzag(me, heard, memory, params, draw):
    """Tack."""
    return me.max_speed, me.max_speed if int(me.time / params.every) % 2 == 0 else -me.max_speed
'''


@pytest.fixture
def site(tmp_path):
    """A folder of installed packages."""
    folder = tmp_path / "site"
    folder.mkdir()
    return folder


def install(site, package, text, **offers):
    """Put a package and what it offers there: strategy = module."""
    module = package.replace("-", "_")
    (site / f"{module}.py").write_text(text, encoding="utf-8")
    info = site / f"{module}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n", encoding="utf-8")
    lines = [f"{name.replace('_', '-')} = {module}" for name in offers or {package: None}]
    (info / "entry_points.txt").write_text("[shoal.strategies]\n" + "\n".join(lines) + "\n", encoding="utf-8")


def shoal(site, *tokens):
    """Run a command with these packages installed; return exit code, stdout, stderr."""
    return python(site, "-m", "shoal", *tokens)


def python(site, *arguments):
    path = os.pathsep.join([str(site), *filter(None, [os.environ.get("PYTHONPATH")])])
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=site.parent, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, check=False,
    )  # fmt: skip
    return done.returncode, done.stdout, done.stderr


def hash_of(site, file):
    """The hash of a scenario; `shoal check` says it, too, but compiles for a minute."""
    return python(site, "-c", f"import shoal; print(shoal.load({file!r}).hash)")[1]


def listed(site):
    _, out, err = shoal(site, "strategies", "--json")
    return {each["name"]: each for each in json.loads(out)}, err


class TestAPackage:
    def test_is_listed_like_our_own(self, site):
        install(site, "zigzag", ZIGZAG)
        known, err = listed(site)
        assert known["zigzag"]["reference"] == "Sailors, always"
        assert known["zigzag"]["parameters"]["every"]["unit"] == "s"
        assert not known["zigzag"]["builtin"]
        assert known["knn-pso"]["builtin"]
        assert err == ""

    def test_is_compared_like_our_own(self, site):
        install(site, "zigzag", ZIGZAG)
        code, out, err = shoal(site, "compare", "zigzag", "--steps", "20", "--runs", "2", "--json")
        assert code == 0, err
        assert json.loads(out)["baseline"] == "zigzag"

    def test_another_version_of_it_is_another_scenario(self, site):
        install(site, "zigzag", ZIGZAG)
        (site.parent / "mine.toml").write_text(
            shoal(site, "scenario", "oceans2020")[1].partition("[strategy]")[0]
            + '[strategy]\nname = "zigzag"\n\n[[targets]]\nkind = "still"\nradius = 1.0\n',
            encoding="utf-8",
        )
        first = hash_of(site, "mine.toml")
        saved = shoal(site, "scenario", "mine.toml")[1]
        assert "source = " in saved
        (site.parent / "saved.toml").write_text(saved, encoding="utf-8")
        assert hash_of(site, "saved.toml") == first
        (site / "zigzag.py").write_text(ZIGZAG + "# changed\n", encoding="utf-8")
        assert hash_of(site, "mine.toml") != first
        code, _, err = shoal(site, "check", "saved.toml")
        assert code == 2
        assert "is not the version that this scenario was made with" in err


class TestABrokenPackage:
    @pytest.mark.parametrize(
        ("text", "offers", "says"),
        [
            ("import no_such_module\n", "zigzag", "ModuleNotFoundError"),
            ("def broken(:\n", "zigzag", "SyntaxError"),
            ("raise SystemExit(3)\n", "zigzag", "SystemExit"),
            (ZIGZAG, "zagzig", "defines no strategy called 'zagzig'"),
            (ZIGZAG.replace('"zigzag"', '"lattice"'), "lattice", "as a built-in one is"),
            (ZIGZAG.replace("float = 2.0", "float").replace(" = 2.0", ""), "zigzag", "has no default"),
        ],
    )
    def test_is_named_and_the_others_are_listed(self, site, text, offers, says):
        install(site, "bad-sails", text, **{offers: None})
        install(site, "other", ZIGZAG.replace('"zigzag"', '"other"'))
        known, err = listed(site)
        assert says in err
        assert "package 'bad-sails'" in err
        assert err.count("shoal: ") == 1
        assert "Traceback" not in err
        assert "other" in known
        assert known["lattice"]["builtin"]
        assert "zagzig" not in known

    def test_is_an_error_only_for_who_asks_for_it(self, site):
        install(site, "zigzag", "1 / 0\n")
        code, _, err = shoal(site, "run", "oceans2020", "--strategy", "zigzag", "--steps", "10")
        assert code == 2
        assert "package 'zigzag': zigzag cannot be imported: ZeroDivisionError" in err
        assert "fix: update or uninstall it" in err
        assert shoal(site, "scenario", "oceans2020")[0] == 0

    def test_its_strategy_is_offered_where_a_name_is_unknown(self, site):
        install(site, "zigzag", "1 / 0\n")
        code, _, err = shoal(site, "run", "oceans2020", "--strategy", "zigzak", "--steps", "10")
        assert code == 2
        assert "did you mean 'zigzag'" in err

    def test_two_packages_with_one_strategy_are_both_named(self, site):
        install(site, "zigzag", ZIGZAG)
        install(site, "also", ZIGZAG, zigzag=None)
        assert "is offered by package 'also' and package 'zigzag'" in listed(site)[1]
