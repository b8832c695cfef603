"""THIRD_PARTY.md names all that is shipped of others, and every package that Shoal asks for."""

import json
import re
from pathlib import Path

from licenses import LEFT_OUT, asked_for
from packaging.utils import canonicalize_name

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "THIRD_PARTY.md").read_text(encoding="utf-8")
SHIPPED, _, BESIDE = PAGE.partition("## Installed beside Shoal")
OUTSIDE = re.compile(r"""\b(?:from|import|require\(|import\()\s*["']([^."'][^"']*)["']|url\(["']?([^#)"'][^)"']*)""")
OURS = {  # what the package holds that is no Python and no text of ours to read: each made by a script of ours
    "offshore.nc": "examples/sea_file.py",
    "app.js": "web/build.mjs",
    "app.css": "web/build.mjs",
    "index.html": "web/build.mjs",
}
PLAIN = {".py", ".toml", ".txt", ".typed"}


def bundled(package, sources):
    """npm packages that the page is built with: those of production, and those that its sources name."""
    named = {(script or style).partition("?")[0] for text in sources for script, style in OUTSIDE.findall(text)}
    return {*package.get("dependencies", {}), *named}


class TestShipped:
    def test_every_npm_package_of_the_page_is_named(self):
        sources = [file.read_text(encoding="utf-8") for file in (ROOT / "web/src").iterdir()]
        package = json.loads((ROOT / "web/package.json").read_text(encoding="utf-8"))
        assert len(sources) > 10
        assert {name for name in bundled(package, sources) if f"| {name} |" not in SHIPPED} == set()

    def test_a_package_or_a_font_would_be_seen(self):
        sources = ['import { scaleLinear } from "d3-scale";', 'import "./dom";', "@font-face { src: url(inter.woff2) }"]
        assert bundled({"dependencies": {"three": "1"}}, sources) == {"three", "d3-scale", "inter.woff2"}

    def test_every_file_of_the_package_that_is_no_source_is_made_by_a_script_of_ours(self):
        package = [file for file in (ROOT / "src/shoal").rglob("*") if file.is_file()]
        shipped = {file.name for file in package if file.suffix not in PLAIN and "__pycache__" not in file.parts}
        assert shipped == set(OURS)
        assert all((ROOT / script).exists() for script in OURS.values())

    def test_files_that_hold_what_is_of_others_exist(self):
        named = re.findall(r"^\| [^|]+ \| `(shoal/[^`]+)` \|", SHIPPED, re.MULTILINE)
        assert named
        assert all((ROOT / "src" / name).is_file() for name in named)


ROWS = dict(re.findall(r"^\| \*\*([^*]+)\*\* \| [^|]+ \| ([^|]+) \|", BESIDE, re.MULTILINE))


class TestInstalledBeside:
    def test_what_shoal_asks_for_is_in_the_table_with_its_extras(self):
        asked = {}
        for extra, needed in asked_for(ROOT / "pyproject.toml").items():
            for each in needed:
                asked.setdefault(canonicalize_name(each.name), set()).add(extra)
        assert set(ROWS) == set(asked), "run make licenses"
        for name, extras in asked.items():
            assert "core" in extras or extras <= set(ROWS[name].split(", ")), f"{name}: run make licenses"

    def test_copyleft_is_named_before_the_table(self):
        (line,) = re.findall(r"^Copyleft: .*", BESIDE, re.MULTILINE)
        assert "pymavlink (LGPL-3.0; mavlink)" in line

    def test_extras_that_are_left_out_are_no_more_than_these(self):
        assert LEFT_OUT == ("all", "dev")
