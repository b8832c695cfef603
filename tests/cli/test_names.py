"""Names are text everywhere: no markup, no orders to a terminal, no formulas, no HTML."""

import json
from pathlib import Path

import pytest

from commands import shoal
from shoal.cli.main import BAD_INPUT, run_command
from shoal.cli.table import print_record
from shoal.record.content import sum_of_content
from shoal.record.files import open_record
from shoal.scenario.load import preset_text

NAMES = [
    "[/b]",
    "[bold]F[/zz]",
    "[link=x]y[/link]",
    ":smile:",
    "$\\frac{",
    "<script>alert(1)</script>",
    "_quiet",
    "{0} %s",
]
ESCAPES = "\x1b]0;pwn\x07\x1b[31m\x1b[2J\u202e\n"


def write_scenario(name, fleet):
    text = preset_text("oceans2020").replace('name = "oceans2020"', f"name = {json.dumps(name)}")
    Path("named.toml").write_text(text.replace('"BoB-1"', json.dumps(fleet)), encoding="utf-8")


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    folder = tmp_path_factory.mktemp("names") / "record"
    assert run_command(["run", "oceans2020", "--steps", "40", "--out", str(folder), "--json"]) == 0
    return folder


@pytest.fixture
def renamed(record, tmp_path):
    """A function that makes the record as somebody could send it: with other names."""

    def make(scenario, fleet):
        for file in record.rglob("*"):
            if file.is_file():
                copy = tmp_path / "sent" / file.relative_to(record)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.write_bytes(file.read_bytes())
        about = tmp_path / "sent" / "record.json"
        text = about.read_text()
        for old, new in (("oceans2020", scenario), ("BoB-1", fleet)):
            text = text.replace(f'"{old}"', json.dumps(new))
        content = json.loads(text)
        content["checksum"] = sum_of_content(content)  # whoever sends a record can do so, too
        about.write_text(json.dumps(content))
        return about.parent

    return make


class TestMarkup:
    @pytest.mark.parametrize("name", NAMES)
    def test_a_name_is_printed_as_it_is(self, name, renamed, capsys):
        print_record(open_record(renamed(name, name)), everything=True)
        out = capsys.readouterr().out
        assert f"\n{name}: 15 {name} (2.6 m/s)" in out
        assert f"fleet {name}"[:27] in out

    def test_a_run_shows_it_too(self, capsys):
        write_scenario("[/b]", "[/zz]")
        code, out, _ = shoal(capsys, "run", "named.toml", "--steps", 40, "--out", "r")
        assert code == 0
        assert "\n[/b]: 15 [/zz] (2.6 m/s)" in out
        assert shoal(capsys, "show", "r")[1].splitlines()[:3] == out.splitlines()[:3]


class TestControl:
    """Characters that hide."""

    @pytest.mark.parametrize("field", ["name", "fleets.0.name"])
    @pytest.mark.parametrize("name", ["\x1b[2J", "a\u202eb", "a\nb"])
    def test_are_refused_in_a_name(self, field, name, capsys):
        code, _, err = shoal(capsys, "run", "oceans2020", "--set", f"{field}={json.dumps(name)}")
        assert code == BAD_INPUT
        assert f"{field}: {name!r} holds the control character" in err
        assert name not in err

    def test_of_a_record_that_was_sent_never_reach_the_terminal(self, renamed, capsys):
        code, out, err = shoal(capsys, "show", renamed(ESCAPES, ESCAPES))
        assert code == 0
        assert "\n" + r"\x1b]0;pwn\x07\x1b[31m\x1b[2J\u202e\n: 15 \x1b]0" in out
        assert not set(ESCAPES[:-1]) & {"\x1b", "\x07", "\u202e"} & set(out + err)

    def test_of_arguments_never_reach_it_in_an_error(self, capsys):
        for command in (["run", ESCAPES], ["run", "oceans2020", "--set", f"{ESCAPES}=1"], ["show", ESCAPES], [ESCAPES]):
            code, out, err = shoal(capsys, *command)
            assert (code, out) == (BAD_INPUT, "")
            assert not {"\x1b", "\x07", "\u202e"} & set(err)

    def test_of_a_folder_never_reach_it_in_a_note(self, capsys):
        code, _, err = shoal(capsys, "run", "oceans2020", "--steps", 3, "--out", "a\x1b[31m", "--json")
        assert code == 0
        assert r"record: a\x1b[31m" in err


class TestFigures:
    def test_hold_names_as_text(self, renamed, capsys):
        pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")
        from shoal import plot

        figure = plot.summary(open_record(renamed("$\\frac{", "_quiet")))
        legends = [text.get_text() for axes in figure.axes for legend in [axes.get_legend()] if legend
                   for text in legend.get_texts()]  # fmt: skip
        assert figure.texts[0].get_text() == "$\\frac{"
        assert sum(text.strip().startswith("_quiet") for text in legends) == 2
        assert shoal(capsys, "show", renamed(ESCAPES, ESCAPES), "--figure", "f.svg")[0] == 0

    def test_a_page_holds_them_as_data(self, renamed, capsys):
        assert shoal(capsys, "replay", renamed("</script><script>alert(1)</script>", "<b>"), "--out", "p.html")[0] == 0
        page = Path("p.html").read_text()
        assert "alert(1)" in page
        assert "<script>alert" not in page
