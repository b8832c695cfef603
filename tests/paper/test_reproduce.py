"""From nothing to verdicts with tiny runs: every sweep, resumed, refused, interrupted."""

import json

import pytest

from shoal.cli.main import run_command
from shoal.core.errors import RecordError, ScenarioError
from shoal.experiments.design import Design, grid
from shoal.experiments.results import read_rows
from shoal.paper import reproduce as module
from shoal.paper.plan import Group, Plan
from shoal.paper.reproduce import reproduce
from shoal.paper.running import run_plan

STEPS = {"steps": 200}


def tiny(paper, *, quick=False):
    if paper == "aamas2020":
        points = tuple(grid({"neighbors": [10, 19]}))
        groups = [
            Group(name, Design(name, points, 2), STEPS, {"preset": name})
            for name in ("aamas2020", "aamas2020-constant")
        ]
        return Plan(paper, quick, 200, 2, tuple(groups))
    main = tuple(grid({"target_speed": [3.0, 5.0], "fast": [0, 15, 30, 50], "neighbors": [10, 20, 30, 40]}))
    start = tuple(
        grid({"target_speed": [3.0], "fast": [15], "neighbors": [20], "fleets.BoB-1.start": ["corner", "center"]})
    )
    curves = tuple(grid({"target_speed": [3.0], "fast": [15, 0], "neighbors": [10, 20, 30, 40]}))
    return Plan(
        paper,
        quick,
        200,
        2,
        (
            Group("main", Design("oceans2020", main, 2), STEPS),
            Group("placement", Design("oceans2020", start, 2), STEPS),
            Group("side/as-it-is", Design("oceans2020", curves, 2), STEPS, {"side": "as it is"}),
            Group("refit/main", Design("oceans2020-refit", main, 2), STEPS),
            Group("refit/placement", Design("oceans2020-refit", start, 2), STEPS),
            Group("refit/side/as-it-is", Design("oceans2020-refit", curves, 2), STEPS, {"side": "as it is"}),
            *(
                Group(f"{kind}/{name}", Design("oceans2020", points, 2), {**STEPS, **changes}, {"variant": name})
                for name, changes in (("baseline", {}), ("omega", {"strategy.inertia": 0.5}))
                for kind, points in (("sensitivity", curves), ("sensitivity-placement", start))
            ),
        ),
    )


@pytest.fixture(autouse=True)
def _tiny_and_without_pictures(monkeypatch):
    monkeypatch.setattr(module, "make_plan", tiny)
    monkeypatch.setattr(module, "_draw", lambda found: None)
    monkeypatch.setattr(module, "_write", lambda found, out: None)


def test_oceans_gives_every_claim_under_both_readings_the_tables_and_all_rows(tmp_path):
    found = reproduce("oceans2020", tmp_path, jobs=2)
    for claims in (found.claims, found.refit_claims):
        assert [claim.id for claim in claims] == [f"C{number}" for number in range(1, 29)]
    assert (len(found.main), len(found.refit), len(found.sensitivity)) == (64, 64, 32)
    assert {name: len(rows) for name, rows in found.sides.items()} == {"oceans2020": 16, "oceans2020-refit": 16}
    assert {row["variant"] for row in found.sensitivity} == {"baseline", "omega"}
    assert {"peaks", "refit_peaks", "sensitivity_peaks", "sensitivity_conclusions"} <= set(found.tables)
    verdicts = [(row["claim"], row["oceans2020"], row["oceans2020-refit"]) for row in found.tables["verdicts"]]
    assert verdicts == [
        (one.id, one.verdict, other.verdict) for one, other in zip(found.claims, found.refit_claims, strict=True)
    ]
    assert [row["depends"] for row in found.tables["verdicts"]] == [one != other for _, one, other in verdicts]
    assert found.command == f"shoal reproduce oceans2020 --out {tmp_path} --jobs 2"
    assert found.versions["shoal"]
    assert (tmp_path / "runs" / "sensitivity" / "omega" / "results.csv").is_file()


def test_aamas_gives_the_residuals_and_their_claims(tmp_path):
    found = reproduce("aamas2020", tmp_path)
    assert {row["preset"] for row in found.main} == {"aamas2020", "aamas2020-constant"}
    assert [(row["metric"], row["neighbors"]) for row in found.tables["published"]] == [
        ("time_on_target", 10), ("time_on_target", 19), ("response", 10), ("response", 19)
    ]  # fmt: skip
    assert [claim.id for claim in found.claims] == ["A1", "A2"]


def test_the_same_numbers_come_again_and_nothing_runs_twice(tmp_path):
    first = reproduce("oceans2020", tmp_path)
    seen = []
    again = reproduce("oceans2020", tmp_path, report=seen.append)
    assert seen == []
    assert json.dumps(again.main) == json.dumps(first.main)
    assert [claim.measured for claim in again.claims] == [claim.measured for claim in first.claims]


def test_progress_counts_the_runs_of_all_sweeps_together(tmp_path):
    seen = []
    run_plan(tiny("oceans2020"), tmp_path, report=lambda now: seen.append((now.before + now.done, now.total)))
    assert seen == [(number, 208) for number in range(1, 209)]


def test_interrupted_it_keeps_what_is_done_and_goes_on_from_there(tmp_path):
    def interrupt(now):
        if now.done == 70:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reproduce("oceans2020", tmp_path, report=interrupt)
    seen = []
    reproduce("oceans2020", tmp_path, report=lambda now: seen.append((now.before, now.done, now.total)))
    assert seen[0][0] + seen[0][1] >= 70
    assert sum(seen[-1][:2]) == seen[-1][2] == 208


def test_failed_runs_are_tried_again(tmp_path, monkeypatch):
    from shoal.experiments import executors
    from shoal.experiments.rows import failed_row

    with monkeypatch.context() as broken:
        broken.setattr(executors, "replicate", lambda scenario, run, stop: failed_row("out of luck"))
        assert reproduce("aamas2020", tmp_path).tables["published"] == []
    assert len(reproduce("aamas2020", tmp_path).tables["published"]) == 4
    assert {row["status"] for row in read_rows(tmp_path / "runs" / "aamas2020")[1]} == {"done"}


class TestRefused:
    def test_a_folder_of_the_quick_one(self, tmp_path):
        reproduce("aamas2020", tmp_path, quick=True)
        with pytest.raises(RecordError, match="holds the quick reproduction of aamas2020, not the full one"):
            reproduce("aamas2020", tmp_path)

    def test_a_folder_of_another_paper(self, tmp_path):
        reproduce("aamas2020", tmp_path)
        with pytest.raises(RecordError, match="of aamas2020, not the full one of oceans2020"):
            reproduce("oceans2020", tmp_path)

    def test_a_paper_that_is_unknown(self, tmp_path):
        with pytest.raises(ScenarioError, match="choose oceans2020, aamas2020, alife2023 or density2023"):
            reproduce("icra2030", tmp_path / "new")
        assert not (tmp_path / "new").exists()

    def test_a_file_in_place_of_the_folder(self, tmp_path):
        (tmp_path / "file").write_text("")
        with pytest.raises(RecordError, match="fix: name another folder"):
            reproduce("aamas2020", tmp_path / "file")

    def test_a_plan_that_is_no_json(self, tmp_path):
        (tmp_path / "plan.json").write_text("[")
        with pytest.raises(RecordError, match=r"plan\.json"):
            reproduce("aamas2020", tmp_path)


class TestCommandLine:
    def test_it_prints_the_verdicts_and_where_the_report_is(self, tmp_path, capsys):
        assert run_command(["reproduce", "aamas2020", "--out", str(tmp_path / "out")]) == 0
        told, noted = capsys.readouterr()
        assert "A1" in told
        assert f"report: {tmp_path / 'out' / 'report.html'}" in told
        assert "runs/s" in noted

    @pytest.mark.parametrize("wrong", [["icra2030"], ["aamas2020", "--jobs", "0"]])
    def test_what_cannot_run_is_one_sentence_and_exit_code_2(self, wrong, tmp_path, capsys, monkeypatch):
        monkeypatch.chdir(tmp_path)
        assert run_command(["reproduce", *wrong]) == 2
        assert "fix: " in capsys.readouterr().err
        assert list(tmp_path.iterdir()) == []

    def test_interrupted_it_says_how_to_go_on(self, tmp_path, capsys, monkeypatch):
        def interrupted(*args, **options):
            raise KeyboardInterrupt

        monkeypatch.setattr(module, "run_plan", interrupted)
        try:
            code = run_command(["reproduce", "aamas2020", "--out", str(tmp_path)])
        except SystemExit as left:  # cyclopts turns an interrupt into this
            code = left.code
        assert code == 130
        assert "the same command continues from there" in capsys.readouterr().err
