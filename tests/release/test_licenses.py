"""The table of licenses, from what packages say of themselves."""

from email.message import Message
from types import SimpleNamespace

import licenses
import pytest
from licenses import Package, asked_for, closure, is_copyleft, license_of, packages, short, table
from packaging.requirements import Requirement


@pytest.fixture
def known(monkeypatch):
    """A function: packages that are installed, by name what their metadata say and what they need."""

    def known(**told):
        def installed(name):
            if name not in told:
                return None
            metadata = Message()
            for key, value in told[name].get("says", {"License": "MIT"}).items():
                for each in value if isinstance(value, list) else [value]:
                    metadata[key] = each
            return SimpleNamespace(metadata=metadata, requires=told[name].get("needs"))

        monkeypatch.setattr(licenses, "installed", installed)

    return known


class TestAskedFor:
    @pytest.fixture
    def asked(self, tmp_path):
        (tmp_path / "pyproject.toml").write_text(
            '[project]\nname = "shoal"\ndependencies = ["a>=1"]\n[project.optional-dependencies]\n'
            'plots = ["b"]\nvideo = ["shoal[plots]", "c"]\nall = ["shoal[plots,video]"]\ndev = ["d"]\n'
        )
        return asked_for(tmp_path / "pyproject.toml")

    def test_an_extra_that_holds_another_has_what_that_has(self, asked):
        names = {extra: sorted(each.name for each in needed) for extra, needed in asked.items()}
        assert names == {"core": ["a"], "plots": ["b"], "video": ["b", "c"]}


class TestClosure:
    def test_it_goes_on_to_what_is_needed_here_and_ends_where_packages_need_each_other(self, known):
        known(a={"needs": ["b", "gone ; python_version < '3'", "fast ; extra == 'fast'"]}, b={"needs": ["a"]})
        assert closure([Requirement("a")]) == {"a", "b"}

    def test_extras_of_packages_are_followed(self, known):
        known(a={"needs": ["fast ; extra == 'fast'"]})
        assert closure([Requirement("a"), Requirement("a[fast]")]) == {"a", "fast"}


def test_what_the_core_brings_is_not_said_of_extras_again(known):
    known(a={"needs": ["b"]}, b={}, c={"needs": ["b"]})
    found = packages({"core": [Requirement("a")], "plots": [Requirement("c")]})
    assert found == [
        Package("a", "MIT", ("core",), True),
        Package("b", "MIT", ("core",), False),
        Package("c", "MIT", ("plots",), True),
    ]


class TestLicenseOf:
    @pytest.mark.parametrize(
        ("says", "license"),
        [
            ({"License-Expression": "MIT OR 0BSD", "License": "other"}, "MIT OR 0BSD"),
            ({"License": "BSD 3-Clause License"}, "BSD-3-Clause"),
            ({"License": "Copyright 2015\nall of it", "Classifier": ["License :: OSI Approved :: MIT License"]}, "MIT"),
            (
                {"Classifier": ["License :: DFSG approved", "License :: OSI Approved :: Apache Software License"]},
                "Apache-2.0",
            ),
        ],
    )
    def test_what_is_most_exact_counts(self, known, says, license):
        known(a={"says": says})
        assert license_of("a") == license

    def test_one_that_states_none_is_an_error(self, known):
        known(a={"says": {}})
        with pytest.raises(LookupError, match=r"^a: states no license\n  fix: "):
            license_of("a")

    def test_one_that_is_not_installed_is_an_error(self, known):
        known()
        with pytest.raises(LookupError, match=r"^a: is not installed\n  fix: "):
            license_of("a")


@pytest.mark.parametrize(
    ("words", "copyleft"),
    [
        ("GNU Lesser General Public License v3 (LGPLv3)", True),
        ("GPL-2.0-or-later", True),
        ("AGPLv3+", True),
        ("MPL-2.0 AND MIT", True),
        ("EPL-2.0 OR Apache-2.0", False),  # one may choose
        ("BSD-3-Clause AND 0BSD AND MIT AND Zlib AND CC0-1.0", False),
        ("Apache-2.0 WITH LLVM-exception", False),
    ],
)
def test_copyleft(words, copyleft):
    assert is_copyleft(short(words)) == copyleft


def test_the_table_names_copyleft_first_and_ours_in_bold():
    made = table([Package("a", "MIT", ("core",), True), Package("b", "LGPL-3.0", ("mavlink", "fleet"), False)])
    assert made.splitlines()[0] == "Copyleft: b (LGPL-3.0; mavlink, fleet)."
    assert made.splitlines()[4:] == ["| **a** | MIT | core |", "| b | LGPL-3.0 | mavlink, fleet |"]


class TestMain:
    @pytest.fixture
    def page(self, tmp_path, monkeypatch):
        monkeypatch.setattr(licenses, "PAGE", tmp_path / "page.md")
        monkeypatch.setattr(licenses, "packages", lambda asked: [Package("a", "MIT", ("core",), True)])
        return tmp_path / "page.md"

    def test_only_the_table_is_replaced(self, page):
        page.write_text(f"before\n{licenses.START}old\n{licenses.END}after\n")
        assert licenses.main() == 0
        text = page.read_text()
        assert text.startswith(f"before\n{licenses.START}Copyleft: none.\n")
        assert text.endswith(f"| **a** | MIT | core |\n{licenses.END}after\n")

    def test_a_page_without_a_place_is_left_alone(self, page, capsys):
        page.write_text("nothing\n")
        assert licenses.main() == 2
        assert page.read_text() == "nothing\n"
        assert "has no place for the table" in capsys.readouterr().err
