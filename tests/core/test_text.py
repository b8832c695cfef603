"""Text from outside can be shown anywhere."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from shoal.core.errors import ScenarioError
from shoal.core.text import LONGEST, checked_name, cut, hides, plain, quoted

ODD = ["\x1b[2J", "a\nb", "\r", "\x07", "a\u202eb", "\u2066", "\ufeff", "\u200b", "\u2028", "\x9b31m", "\ud800", "\0"]


class TestNames:
    """Any script, no character that hides."""

    @pytest.mark.parametrize(
        "name", ["BoB-1", "Möwe", "бот 7", "群れ", "نورس", "می\u200cخواهم", "[/b] $x$ <b> _", "🦭"]
    )
    def test_are_taken_as_they_are(self, name):
        assert checked_name(name) == plain(name) == name

    @pytest.mark.parametrize("name", ODD)
    def test_with_characters_that_hide_are_refused_by_their_code(self, name):
        with pytest.raises(ValueError, match=r"holds the control character '\\\w+'; leave it out"):
            checked_name(name)

    @pytest.mark.parametrize("name", ["", " ", "x" * (LONGEST + 1)])
    def test_are_neither_blank_nor_endless(self, name):
        with pytest.raises(ValueError, match="is not a name; write 1 to 200 characters"):
            checked_name(name)


class TestPlain:
    """What is printed of a record that somebody sent."""

    def test_orders_to_a_terminal_become_visible(self):
        assert plain("\x1b]0;pwn\x07\u202e") == r"\x1b]0;pwn\x07\u202e"

    @given(text=st.text())
    def test_holds_nothing_that_hides(self, text):
        assert not any(map(hides, plain(text)))

    def test_keeps_what_it_is_told_to(self):
        assert plain("a\nb\tc", "\n") == "a\nb\\tc"


class TestShort:
    """Values in errors."""

    @pytest.mark.parametrize(
        "value",
        ["x" * 100_000, 10**5000, ["x"] * 10_000, {f"{n}": n for n in range(10_000)}],
        ids=["text", "number", "list", "table"],
    )
    def test_never_come_back_whole(self, value):
        assert len(quoted(value)) <= LONGEST + 60

    def test_are_what_python_writes_if_short(self):
        assert [quoted(value) for value in ("a\n", 1.5, [1.0], None)] == ["'a\\n'", "1.5", "[1.0]", "None"]

    def test_keep_both_ends(self):
        assert cut("a" * 300 + "z") == "a" * 99 + "…" + "a" * 98 + "z"

    def test_an_error_is_plain_and_its_lines_are_short(self):
        error = str(ScenarioError("x" * 10_000, "is \x1b[2J" + "y" * 10_000, "mend it\nwell"))
        assert [len(line) < 1300 for line in error.split("\n")] == [True] * 3
        assert "\x1b" not in error
