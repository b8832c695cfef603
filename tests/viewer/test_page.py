"""The page's files, and all of it in one."""

import base64
import gzip
import hashlib
import json
import re

import pytest

from shoal.core.errors import ShoalError
from shoal.viewer.page import _read, assets, inline_page

HEAVIEST = 60_000  # bytes of the page as it comes, compressed

HOSTILE = "</script><script>alert(1)</script><!--<script>"


def element(page, name):
    """What is in the script element of an id."""
    return re.search(rf'<script [^>]*id="{name}">(.*?)</script>', page, re.DOTALL).group(1)


def app(page):
    return re.search(r"<script>(.*?)</script>", page, re.DOTALL).group(1)


class TestInlinePage:
    def test_scene_and_frames_come_back(self, small_page):
        page = inline_page({"name": "a", "seed": 5}, bytes(range(256)))
        assert json.loads(element(page, "scene")) == {"name": "a", "seed": 5}
        assert base64.b64decode(element(page, "frames")) == bytes(range(256))

    def test_a_hostile_name_stays_a_name(self, small_page):
        page = inline_page({"name": HOSTILE}, b"")
        assert json.loads(element(page, "scene"))["name"] == HOSTILE
        assert "alert(1)</script>" not in page
        assert page.count("<script") == page.count("</script>") == 3

    def test_style_and_script_are_inside(self, small_page):
        page = inline_page({}, b"")
        assert f"<style>{small_page['app.css']}</style>" in page
        assert "app.js" not in page
        assert "app.css" not in page

    def test_the_script_comes_last_and_cannot_end_early(self, small_page):
        page = inline_page({}, b"")
        assert app(page) == small_page["app.js"].replace("</script", "<\\/script").replace("<!--", "<\\!--")
        assert page.index(app(page)) > page.index('id="frames"') > page.index('id="scene"')

    def test_no_script_runs_but_the_one_of_this_hash_and_nothing_is_loaded(self, small_page):
        page = inline_page({}, b"")
        policy = re.search(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page).group(1)
        digest = base64.b64encode(hashlib.sha256(app(page).encode()).digest()).decode()
        assert "default-src 'none'" in policy
        assert f"script-src 'sha256-{digest}';" in policy
        assert "http" not in policy
        assert page.index("Content-Security-Policy") < page.index("<style>")

    def test_backslashes_in_the_page_are_no_patterns(self, small_page, monkeypatch):
        odd = r"const way = /\d+\1\g<0>/;"
        monkeypatch.setitem(small_page, "app.js", odd)
        assert odd in inline_page({}, b"")

    def test_a_page_of_another_shape_is_refused(self, small_page, monkeypatch):
        monkeypatch.setitem(small_page, "index.html", "<html><head></head><body></body></html>")
        with pytest.raises(ShoalError, match="build the page again"):
            inline_page({}, b"")


def test_the_page_is_light():
    assert sum(len(gzip.compress(each.content, 9)) for each in assets().values()) <= HEAVIEST


def test_a_page_that_is_not_built_is_one_sentence():
    with pytest.raises(ShoalError, match=r"is not built \(missing.js is missing\)\n  fix: run"):
        _read("missing.js")
