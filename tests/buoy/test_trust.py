"""The file of a key: made once, read by its owner only."""

import stat

import pytest

from shoal.buoy.trust import key_in, read_key
from shoal.core.errors import FleetError


def test_it_is_made_and_read_again(tmp_path):
    file = tmp_path / "key"
    key = key_in(file)
    assert len(key) == 32
    assert key_in(file) == read_key(file) == key
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert key_in(tmp_path / "other") != key


@pytest.mark.parametrize("text", ["", "key", "00" * 31, "0" * 65, "zz" * 32, "00" * 32 + "\n" + "00"])
def test_what_is_no_key(tmp_path, text):
    file = tmp_path / "key"
    file.write_text(text)
    file.chmod(0o600)
    with pytest.raises(FleetError, match="holds no key"):
        key_in(file)
    assert file.read_text() == text


def test_one_that_others_can_read(tmp_path):
    file = tmp_path / "key"
    key_in(file)
    file.chmod(0o640)
    with pytest.raises(FleetError, match="chmod 600"):
        read_key(file)


def test_places_where_none_is_or_can_be(tmp_path):
    with pytest.raises(FleetError, match="No such file"):
        read_key(tmp_path / "key")
    with pytest.raises(FleetError, match="No such file"):
        key_in(tmp_path / "no" / "key")
    with pytest.raises(FleetError):
        key_in(tmp_path)
