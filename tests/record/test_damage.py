"""Whatever happens to a record's files: the numbers that were written, or one clear error."""

import contextlib
import io
import json
import os
import random
import shutil
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest

from damage import hurt_bytes, hurt_json, same_json
from shoal.cli.table import print_record
from shoal.core.errors import RecordError
from shoal.core.version import RESULTS_VERSION
from shoal.record.content import sum_of_content
from shoal.record.files import open_record
from shoal.run.simulate import simulate
from shoal.scenario.load import load
from shoal.viewer.replay import replay_page

DATA = Path(__file__).parents[1] / "data"


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    folder = tmp_path_factory.mktemp("good") / "record"
    simulate(load(str(DATA / "tiny.toml")), runs=2, out=folder)
    return folder


def all_of(folder):
    """Every number of a record, and all it says."""
    record = open_record(folder)
    arrays = {
        f"{run}.{name}": part for run, tally in enumerate(record.tallies) for name, part in tally._asdict().items()
    }
    arrays |= {f"roster.{name}": part for name, part in record.roster._asdict().items()}
    for run, trajectory in record.trajectories.items():
        arrays |= {f"frames.{run}.{name}": part for name, part in trajectory.arrays().items()}
    numbers = {name: (str(part.dtype), part.shape, part.tobytes()) for name, part in arrays.items()}
    return numbers, [record.facts._asdict(), record.scenario.model_dump(mode="json"), record.provenance]


def outcome(folder, right):
    """'same', 'refused', or what is wrong."""
    try:
        numbers, said = all_of(folder)
    except RecordError as error:
        return "refused" if str(folder) == error.args[0] else f"blames {error.args[0]}"
    if numbers == right[0] and same_json(said, right[1]):
        return "same"
    return "wrong numbers taken as right"


def edit_json(folder, edit, *, forge=False):
    content = json.loads((folder / "record.json").read_text())
    content = edit(content) or content
    if forge:
        content["checksum"] = sum_of_content(content)
    (folder / "record.json").write_text(json.dumps(content))


def edit_tallies(folder, edit):
    arrays = dict(np.load(folder / "tallies.npz"))
    edit(arrays)
    np.savez(folder / "tallies.npz", **arrays)


def put_header(file, shape, descr="<f8"):
    with file.open("wb") as stream:
        np.lib.format.write_array_header_1_0(stream, {"descr": descr, "fortran_order": False, "shape": shape})


def announce_200_gigabytes(folder):
    with zipfile.ZipFile(folder / "tallies.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        head = io.BytesIO()
        np.lib.format.write_array_header_1_0(head, {"descr": "<f8", "fortran_order": False, "shape": (25 * 10**9,)})
        archive.writestr("0.batch_steps.npy", head.getvalue() + bytes(100_000))


def both(folder, edit):
    """An edit of record.json that a checksum does not show."""
    edit_json(folder, edit, forge=True)


def put(name, values):
    return lambda folder: np.save(folder / "run-0000" / f"{name}.npy", values)


BOMB = b"\x93NUMPY\x01\x00" + struct.pack("<H", 60000) + b"{'descr':'<f8','fortran_order':False,'shape':("
X = Path("run-0000") / "x.npy"
REFUSED = {
    "json empty": lambda f: (f / "record.json").write_text(""),
    "json list": lambda f: (f / "record.json").write_text("[]"),
    "json 100,000 deep": lambda f: (f / "record.json").write_text("[" * 100_000),
    "json with a number of 5,000 digits": lambda f: (f / "record.json").write_text('{"format": ' + "9" * 5000 + "}"),
    "no format": lambda f: both(f, lambda c: c.pop("format") and None),
    "format 0": lambda f: both(f, lambda c: c.update(format=0)),
    "format 99": lambda f: both(f, lambda c: c.update(format=99)),
    "format true": lambda f: both(f, lambda c: c.update(format=True)),
    "results version 0": lambda f: both(f, lambda c: c["provenance"].update(results_version=0)),
    "results version to come": lambda f: both(f, lambda c: c["provenance"].update(results_version=RESULTS_VERSION + 1)),
    "as if of format 1": lambda f: edit_json(f, lambda c: c.update(format=1)),
    "runs 10**9": lambda f: both(f, lambda c: c["summary"].update(runs=10**9)),
    "runs -1": lambda f: both(f, lambda c: c["summary"].update(runs=-1)),
    "runs 0": lambda f: both(f, lambda c: c["summary"].update(runs=0)),
    "runs 1 of 2": lambda f: both(f, lambda c: c["summary"].update(runs=1)),
    "runs 3 of 2": lambda f: both(f, lambda c: c["summary"].update(runs=3)),
    "unit a word": lambda f: both(f, lambda c: c["facts"].update(unit="x")),
    "unit another": lambda f: both(f, lambda c: c["facts"].update(unit=2.0)),
    "counts edited": lambda f: both(f, lambda c: c["facts"].update(counts=[1, 1])),
    "counts huge": lambda f: both(f, lambda c: c["facts"].update(counts=[10**9, 10**9])),
    "counts swapped": lambda f: both(f, lambda c: c["facts"].update(counts=[3, 2])),
    "a fact more": lambda f: both(f, lambda c: c["facts"].update(mood=1)),
    "scenario gone": lambda f: both(f, lambda c: c.pop("scenario") and None),
    "scenario empty": lambda f: both(f, lambda c: c.update(scenario={})),
    "scenario without fleets": lambda f: both(f, lambda c: c["scenario"].update(fleets=[])),
    "scenario without targets": lambda f: both(f, lambda c: c["scenario"].update(targets=[])),
    "width a word": lambda f: both(f, lambda c: c["scenario"]["area"].update(width="x")),
    "width 0": lambda f: both(f, lambda c: c["scenario"]["area"].update(width=0)),
    "seed another": lambda f: both(f, lambda c: c["scenario"].update(seed=2)),
    "steps another": lambda f: both(f, lambda c: c["scenario"].update(steps=9)),
    "provenance empty": lambda f: both(f, lambda c: c.update(provenance={})),
    "seconds a word": lambda f: both(f, lambda c: c["provenance"].update(seconds="fast")),
    "notes a number": lambda f: both(f, lambda c: c["provenance"].update(notes=5)),
    "time step NaN": lambda f: edit_json(f, lambda c: c["facts"].update(time_step=float("nan"))),
    "record.json a folder": lambda f: ((f / "record.json").unlink(), (f / "record.json").mkdir()),
    "tallies are .npy": lambda f: (f / "tallies.npz").write_bytes((f / X).read_bytes()),
    "tallies of 200 GB": announce_200_gigabytes,
    "tallies of 7": lambda f: edit_tallies(f, lambda a: a.update({name: np.zeros(7) for name in a})),
    "tallies 0-d": lambda f: edit_tallies(f, lambda a: a.update({name: np.float64(1) for name in a})),
    "tallies of words": lambda f: edit_tallies(f, lambda a: a.update({name: np.array(["x"]) for name in a})),
    "tallies NaN": lambda f: edit_tallies(f, lambda a: a.update({name: each * np.nan for name, each in a.items()})),
    "tallies one more": lambda f: edit_tallies(f, lambda a: a["0.engaged"].__setitem__(0, 1 + a["0.engaged"][0])),
    "x a zip": lambda f: (f / X).write_bytes((f / "tallies.npz").read_bytes()),
    "x of 400 TB": lambda f: put_header(f / X, (10**12, 50)),
    "x of -5 rows": lambda f: put_header(f / X, (-5, 5)),
    "x of 2**80": lambda f: put_header(f / X, (2**40, 2**40)),
    "x of 7 rows": put("x", np.zeros((7, 5))),
    "x of 3 columns": put("x", np.zeros((8, 3))),
    "x 1-d": put("x", np.zeros(8)),
    "x of words": put("x", np.full((8, 5), "a")),
    "x NaN": put("x", np.full((8, 5), np.nan)),
    "x another": put("x", np.zeros((8, 5))),
    "x in columns": put("x", np.asfortranarray(np.zeros((8, 5)))),
    "x endless": lambda f: ((f / X).unlink(), (f / X).symlink_to("/dev/zero")),
    "x a pipe": lambda f: ((f / X).unlink(), os.mkfifo(f / X)),
    "x with brackets in its head": lambda f: (f / X).write_bytes(BOMB + b"(" * 9000 + b")" * 9000),
    "steps backwards": put("step", np.arange(8)[::-1].copy()),
    "steps of floats": put("step", np.linspace(0, 1, 8)),
    "steps huge": put("step", np.full(8, 2**62)),
    "a run gone": lambda f: shutil.rmtree(f / "run-0000"),
}  # fmt: skip
HARMLESS = {
    "facts in another order": lambda c: c.update(facts=dict(reversed(c["facts"].items()))),
    "keys sorted": lambda c: json.loads(json.dumps(c, sort_keys=True)),
}


class TestRefused:
    """The kinds that once were tracebacks, or were taken as right."""

    @pytest.mark.parametrize("damage", REFUSED)
    def test_by_one_error(self, good, tmp_path, damage):
        folder = shutil.copytree(good, tmp_path / "record")
        REFUSED[damage](folder)
        assert outcome(folder, all_of(good)) == "refused"

    def test_a_newer_shoal_is_told_apart_from_damage(self, good, tmp_path):
        folder = shutil.copytree(good, tmp_path / "record")
        REFUSED["format 99"](folder)
        with pytest.raises(RecordError, match=r"(?s)is of format 99; this Shoal .* install a newer Shoal"):
            open_record(folder)

    @pytest.mark.parametrize("edit", HARMLESS)
    def test_but_not_where_nothing_else_is_said(self, good, tmp_path, edit):
        folder = shutil.copytree(good, tmp_path / "record")
        edit_json(folder, HARMLESS[edit])
        assert outcome(folder, all_of(good)) == "same"

    def test_files_that_somebody_adds_change_nothing(self, good, tmp_path):
        folder = shutil.copytree(good, tmp_path / "record")
        (folder / "notes.txt").write_text("looks good")
        (folder / "run-abc").mkdir()
        shutil.copytree(folder / "run-0000", folder / "run-0009")
        np.save(folder / "run-0000" / "zzz.npy", np.zeros(3))
        assert outcome(folder, all_of(good)) == "same"


def hurt(folder, chance):
    """Change something in a record's folder; return what."""
    files = sorted(file for file in folder.rglob("*") if file.is_file())
    file = chance.choice([*files, *[folder / "record.json", folder / "tallies.npz"] * 5])
    what = chance.choice(("bytes", "bytes", "json", "json", "tallies", "frames", "exchange"))
    match what:
        case "bytes":
            return f"{file.name}: {hurt_bytes(file, chance)}"
        case "json":
            said = []
            edit_json(folder, lambda content: said.append(hurt_json(content, chance)), forge=chance.random() < 0.3)
            return f"json {said}"
        case "tallies":
            edit_tallies(folder, lambda arrays: hurt_arrays(arrays, chance))
        case "frames":
            run = chance.choice([each for each in folder.iterdir() if each.is_dir()])
            arrays = {each.stem: np.load(each) for each in run.iterdir()}
            hurt_arrays(arrays, chance)
            shutil.rmtree(run)
            run.mkdir()
            for name, values in arrays.items():
                np.save(run / f"{name}.npy", values)
        case "exchange":
            other = chance.choice(files)
            one, two = file.read_bytes(), other.read_bytes()
            file.write_bytes(two)
            other.write_bytes(one)
    return what


def hurt_arrays(arrays, chance):
    name, other = chance.choice(sorted(arrays)), chance.choice(sorted(arrays))
    values = arrays[name]
    match chance.choice(("number", "nan", "negative", "reshape", "kind", "rows", "gone", "swap", "more", "columns")):
        case "number":
            values = values.copy()
            values.flat[chance.randrange(values.size)] += 1
        case "nan":
            values = values.astype(float)
            values.flat[chance.randrange(values.size)] = np.nan
        case "negative":
            values = values.astype(float) * -1
        case "reshape":
            values = values.reshape(-1)
        case "kind":
            values = values.astype(chance.choice(("f4", "i4", "?", "U3", "c16", ">f8")))
        case "rows":
            values = values[: chance.randrange(len(values))]
        case "gone":
            del arrays[name]
            return
        case "swap":
            arrays[other], values = values, arrays[other]
        case "more":
            arrays[f"{name}_too"] = values
            return
        case "columns":
            values = np.asfortranarray(values)
    arrays[name] = values


class TestFuzz:
    """400 seeded mutations of a record."""

    @pytest.mark.slow
    def test_no_wrong_number_is_taken_as_right(self, good, tmp_path):
        right, count = all_of(good), {"same": 0, "refused": 0}
        for seed in range(400):
            chance = random.Random(seed)
            folder = shutil.copytree(good, tmp_path / f"r{seed}")
            what = hurt(folder, chance)
            found = outcome(folder, right)
            if found not in count and "json" in what:  # its checksum was forged: then only words may differ
                numbers = all_of(folder)[0]
                assert numbers.items() <= right[0].items(), f"seed {seed}: {what}"
                show_all(folder)
                found = "same"
            assert found in count, f"seed {seed}, {what}: {found}"
            count[found] += 1
            shutil.rmtree(folder)
        assert count["refused"] > 280

    @pytest.mark.slow
    @pytest.mark.parametrize("name", ["record", "every"])
    def test_records_of_format_1_which_has_no_checksums_never_end_in_a_traceback(self, tmp_path, name):
        refused = 0
        for seed in range(100):
            folder = shutil.copytree(DATA / "results-v1" / name, tmp_path / f"r{seed}")
            hurt(folder, random.Random(seed))
            try:
                show_all(folder)
            except RecordError:
                refused += 1
            shutil.rmtree(folder)
        assert refused > 50


def show_all(folder):
    """What shoal show and shoal replay do with a record."""
    record = open_record(folder)
    with contextlib.redirect_stdout(io.StringIO()):
        print_record(record)
    json.dumps(record.summary())
    if record.trajectories:
        replay_page(record, frames=4)
