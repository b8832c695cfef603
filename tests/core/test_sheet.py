"""Tables to look at hold text, and nothing that is in them acts."""

import re

import pytest

from shoal.core.sheet import MOST_ROWS, Sheet, shown

HOSTILE = ("<script>alert(1)</script>", "a & b", "\x1b[31mred", "two\nlines", '" onmouseover="x')


@pytest.fixture(params=HOSTILE)
def hostile(request):
    text = request.param
    return Sheet(head=text, titles=("name", text), rows=[(text, "1.5")], note=text, words=("name",))


class TestHostileText:
    """Names are text."""

    def test_is_escaped_in_html(self, hostile):
        page = hostile.html()
        assert "<script" not in page
        assert "a & b" not in page
        assert 'onmouseover="' not in page
        assert "\x1b" not in page

    def test_steers_no_terminal_and_breaks_no_line(self, hostile):
        lines = hostile.text().split("\n")
        assert len(lines) == 4
        assert all(line.isprintable() for line in lines)

    def test_is_still_told(self):
        assert shown("\x1b[31m") == r"\x1b[31m"
        assert shown("Straße 中") == "Straße 中"


class TestColumns:
    """Words begin at the left, numbers end at the right."""

    SHEET = Sheet("head", ("name", "mean"), [("a", "1.25"), ("long", "10.5")], words=("name",))

    def test_as_text(self):
        assert self.SHEET.text() == "head\nname  mean\na     1.25\nlong  10.5"

    def test_as_html(self):
        page = self.SHEET.html()
        assert re.search(r'<td style="text-align: left[^>]*>long</td><td style="text-align: right[^>]*>10.5</td>', page)

    def test_many_rows_are_cut_and_counted(self):
        long = Sheet("head", ("n",), [(str(n),) for n in range(MOST_ROWS + 7)])
        assert "and 7 more rows" in long.text()
        assert "and 7 more rows" in long.html()
        assert long.html().count("<td") == MOST_ROWS
