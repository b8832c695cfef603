"""Specification of writing figures: three formats, whole files or none, the same bytes every time."""

import sys

import pytest

from shoal.core.errors import MissingExtraError, RecordError, ShoalError
from shoal.drawing.files import save_figure
from shoal.drawing.style import style
from shoal.drawing.summary import summary_figure

BEGINS = {"png": b"\x89PNG", "svg": b"<?xml", "pdf": b"%PDF"}


@pytest.fixture
def figure(make_record):
    return summary_figure(make_record())


@pytest.mark.parametrize("kind", BEGINS)
class TestFormats:
    """The suffix decides."""

    def test_a_file_of_each_kind(self, tmp_path, figure, kind):
        save_figure(figure, tmp_path / f"figure.{kind.upper()}")
        assert (tmp_path / f"figure.{kind.upper()}").read_bytes().startswith(BEGINS[kind])

    def test_the_same_record_gives_the_same_bytes(self, tmp_path, make_record, kind):
        for name in ("one", "two"):
            save_figure(summary_figure(make_record()), tmp_path / f"{name}.{kind}")
        assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"two.{kind}").read_bytes()


class TestErrors:
    """A figure that cannot be written says why, and leaves nothing behind."""

    @pytest.mark.parametrize("name", ["figure.jpg", "figure"])
    def test_another_suffix(self, tmp_path, figure, name):
        with pytest.raises(ShoalError, match=r"fix: name a file that ends in \.png, \.svg or \.pdf"):
            save_figure(figure, tmp_path / name)
        assert not list(tmp_path.iterdir())

    def test_a_folder_that_is_not_there(self, tmp_path, figure):
        with pytest.raises(
            RecordError, match=r"cannot be written: there is no folder .*\n  fix: make the folder first"
        ):
            save_figure(figure, tmp_path / "nowhere" / "figure.svg")

    def test_a_name_that_a_folder_has(self, tmp_path, figure):
        (tmp_path / "figure.svg").mkdir()
        with pytest.raises(RecordError, match="cannot be written"):
            save_figure(figure, tmp_path / "figure.svg")
        assert [each.name for each in tmp_path.iterdir()] == ["figure.svg"]

    def test_a_failure_half_way_leaves_the_old_file(self, tmp_path, figure, monkeypatch):
        def fill_the_disk(stream, **options):
            stream.write(b"half a figure")
            raise OSError(28, "No space left on device")

        path = tmp_path / "figure.png"
        path.write_bytes(b"old, of shoal")
        monkeypatch.setattr(figure, "savefig", fill_the_disk)
        with pytest.raises(RecordError, match="No space left on device"):
            save_figure(figure, path)
        assert path.read_bytes() == b"old, of shoal"
        assert list(tmp_path.iterdir()) == [path]

    def test_without_matplotlib_the_extra_is_named(self, monkeypatch):
        monkeypatch.setitem(sys.modules, "matplotlib", None)
        monkeypatch.setitem(sys.modules, "matplotlib.style", None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[plots\]'"), style():
            pass
