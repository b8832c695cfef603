"""The study with tiny runs: screen, finalists, the choice, the files."""

import csv

import pytest

from shoal.cli.main import run_command
from shoal.core.errors import RecordError, ScenarioError
from shoal.paper import readings_study as module
from shoal.paper.readings import printed, readings
from shoal.paper.readings_plan import Trial
from shoal.paper.readings_study import Scored
from shoal.paper.reproduce import reproduce
from shoal.paper.results import Claim

SHORT = (10, 20, 30, 40, 49)


@pytest.fixture(scope="module", autouse=True)
def _tiny():
    """Four readings, the printed one last, so that its place in the list wins it nothing."""
    chosen = [readings()[number] for number in (2, 16, 18, 0)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "readings", lambda: chosen)
        patch.setattr(module, "SCREEN", Trial("screen", 200, 2, SHORT))
        patch.setattr(module, "FINAL", Trial("final", 300, 2, SHORT))
        patch.setattr(module, "FINALISTS", 2)
        yield


@pytest.fixture(scope="module")
def out(tmp_path_factory):
    return tmp_path_factory.mktemp("study")


@pytest.fixture(scope="module")
def study(out):
    return reproduce("oceans2020", out, readings=True)


def test_every_reading_is_screened_and_the_best_two_and_the_printed_one_go_on(study):
    scores = study.tables["readings_scores"]
    screen, final = ([row for row in scores if row["trial"] == stage] for stage in ("screen", "final"))
    assert len(screen) == 4
    best = sorted(screen, key=lambda row: -row["score"])[:2]
    assert {row["reading"] for row in final} >= {printed().name}
    assert 2 <= len(final) <= 3
    worst_finalist = min(row["score"] for row in screen if row["finalist"] and not row["printed"])
    assert worst_finalist >= best[-1]["score"]
    assert [row["score"] for row in screen] == sorted((row["score"] for row in screen), reverse=True)


def test_chosen_is_the_finalist_under_which_most_statements_hold(study):
    final = [row for row in study.tables["readings_scores"] if row["trial"] == "final"]
    (chosen,) = (row for row in final if row["chosen"])
    assert chosen["hold"] == max(row["hold"] for row in final)


def test_the_file_has_a_row_per_reading_statement_and_speed(study, out):
    with (out / "readings.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["reading", "statement", "target_speed", "value", "low", "high", "verdict", "chosen"]
    assert len({row["reading"] for row in rows}) == 4
    assert {row["statement"] for row in rows} == {f"C{number}" for number in range(1, 14)}
    assert {row["target_speed"] for row in rows} == {"3", "5", "both"}
    assert len({(row["reading"], row["statement"], row["target_speed"]) for row in rows}) == len(rows)
    assert len({row["reading"] for row in rows if row["chosen"] == "True"}) == 1


def test_the_report_has_the_table_and_the_figure(study, out):
    page = (out / "report.html").read_text()
    assert "Which reading of the paper?" in page
    assert 'id="figure-readings"' in page
    assert (out / "figures" / "readings.png").is_file()
    assert study.command == f"shoal reproduce oceans2020 --readings --out {out}"


def test_ties_go_to_more_that_hold_then_to_fewer_departures():
    def scored(number, *verdicts):
        claims = {
            (f"C{at}", "both"): Claim(f"C{at}", "", "", 0, 0, 0, "1", verdict, "")
            for at, verdict in enumerate(verdicts, 1)
        }
        return Scored(readings()[number], Trial("final", 300, 2), claims, [])

    near, far, more = (
        scored(2, "holds", "undecided"),
        scored(1, "holds partly", "holds partly"),
        scored(18, "holds", "holds"),
    )
    assert min((near, far, more), key=lambda each: each.order) is more
    assert min((near, far), key=lambda each: each.order) is near
    equal = [scored(number, "holds", "undecided") for number in (18, 2)]
    assert min(equal, key=lambda each: each.order) is equal[1]


def test_another_paper_has_no_readings(tmp_path):
    with pytest.raises(ScenarioError, match="leave out --readings"):
        reproduce("aamas2020", tmp_path / "new", readings=True)
    assert not (tmp_path / "new").exists()


def test_a_folder_of_the_study_is_not_one_of_the_claims(out, study):
    with pytest.raises(RecordError, match="oceans2020-readings"):
        reproduce("oceans2020", out)


def test_again_it_runs_nothing_and_the_command_prints_who_is_best(out, study, capsys):
    assert run_command(["reproduce", "oceans2020", "--readings", "--out", str(out)]) == 0
    told, noted = capsys.readouterr()
    assert "chosen" in told
    assert printed().name in told
    assert "runs/s" not in noted
