import csv
import re
from html.parser import HTMLParser

import pytest

from shoal.core.errors import RecordError
from shoal.drawing.style import new_figure, style
from shoal.paper.report import to_csv, write_report
from shoal.paper.report_tables import interval_text, number_text
from shoal.paper.results import Claim, Figure, Reproduction

NAN = float("nan")
VOID = {"meta", "link", "img", "br", "hr"}


class Page(HTMLParser):
    """What a browser would see: ids, links, sources, text; and whether tags are closed."""

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.links, self.sources, self.tags, self.text = [], [], [], [], set(), ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        found = dict(attrs)
        self.ids += [found["id"]] if "id" in found else []
        self.links += [found["href"]] if "href" in found else []
        self.sources += [found["src"]] if "src" in found else []
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data


def a_figure(name="tot_k"):
    with style():
        figure = new_figure(3.5, 2.0)
        figure.subplots().plot([1, 2], [3, 4])
    return Figure(name, "Time & target", "A line.", figure, [{"k": 1, "mean": 3.0}, {"k": 2, "mean": 4.0, "low": NAN}])


def a_claim(id_="C3", verdict="holds", **more):
    known = {
        "statement": "k* is about <18>",
        "measured": "k* is -18.2 & k >= 3",
        "value": 18.2,
        "low": 17.1,
        "high": 19.3,
    }
    return Claim(id_, **(known | {"unit": "k", "figure": "tot_k"} | more), verdict=verdict)


def a_reproduction(**more):
    rows = [{"fast": 15, "neighbors": 20, "target_speed": 3.0, "run": run, "status": "done"} for run in range(2)]
    known = {
        "claims": [a_claim(), a_claim("C7", "does not hold", figure="gone", value=NAN)],
        "figures": [a_figure()],
        "tables": {"peaks": [{"fast": 15, "k_star": 18.2, "k_star_low": 17.1, "k_star_high": 19.3, "at_edge": False}]},
        "command": "shoal reproduce oceans2020 --out 'a & b'",
        "versions": {"shoal": "0.1.0", "numpy": "2.4"},
        "seconds": 312.0,
    }
    return Reproduction("oceans2020", False, 100_000, 5, rows, [], **(known | more))


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    folder = tmp_path_factory.mktemp("report") / "new"
    (folder / "runs" / "main").mkdir(parents=True)
    (folder / "runs" / "main" / "runs.sqlite").touch()
    assert write_report(a_reproduction(), folder) == folder / "report.html"
    return folder


@pytest.fixture(scope="module")
def page(out):
    return Page((out / "report.html").read_text(encoding="utf-8"))


class TestPage:
    def test_needs_no_network_no_script_and_no_other_file(self, out, page):
        text = (out / "report.html").read_text(encoding="utf-8")
        assert "script" not in page.tags
        assert all(source.startswith("data:image/") for source in page.sources)
        assert not re.search(r"https?://|@import|url\(", text)
        assert len(text) < 5_000_000

    def test_closes_its_tags(self, page):
        assert page.open == []

    def test_every_link_leads_somewhere(self, out, page):
        assert len(page.ids) == len(set(page.ids))
        for link in page.links:
            assert link == "data:," or (link[1:] in page.ids if link[0] == "#" else (out / link).is_file()), link

    def test_text_is_escaped(self, page):
        assert "k* is about <18>" in page.text
        assert "shoal reproduce oceans2020 --out 'a & b'" in page.text
        assert "Time & target" in page.text

    def test_shows_claims_with_numbers_verdicts_and_figures(self, page):
        assert "k* is −18.2 & k ≥ 3" in page.text
        assert "Key number: 18.2\u00a0[17.1,\u00a019.3]\u00a0k" in page.text
        assert "#figure-tot_k" in page.links
        assert "#figure-gone" not in page.links
        assert "#claim-C3" in page.links

    def test_counts_the_cases_of_a_claim(self, tmp_path):
        found = a_reproduction(claims=[a_claim("C1", true=79, open=3)])
        page = Page(write_report(found, tmp_path).read_text(encoding="utf-8"))
        assert re.search(r"holds\s*79 true, 3 open, 0 false", page.text)

    def test_counts_verdicts(self, page):
        assert re.search(r"Of 2 claims.*1✓ holds0◐ holds partly1✗ does not hold0\? undecided", page.text, re.S)

    def test_says_what_was_run_and_where_the_rows_are(self, page):
        for told in ("2 of 100\u2009000 steps", "5 seeds", "5.2 min", "numpy 2.4", "runs/main", "data/tot_k.csv"):
            assert told in page.text

    def test_says_how_verdicts_were_reached(self, page):
        assert "None false: the claim holds." in page.text

    def test_warns_of_a_quick_run_alone(self, page, tmp_path):
        assert "quick run" not in page.text
        report = write_report(_quick(), tmp_path)
        assert "This is a quick run" in report.read_text(encoding="utf-8")

    def test_is_the_same_twice(self, out, tmp_path):
        (tmp_path / "runs" / "main").mkdir(parents=True)
        (tmp_path / "runs" / "main" / "runs.sqlite").touch()
        again = write_report(a_reproduction(), tmp_path)
        assert again.read_bytes() == (out / "report.html").read_bytes()

    def test_of_nothing_is_still_a_page(self, tmp_path):
        nothing = Reproduction("other <paper>", True, 10, 1, [], [])
        page = Page(write_report(nothing, tmp_path).read_text(encoding="utf-8"))
        assert "other <paper>" in page.text
        assert (
            tmp_path / "claims.csv"
        ).read_text() == "id,statement,measured,value,low,high,unit,verdict,figure,true,open,false\n"
        assert (tmp_path / "command.txt").read_text().startswith("shoal reproduce 'other <paper>'\n")

    def test_a_picture_too_big_as_svg_is_inlined_as_png(self, tmp_path, monkeypatch):
        monkeypatch.setattr("shoal.paper.report.LARGEST_SVG", 100)
        page = Page(write_report(a_reproduction(), tmp_path).read_text(encoding="utf-8"))
        assert page.sources[0].startswith("data:image/png;base64,")


class TestFiles:
    def test_are_all_there_and_whole(self, out):
        names = {file.relative_to(out).as_posix() for file in out.rglob("*") if file.is_file()}
        assert names == {
            "report.html", "claims.csv", "command.txt", "figures/tot_k.svg", "figures/tot_k.png", "data/tot_k.csv",
            "data/table_peaks.csv", "runs/main/runs.sqlite",
        }  # fmt: skip

    def test_claims_are_one_row_each(self, out):
        rows = list(csv.DictReader((out / "claims.csv").read_text(encoding="utf-8").splitlines()))
        assert [row["id"] for row in rows] == ["C3", "C7"]
        assert rows[0]["statement"] == "k* is about <18>"
        assert rows[1]["value"] == ""

    def test_numbers_of_a_figure_have_the_columns_of_all_rows(self, out):
        assert (out / "data" / "tot_k.csv").read_text() == "k,mean,low\n1,3.0,\n2,4.0,\n"

    def test_command_and_versions_are_written_as_given(self, out):
        text = (out / "command.txt").read_text()
        assert text.splitlines()[0] == "shoal reproduce oceans2020 --out 'a & b'"
        assert "# numpy 2.4" in text

    def test_a_folder_that_cannot_be_made_is_an_error_that_says_so(self, tmp_path):
        (tmp_path / "file").touch()
        with pytest.raises(RecordError, match="cannot be used"):
            write_report(a_reproduction(), tmp_path / "file" / "out")

    def test_rows_of_different_columns_share_a_table(self):
        assert to_csv([{"a": 1}, {"b": NAN}, {"a": None, "b": "x,y"}]) == 'a,b\n1,\n,\n,"x,y"\n'


class TestNumbers:
    @pytest.mark.parametrize(
        ("value", "low", "high", "text"),
        [
            (0.83176, 0.8291, 0.8352, "0.8318 [0.8291, 0.8352]"),
            (-0.5, -1.81, 0.73, "−0.5 [−1.8, 0.7]"),
            (75.0, 50.0, 130.0, "75 [50, 130]"),
            (18.0, 18.0, 18.0, "18 [18, 18]"),
            (0.5, NAN, NAN, "0.500"),
        ],
    )
    def test_show_the_digits_that_their_interval_lets_stand(self, value, low, high, text):
        assert interval_text(value, low, high).replace("\u00a0", " ") == text

    def test_alone_have_three_digits(self):
        assert [number_text(each) for each in (20, 20.0, -0.00355, 3.14159, NAN)] == [
            "20",
            "20",
            "−0.00355",
            "3.14",
            "–",
        ]


def _quick():
    reproduction = a_reproduction()
    reproduction.quick = True
    return reproduction
