"""shoal command, as a user gives it."""

import pytest

from commands import shoal
from shoal.buoy.orderer import Answers
from shoal.buoy.trust import key_in

PLACE = "tcp/127.0.0.1:9"


@pytest.fixture
def key(tmp_path):
    key_in(tmp_path / "key")
    return tmp_path / "key"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["sink"], "order: is 'sink'"),
        (["set"], "needs a field and its new value"),
        (["set", "neighbors"], "is not an assignment"),
        (["hold", "neighbors=3"], "takes no fields"),
        (["hold", "--buoy", "-1"], "--buoy"),
        (["hold", "--buoy", "x"], "--buoy"),
        (["hold", "--wait", "0"], "--wait: is 0"),
        ([], "ORDER"),
    ],
)
def test_what_cannot_be_is_one_sentence(capsys, key, words, said):
    code, out, err = shoal(capsys, "command", PLACE, *words, "--key", key)
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert said in err


def test_a_key_is_needed(capsys, tmp_path):
    code, _, err = shoal(capsys, "command", PLACE, "hold")
    assert (code, "--key" in err) == (2, True)
    code, _, err = shoal(capsys, "command", PLACE, "hold", "--key", tmp_path / "none")
    assert (code, "No such file" in err, "Traceback" in err) == (2, True, False)


@pytest.mark.parametrize("place", [PLACE, "127.0.0.1:9", "somewhere", "tcp/", "no/such:thing", ""])
def test_a_place_where_nobody_is(capsys, key, place):
    pytest.importorskip("zenoh", reason="the extra fleet is not installed")
    code, out, err = shoal(capsys, "command", place, "hold", "--key", key, "--wait", "0.3")
    assert (code, out, err.count("\n")) == (2, "", 2)
    assert "no fleet is there" in err or "cannot be a mesh" in err


@pytest.mark.parametrize(
    ("answers", "code", "lines"),
    [
        (Answers({0: 7, 1: 7, 2: 8}, {}, []), 0, ["obeyed from step 7 on: buoys 0-1", "obeyed from step 8 on: buoy 2"]),
        (Answers({}, {4: "it will not", 2: "it will not"}, []), 3, ["refused by buoys 2, 4: it will not"]),
        (Answers({0: 7}, {}, [1, 2]), 3, ["obeyed from step 7 on: buoy 0", "did not answer within 10 s: buoys 1-2"]),
    ],
)  # fmt: skip
def test_who_obeys_is_said_and_the_exit_code_says_whether_all_do(capsys, key, monkeypatch, answers, code, lines):
    class Somebody:
        def __init__(self, *about):
            pass

        def order(self, what, set, agents):
            return answers

    class Mesh:
        def __init__(self, *about, **more):
            pass

        def close(self):
            pass

    monkeypatch.setattr("shoal.buoy.orderer.Orderer", Somebody)
    monkeypatch.setattr("shoal.buoy.zenoh_mesh.ZenohMesh", Mesh)
    assert shoal(capsys, "command", PLACE, "hold", "--key", key) == (code, "\n".join(lines) + "\n", "")


@pytest.mark.parametrize("option", ["--command-key", "--mesh-config"])
def test_a_mesh_in_memory_has_neither_key_nor_configuration(capsys, tmp_path, option):
    code, _, err = shoal(capsys, "fleet", "oceans2020", "--mesh", "memory", option, tmp_path / "file")
    assert (code, f"{option}: is for a mesh between processes" in err) == (2, True)
    assert not (tmp_path / "file").exists()
