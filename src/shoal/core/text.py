"""Text from outside: what may be a name, and how much of anything is shown on a terminal or in an error."""

import reprlib
import unicodedata
from typing import Any

LONGEST = 200  # characters of a name, of a value or of a place in an error
_LONGEST_LINE = 1000  # of an error, lists of what there is included
_HIDING = ("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp")  # control, format (bidirectional ones too), no characters
_JOINERS = "\u200c\u200d"  # some scripts are written with them

_SHORT = reprlib.Repr()
_SHORT.maxstring = _SHORT.maxother = _SHORT.maxlong = LONGEST


def hides(character: str) -> bool:
    """Whether a character would steer a terminal, reorder a text or hide in it."""
    return unicodedata.category(character) in _HIDING and character not in _JOINERS


def plain(text: str, keep: str = "") -> str:
    r"""Return a text as it can be shown anywhere: hidden characters become \x1b and the like, except those to keep."""
    if text.isascii() and text.isprintable():
        return text
    return "".join(each if each in keep or not hides(each) else ascii(each)[1:-1] for each in text)


def checked_name(text: str) -> str:
    """Return a name that can be shown anywhere.

    Raises
    ------
    ValueError : it holds a character that hides, is blank or too long
    """
    if hidden := next(filter(hides, text), ""):
        raise ValueError(f"{quoted(text)} holds the control character {hidden!a}; leave it out")
    if not text.strip() or len(text) > LONGEST:
        raise ValueError(f"{quoted(text)} is not a name; write 1 to {LONGEST} characters")
    return text


def quoted(value: Any) -> str:
    """A value as Python writes it, in short: neither a long text nor a long list comes back whole."""
    try:
        return _SHORT.repr(value)
    except ValueError:  # Python writes no integer of more than 4,300 digits
        return "a number of thousands of digits"


def cut(text: str, most: int = LONGEST) -> str:
    """A text with its middle left out if it is longer than `most`."""
    half = (most - 1) // 2
    return text if len(text) <= most else f"{text[:half]}…{text[-half:]}"


def readable(text: str) -> str:
    """Lines of an error, plain and none too long."""
    return "\n".join(cut(plain(line), _LONGEST_LINE) for line in text.split("\n"))
