"""Files are whole or not there."""

import pytest

from shoal.core.errors import RecordError
from shoal.core.files import whole_file, write_whole


class TestWriteWhole:
    """At once, or not at all."""

    def test_it_replaces_a_file_of_its_name(self, tmp_path):
        file = tmp_path / "run.html"
        file.write_text("old")
        write_whole(file, b"new")
        assert file.read_text() == "new"
        assert list(tmp_path.iterdir()) == [file]

    def test_a_folder_that_is_not_there_is_one_sentence(self, tmp_path):
        with pytest.raises(RecordError, match="cannot be written"):
            write_whole(tmp_path / "nowhere" / "run.html", b"new")

    def test_a_name_of_a_folder_leaves_nothing_behind(self, tmp_path):
        (tmp_path / "run.html").mkdir()
        with pytest.raises(RecordError, match="cannot be written"):
            write_whole(tmp_path / "run.html", b"new")
        assert [each.name for each in tmp_path.iterdir()] == ["run.html"]


@pytest.mark.parametrize("end", [KeyboardInterrupt, ValueError])
def test_whatever_ends_the_writing_leaves_what_was_there(tmp_path, end):
    file = tmp_path / "run.mp4"
    file.write_text("old")

    def interrupted():
        with whole_file(file) as partial:
            partial.write_text("half")
            raise end

    with pytest.raises(end):
        interrupted()
    assert file.read_text() == "old"
    assert list(tmp_path.iterdir()) == [file]
