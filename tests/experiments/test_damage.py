"""Whatever happens to a store: the numbers that were written, or one clear error."""

import json
import os
import random
import shutil
import sqlite3
from pathlib import Path

import pytest

from damage import NASTY, hurt_bytes, hurt_json, same_json
from shoal.core.errors import RecordError
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.cells import base_table, make_cells
from shoal.experiments.design import Design, grid
from shoal.experiments.results import aggregate, read_rows, to_csv
from shoal.experiments.rows import failed_row
from shoal.experiments.store import Store
from shoal.experiments.sweep import sweep
from shoal.metrics.summary import METRICS

DATA = Path(__file__).parents[1] / "data"
DESIGN = Design(str(DATA / "tiny.toml"), tuple(grid({"neighbors": [1, 2, 3]})), 3)
IDENTITY = {
    "scenario": base_table(DESIGN, {}),
    "fields": DESIGN.fields,
    "changes": {},
    "independent": False,
    "results_version": RESULTS_VERSION,
    "metrics": list(METRICS),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    folder = tmp_path_factory.mktemp("good") / "store"
    sweep(DESIGN, folder)
    with Store(folder, IDENTITY) as store:
        store.add([(make_cells(DESIGN, {})[0], 3, failed_row("division by zero"))])
    return folder


def outcome(folder, right):
    """'same', 'refused', or what is wrong; read as shoal results does, and opened as shoal sweep does."""
    found = set()
    for read in (read_rows, resumed) if (folder / "runs.sqlite").exists() else (read_rows,):
        try:
            same = same_json(read(folder), right)
        except RecordError as error:
            found.add("refused" if str(folder) == error.args[0] else f"blames {error.args[0]}")
        else:
            found.add("same" if same else "wrong numbers taken as right")
    return found.pop() if len(found) == 1 else " and ".join(sorted(found))


def resumed(folder):
    with Store(folder, IDENTITY) as store:
        return store.fields, store.rows()


def sql(*commands):
    def damage(folder):
        database = sqlite3.connect(folder / "runs.sqlite", isolation_level=None)
        for command in commands:
            database.execute(*command) if isinstance(command, tuple) else database.execute(command)
        database.close()

    return damage


def cut(size):
    return lambda folder: os.truncate(folder / "runs.sqlite", size)


def garble(folder):
    content = (folder / "runs.sqlite").read_bytes()
    (folder / "runs.sqlite").write_bytes(content[:4096] + random.Random(1).randbytes(len(content) - 4096))


REFUSED = {
    "text": lambda folder: (folder / "runs.sqlite").write_text("hello" * 500),
    "empty": cut(0),
    "cut short": cut(6000),
    "garbled": garble,
    "no table runs": sql("DROP TABLE runs"),
    "no table meta": sql("DROP TABLE meta"),
    "no column": sql("ALTER TABLE runs DROP COLUMN xi"),
    "a view": sql("ALTER TABLE runs RENAME TO r", "CREATE VIEW runs AS SELECT * FROM r"),
    "a trigger": sql("CREATE TRIGGER t AFTER INSERT ON runs BEGIN DELETE FROM meta; END"),
    "meta empty": sql("DELETE FROM meta"),
    "meta without a checksum": sql("DELETE FROM meta WHERE name = 'checksum'"),
    "meta without content": sql("DELETE FROM meta WHERE name = 'content'"),
    "as if of format 1": sql("DELETE FROM meta WHERE name = 'format'"),
    "point no JSON": sql("UPDATE runs SET point = '{'"),
    "point a list": sql("UPDATE runs SET point = '[1]'"),
    "metric a word": sql("UPDATE runs SET time_on_target = 'x'"),
    "metric another": sql("UPDATE runs SET time_on_target = time_on_target + 1e-12"),
    "metric none": sql("UPDATE runs SET time_on_target = NULL"),
    "metrics exchanged": sql("UPDATE runs SET xi = xi_raw, xi_raw = xi"),
    "status odd": sql("UPDATE runs SET status = 'odd'"),
    "all failed": sql("UPDATE runs SET status = 'failed', error = 'boom'"),
    "none failed": sql("UPDATE runs SET status = 'done', error = ''"),
    "list no JSON": sql("UPDATE runs SET phi_histogram = 'x'"),
    "a row gone": sql("DELETE FROM runs WHERE run = 1 AND status = 'done' AND point LIKE '%2%'"),
    "all rows gone": sql("DELETE FROM runs"),
    "fields a number": sql("UPDATE meta SET value = '5' WHERE name = 'fields'"),
    "fields another": sql("UPDATE meta SET value = '[\"fast\"]' WHERE name = 'fields'"),
    "format 99": sql("UPDATE meta SET value = '99' WHERE name = 'format'"),
    "results version 0": sql("UPDATE meta SET value = '0' WHERE name = 'results_version'"),
    "a folder": lambda folder: ((folder / "runs.sqlite").unlink(), (folder / "runs.sqlite").mkdir()),
}  # fmt: skip


class TestRefused:
    """The kinds that once were tracebacks, or were taken as right."""

    @pytest.mark.parametrize("damage", REFUSED)
    def test_by_one_error(self, good, tmp_path, damage):
        folder = shutil.copytree(good, tmp_path / "store")
        REFUSED[damage](folder)
        assert outcome(folder, read_rows(good)) == "refused"

    def test_a_newer_shoal_is_told_apart_from_damage(self, good, tmp_path):
        folder = shutil.copytree(good, tmp_path / "store")
        REFUSED["format 99"](folder)
        with pytest.raises(RecordError, match=r"(?s)is of format 99; this Shoal .* install a newer Shoal"):
            read_rows(folder)

    def test_nothing_is_added_to_a_damaged_store(self, good, tmp_path):
        folder = shutil.copytree(good, tmp_path / "store")
        REFUSED["metric another"](folder)
        before = (folder / "runs.sqlite").read_bytes()
        with pytest.raises(RecordError, match="is not what was written"):
            sweep(Design(DESIGN.scenario, DESIGN.points, 4), folder)
        assert (folder / "runs.sqlite").read_bytes() == before

    def test_a_run_that_is_done_again_replaces_its_row(self, good, tmp_path):
        folder = shutil.copytree(good, tmp_path / "store")
        more = Design(DESIGN.scenario, DESIGN.points, 4)
        rows = sweep(more, folder, retry_failed=True)
        assert [row["status"] for row in rows] == ["done"] * 12
        assert same_json(read_rows(folder)[1], rows)

    def test_where_nothing_can_be_written_it_is_read(self, good, tmp_path, monkeypatch):
        folder = shutil.copytree(good, tmp_path / "store")
        monkeypatch.setattr("shoal.experiments.store.os.access", lambda *_: False)
        assert same_json(read_rows(folder), read_rows(good))
        assert sorted(each.name for each in folder.iterdir()) == ["runs.sqlite"]


def hurt(folder, chance):
    """Change something in a store; return what."""
    file = folder / "runs.sqlite"
    what = chance.choice(("bytes", "bytes", "page", "value", "value", "json", "row", "exchange", "table", "journal"))
    database = sqlite3.connect(file, isolation_level=None)
    columns = [row[1] for row in database.execute("PRAGMA table_info(runs)")]
    column, other, row = chance.choice(columns), chance.choice(columns), chance.randrange(1, 11)
    match what:
        case "value":
            nasty = chance.choice([each for each in NASTY if not isinstance(each, (list, dict))])
            nasty = chance.choice((nasty, chance.random(), str(nasty)))
            if isinstance(nasty, str):
                nasty = nasty.encode("utf-8", "replace").decode()
            if isinstance(nasty, int) and abs(nasty) >= 2**63:
                nasty = float(nasty)
            database.execute(f"UPDATE OR IGNORE runs SET {column} = ? WHERE rowid = ?", (nasty, row))
            what = f"{column} = {nasty!r}"
        case "json":
            name, value = chance.choice(database.execute("SELECT name, value FROM meta").fetchall())
            tree = [json.loads(value) if value[:1] in "{[" else value]
            what = f"{name}: {hurt_json(tree, chance)}"
            text = json.dumps(tree[0] if tree else None)
            database.execute("UPDATE meta SET value = ? WHERE name = ?", (text, name))
        case "row":
            database.execute("DELETE FROM runs WHERE rowid = ?", (row,))
            if chance.random() < 0.5:
                database.execute(
                    "INSERT INTO runs SELECT * FROM (SELECT 'other' || run_id, "
                    f"{', '.join(columns[1:])} FROM runs LIMIT 1)"
                )
        case "exchange":
            database.execute(f"UPDATE OR IGNORE runs SET {column} = {other}, {other} = {column}")
        case "table":
            table = chance.choice(("runs", "meta"))
            database.execute(
                chance.choice(
                    (
                        f"DROP TABLE {table}",
                        f"ALTER TABLE {table} RENAME TO other",
                        f"ALTER TABLE runs RENAME COLUMN {column} TO other",
                        f"DELETE FROM {table}",
                        "ALTER TABLE runs ADD COLUMN other",
                    )
                )
            )
    database.close()
    match what:
        case "bytes":
            what = hurt_bytes(file, chance)
        case "page":
            content = bytearray(file.read_bytes())
            one, two = (4096 * chance.randrange(len(content) // 4096) for _ in range(2))
            content[one : one + 4096], content[two : two + 4096] = content[two : two + 4096], content[one : one + 4096]
            file.write_bytes(content)
        case "journal":
            kind = chance.choice(("-journal", "-wal", "-shm"))
            content = chance.choice((chance.randbytes(8192), file.read_bytes(), bytes(5000)))
            file.with_name(file.name + kind).write_bytes(content)
    return what


class TestFuzz:
    """1,000 seeded mutations of a store."""

    @pytest.mark.slow
    def test_no_wrong_number_is_taken_as_right(self, good, tmp_path):
        right = read_rows(good)
        count = {"same": 0, "refused": 0, "refused and same": 0}  # last: where only who resumes it looks
        for seed in range(1000):
            folder = shutil.copytree(good, tmp_path / f"s{seed}")
            what = hurt(folder, random.Random(seed))
            found = outcome(folder, right)
            assert found in count, f"seed {seed}, {what}: {found}"
            count[found] += 1
            shutil.rmtree(folder)
        assert count["refused"] > 500

    @pytest.mark.slow
    @pytest.mark.parametrize("name", ["sweep", "compare"])
    def test_stores_of_format_1_which_has_no_checksums_never_end_in_a_traceback(self, tmp_path, name):
        refused = 0
        for seed in range(250):
            folder = shutil.copytree(DATA / "results-v1" / name, tmp_path / f"s{seed}")
            hurt(folder, random.Random(seed))
            try:
                fields, rows = read_rows(folder)
                to_csv(aggregate(rows, fields)), to_csv(rows)
            except RecordError:
                refused += 1
            shutil.rmtree(folder)
        assert refused > 75
