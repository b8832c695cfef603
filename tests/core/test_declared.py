"""Files declare themselves in a folder of ours or in an installed package; what is wrong is said in one sentence."""

import sys

import pytest

from shoal.compiler import installed
from shoal.compiler.kernel import sources_hash
from shoal.core.declared import declared

GROUP = "shoal.metrics"
FISH = "from pond.kind import Fish\n"


@pytest.fixture
def site(tmp_path, monkeypatch):
    """A folder of installed packages, one of which, pond, is the folder of ours."""
    before = set(sys.modules)
    monkeypatch.syspath_prepend(str(tmp_path))
    pond = tmp_path / "pond"
    pond.mkdir()
    (pond / "__init__.py").touch()
    (pond / "kind.py").write_text("from typing import NamedTuple\nclass Fish(NamedTuple):\n    name: str\n")
    (pond / "tench.py").write_text(f'{FISH}FISH = Fish("tench")\n')
    (pond / "carp.py").write_text(f'{FISH}FISH = Fish("carp")\n')
    (pond / "notes.py").write_text("1 / 0  # not a fish\n")
    installed.offers.cache_clear()
    yield tmp_path
    installed.offers.cache_clear()
    for name in set(sys.modules) - before:
        if name.split(".")[0] in {path.stem for path in tmp_path.iterdir()}:
            del sys.modules[name]


def install(site, package, text, *offers):
    """Put a package there, of one module, and what it offers: "name = module"."""
    module = package.replace("-", "_")
    (site / f"{module}.py").write_text(FISH + text, encoding="utf-8")
    info = site / f"{module}-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1.0\n", encoding="utf-8")
    lines = "\n".join(offers or (f"{package} = {module}",))
    (info / "entry_points.txt").write_text(f"[{GROUP}]\n{lines}\n", encoding="utf-8")


def found():
    from pond.kind import Fish

    known, wrong = declared("pond", "FISH", Fish, GROUP)
    return [(each.value.name, each.package) for each in known], [str(error) for error in wrong]


class TestAFolder:
    def test_is_searched_for_the_files_that_declare_themselves(self, site):
        assert found() == ([("carp", None), ("tench", None)], [])


class TestAPackage:
    def test_comes_after_ours(self, site):
        install(site, "bream", 'FISH = Fish("bream")')
        assert found() == ([("carp", None), ("tench", None), ("bream", "package 'bream'")], [])

    def test_may_name_what_it_declares_itself(self, site):
        install(site, "two", 'A, B = Fish("roach"), Fish("perch")', "roach = two:A", "perch = two:B")
        assert [name for name, package in found()[0] if package] == ["perch", "roach"]


class TestAPackageThatIsWrong:
    @pytest.mark.parametrize(
        ("text", "offer", "says"),
        [
            ("1 / 0", "bream = broken", "package 'broken': broken cannot be imported: ZeroDivisionError"),
            ("raise SystemExit", "bream = broken", "broken cannot be imported: SystemExit"),
            ("", "bream = missing", "missing cannot be imported: ModuleNotFoundError"),
            ("", "bream = broken", "package 'broken': broken declares no fish: FISH is not a Fish"),
            ("FISH = 3", "bream = broken", "package 'broken': broken declares no fish: FISH is not a Fish"),
            ('FISH = Fish("roach")', "bream = broken", "declares the fish 'roach', but its entry point says 'bream'"),
            ('FISH = Fish("carp")', "carp = broken", "package 'broken': offers a fish called 'carp', as a built-in"),
        ],
    )
    def test_is_named_and_harms_no_other(self, site, text, offer, says):
        install(site, "broken", text, offer)
        install(site, "dace", 'FISH = Fish("dace")')
        known, wrong = found()
        assert [name for name, _ in known] == ["carp", "tench", "dace"]
        assert len(wrong) == 1
        assert says in wrong[0]
        assert wrong[0].count("\n") == 1
        assert "uninstall" in wrong[0]

    def test_two_that_offer_one_name_are_both_named(self, site):
        install(site, "one", 'FISH = Fish("bream")', "bream = one")
        install(site, "two", 'FISH = Fish("bream")', "bream = two")
        assert "fish 'bream': is offered by package 'one' and package 'two'" in found()[1][0]


class TestTheSources:
    """Kernels of packages are compiled into the engine, so the name of its cache covers their files."""

    def test_are_those_of_the_package_however_deep_the_module(self, site):
        deep = site / "reef" / "deep"
        deep.mkdir(parents=True)
        (site / "reef" / "__init__.py").write_text("1 / 0  # nothing is imported\n")
        (deep / "__init__.py").touch()
        (deep / "bream.py").write_text("A = 1")
        install(site, "bream", "", "bream = reef.deep.bream")
        before = list(installed.offered_sources())
        (site / "reef" / "helpers.py").write_text("B = 1")
        assert list(installed.offered_sources()) != before

    def test_of_a_shared_namespace_are_only_our_part(self, site):
        for part in ("ours", "theirs"):
            (site / "shared" / part).mkdir(parents=True)
            (site / "shared" / part / "__init__.py").touch()
        install(site, "bream", "", "bream = shared.ours")
        before = list(installed.offered_sources())
        (site / "shared" / "theirs" / "more.py").write_text("B = 1")
        assert list(installed.offered_sources()) == before
        (site / "shared" / "ours" / "more.py").write_text("B = 1")
        assert list(installed.offered_sources()) != before

    def test_are_none_of_a_package_that_is_gone(self, site):
        install(site, "bream", "", "bream = missing.module")
        assert list(installed.offered_sources()) == [b"shoal.metrics bream = missing.module\n"]

    def test_are_none_where_nothing_is_installed(self, site):
        assert list(installed.offered_sources()) == []

    def test_are_part_of_the_name_of_the_cache(self, site):
        alone = sources_hash.__wrapped__()
        install(site, "bream", 'FISH = Fish("bream")')
        installed.offers.cache_clear()
        first = sources_hash.__wrapped__()
        (site / "bream.py").write_text("# edited\n")
        assert len({alone, first, sources_hash.__wrapped__()}) == 3
