"""A saved state is the one that was written, or one clear error."""

import io
import random
import shutil
import zipfile

import numpy as np
import pytest

from damage import hurt_bytes
from shoal.core.errors import RecordError
from shoal.record.saved_state import read_state, write_state

ARRAYS = {
    "x": np.linspace(-1.0, 1.0, 50),
    "alive": np.arange(50) % 2 == 0,
    "number": np.array(40),
    "targets": np.zeros(2, [("kind", "i8"), ("x", "f8")]),
}


@pytest.fixture
def file(tmp_path):
    write_state(tmp_path / "state.npz", "one of run 3", ARRAYS)
    return tmp_path / "state.npz"


def refusal(file, identity="one of run 3"):
    with pytest.raises(RecordError) as caught:
        read_state(file, identity, ARRAYS)
    where, problem, _ = caught.value.args
    assert where == str(file)
    return problem


def rewritten(file, **changes):
    arrays = dict(np.load(file)) | changes
    np.savez(file, **{name: each for name, each in arrays.items() if each is not None})


def test_what_is_read_is_what_was_written(file):
    for name, values in read_state(file, "one of run 3", ARRAYS)[0].items():
        assert (values.dtype, values.tobytes()) == (ARRAYS[name].dtype, ARRAYS[name].tobytes())


def test_a_file_of_something_else_is_not_replaced(file):
    np.savez(file, thesis=np.zeros(3))
    with pytest.raises(RecordError, match="was not made by Shoal"):
        write_state(file, "one of run 3", ARRAYS)
    assert list(np.load(file)) == ["thesis"]


def test_that_of_another_run_is_refused(file):
    assert refusal(file, "one of run 4") == "was saved by one of run 3, this is one of run 4"


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"x": np.linspace(-1.0, 1.0, 51)}, "x has another shape"),
        ({"x": np.arange(50)}, "x has another shape or type"),
        ({"x": np.zeros(50)}, "is not what was written"),
        ({"number": np.array(41)}, "is not what was written"),
        ({"x": None}, "x"),
        ({"sha256": None}, "sha256"),
        ({"x": np.array([{}])}, "is not a saved state"),
    ],
)
def test_an_edited_one_is_refused(file, changes, problem):
    rewritten(file, **changes)
    assert problem in refusal(file)


def test_one_that_announces_200_gigabytes_is_refused(file):
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": (25 * 10**9,)})
    with zipfile.ZipFile(file, "a") as archive, pytest.warns(UserWarning, match="Duplicate name"):
        archive.writestr("x.npy", head.getvalue())
    assert refusal(file).startswith("is not a saved state: ")


def test_whatever_happens_to_its_bytes(file, tmp_path):
    refused = 0
    for seed in range(500):
        copy = shutil.copy(file, tmp_path / "copy.npz")
        what = hurt_bytes(copy, random.Random(seed))
        try:
            found, _ = read_state(copy, "one of run 3", ARRAYS)
        except RecordError:
            refused += 1
        else:
            assert all(found[name].tobytes() == ARRAYS[name].tobytes() for name in ARRAYS), f"seed {seed}: {what}"
    assert refused > 300
