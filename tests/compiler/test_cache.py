"""Machine code comes back whole, as it was compiled, or is compiled anew."""

from typing import NamedTuple

import numba
import pytest
from numba.core.environment import Environment

from shoal.compiler.cache import Cache, write_whole
from shoal.compiler.late import compiles

pytestmark = pytest.mark.skipif(not compiles(), reason="without a compiler there is no machine code")


def half(x):
    """What is compiled here."""
    return 0.5 * x


class Dry(NamedTuple):
    """Of the same name and fields as another."""

    x: float = 1.0


Wet = type("Dry", (Dry,), {"__slots__": ()})


def number(params):
    """What differs by the class of its parameters."""
    return params.x


def compiled(folder, function=half, made_of=""):
    """A dispatcher as in a new process."""
    dispatcher = numba.njit(function)
    dispatcher._cache = Cache(function, folder, made_of)
    return dispatcher


def hits(dispatcher, argument):
    """Whether a call finds the machine code; what it returns is right."""
    assert dispatcher(argument) == dispatcher.py_func(argument)
    return sum(dispatcher.stats.cache_hits.values()) == 1


def test_another_process_finds_it_and_for_other_arguments_there_is_another_file(tmp_path):
    assert not hits(compiled(tmp_path), 3.0)
    assert hits(compiled(tmp_path), 3.0)
    assert not hits(compiled(tmp_path), 3)
    assert hits(compiled(tmp_path), 3.0)
    assert len(list(tmp_path.iterdir())) == 2


def test_what_it_is_made_of_counts(tmp_path):
    assert not hits(compiled(tmp_path, made_of="a"), 3.0)
    assert not hits(compiled(tmp_path, made_of="b"), 3.0)
    assert hits(compiled(tmp_path, made_of="a"), 3.0)


def test_a_class_of_the_same_name_is_another(tmp_path):
    assert not hits(compiled(tmp_path, number), Dry())
    assert not hits(compiled(tmp_path, number), Wet())


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-1], lambda text: b"", lambda text: text[:40] + b"?" + text[41:]]
)
def test_a_damaged_file_is_as_good_as_none(tmp_path, damage):
    assert not hits(compiled(tmp_path), 3.0)
    (file,) = tmp_path.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert not hits(compiled(tmp_path), 3.0)
    assert hits(compiled(tmp_path), 3.0)


def test_a_folder_that_is_gone_stops_nobody(tmp_path):
    assert not hits(compiled(tmp_path / "gone"), 3.0)


def test_what_cannot_be_written_leaves_nothing(tmp_path):
    (tmp_path / "there").mkdir()
    with pytest.raises(OSError, match="there"):
        write_whole(tmp_path / "there", b"text")
    assert [each.name for each in tmp_path.iterdir()] == ["there"]


def test_of_users_strategies_the_oldest_go(tmp_path, monkeypatch):
    monkeypatch.setattr("shoal.compiler.cache.MOST_OWN", 2)
    assert not hits(compiled(tmp_path), 3.0)
    for version in "abc":
        assert not hits(compiled(tmp_path, made_of=version), 3.0)
    assert len(list(tmp_path.iterdir())) == 3
    assert hits(compiled(tmp_path), 3.0)


def test_what_names_a_module_that_is_not_there_is_compiled_anew(tmp_path):
    scope = {"__name__": "nowhere"}
    exec("def half(x):\n    return x / 2", scope)
    for _ in range(2):
        assert not hits(compiled(tmp_path, scope["half"]), 3.0)
        Environment._memo.clear()  # as in a new process
    assert list(tmp_path.iterdir())
