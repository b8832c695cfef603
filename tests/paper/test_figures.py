import math
import sys
from itertools import product

import numpy as np
import pytest

from shoal.core.errors import MissingExtraError
from shoal.drawing.files import save_figure
from shoal.drawing.style import TARGET
from shoal.paper.figures import make_aamas_figures, make_figures, make_study_figures
from shoal.paper.figures_series import TIME_ON_TARGET, plain_rows, series, spread, where
from shoal.paper.plan import VARIANTS
from shoal.paper.results import Reproduction
from shoal.paper.side_plan import settings

STEPS = 300
KS = (2, 10, 15, 18, 20, 22, 25, 30, 40, 49)
SIDES = list(settings("oceans2020"))
OCEANS = ["heading_bearing", "locked", "phi_histograms", "tot_share", "tot_k", "clustering", "xi_share", "xi_k"]

REFIT = ["phi_histograms_refit", "tot_k_refit", "xi_k_refit", "sides"]


def run_of(fast, k, speed, run, **more):
    """A row whose time on target peaks at k = 18 (20 all slow), and whose Xi peaks at k = 25."""
    chance = 0.001 * run
    fleets = [count for count in (fast, 50 - fast) if count]
    return {
        "fast": fast, "neighbors": k, "target_speed": speed, "run": run, "status": "done",
        "time_on_target": 0.7 + 0.002 * fast - 2e-4 * (k - (18 if fast else 20)) ** 2 + chance,
        "xi": 0.8 - 3e-4 * (k - 25) ** 2 + chance, "xi_raw": (1 + 0.03 * fast) * (0.8 + chance),
        "response": 3.0 + chance, "stationary": 0.05 + chance,
        "phi_histogram": [50 / 11] * 11, "fleet_phi_histogram": [[count / 11] * 11 for count in fleets], **more,
    }  # fmt: skip


def oceans(runs=3, ks=KS, shares=(0, 10, 15, 30, 50), speeds=(3.0, 5.0), share_ks=(10, 20), sensitivity=True):
    points = {*product((0, 15), ks), *product(shares, share_ks)}
    main = [run_of(fast, k, speed, run) for fast, k in sorted(points) for speed in speeds for run in range(runs)]
    variants = [
        run_of(fast, k, speed, run, variant=name)
        for name, fast, k, speed, run in product(VARIANTS, (0, 15), KS, speeds, range(runs))
        if sensitivity
    ]
    sides = {
        preset: [run_of(15, 20, speed, run, side=name) for name, speed, run in product(SIDES, speeds, range(runs))]
        for preset in ("oceans2020", "oceans2020-refit")
    }
    return Reproduction("oceans2020", True, STEPS, runs, main, variants, refit=main, sides=sides)


def aamas(published=True):
    main = [
        {
            "preset": preset,
            "neighbors": k,
            "run": run,
            "status": "done",
            "time_on_target": 0.8,
            "response": 3.0 + 0.01 * run,
        }
        for preset, k, run in product(("aamas2020", "aamas2020-constant"), (10, 13, 16, 19), range(3))
    ]
    compared = (("time_on_target", 0.8, 0.79), ("response", 3.01, 3.0))
    table = [
        {"metric": metric, "neighbors": k, "measured": ours, "low": ours - 0.01, "high": ours + 0.01, "published": its,
         "residual": ours - its, "tolerance": 0.015, "verdict": "holds"}
        for (metric, ours, its), k in product(compared, (10, 13, 16, 19))
    ]  # fmt: skip
    return Reproduction("aamas2020", True, STEPS, 3, main, [], tables={"published": table} if published else {})


@pytest.fixture(scope="module")
def figures():
    return {figure.name: figure for figure in make_figures(oceans())}


class TestFiguresOfThePaper:
    def test_all_are_there_in_its_order(self, figures):
        assert list(figures) == [*OCEANS, *REFIT, "sensitivity_3", "sensitivity_5"]

    def test_each_has_a_title_a_caption_and_its_numbers(self, figures):
        for figure in figures.values():
            assert figure.title
            assert figure.caption.endswith(".")
            assert figure.data

    def test_each_can_be_written(self, figures, tmp_path):
        for name in ("locked", "tot_k"):
            save_figure(figures[name].figure, tmp_path / f"{name}.png")
            assert (tmp_path / f"{name}.png").stat().st_size > 10_000

    def test_letters_have_8_points_or_more(self, figures):
        from matplotlib.text import Text

        sizes = {
            (name, text.get_text()): text.get_fontsize()
            for name, figure in figures.items()
            for text in figure.figure.findobj(Text)
            if text.get_text()
        }
        assert {key: size for key, size in sizes.items() if size < 8.0} == {}

    def test_widths_are_at_most_the_paper_s_two_columns(self, figures):
        assert all(figure.figure.get_figwidth() <= 7.16 for figure in figures.values())

    def test_without_matplotlib_says_what_to_install(self, monkeypatch):
        monkeypatch.setitem(sys.modules, "matplotlib", None)
        with pytest.raises(MissingExtraError, match="matplotlib: is not installed"):
            make_figures(oceans())


class TestNumbersBehindThem:
    def test_shares_are_means_over_seeds(self, figures):
        (row,) = where(figures["tot_share"].data, neighbors=20, target_speed=3.0, fast=30)
        assert row["mean"] == pytest.approx(0.76 - 2e-4 * 4 + 0.001)
        assert row["low"] < row["mean"] < row["high"]
        assert row["runs"] == 3

    def test_peaks_are_where_the_curves_peak(self, figures):
        peaks = where(figures["tot_k"].data, quantity="k of the peak of time on target", fast=15)
        assert [row["mean"] for row in peaks] == pytest.approx([18.0, 18.0], abs=0.1)
        peaks = where(figures["xi_k"].data, quantity="k of the peak of velocity fluctuation Ξ", fast=0)
        assert [row["mean"] for row in peaks] == pytest.approx([25.0, 25.0], abs=0.1)

    def test_xi_is_shown_with_and_without_norm(self, figures):
        assert {row["quantity"] for row in figures["xi_share"].data} == {"velocity fluctuation Ξ", "Ξ not normalized"}

    def test_a_peak_is_marked_where_it_is(self, figures):
        (peak,) = where(figures["tot_k"].data, quantity="time on target at its peak", fast=15, target_speed=3.0)
        (place,) = where(figures["tot_k"].data, quantity="k of the peak of time on target", fast=15, target_speed=3.0)
        points = [line.get_xydata()[0].tolist() for line in figures["tot_k"].figure.axes[0].lines
                  if len(line.get_xdata()) == 1]  # fmt: skip
        assert pytest.approx([place["mean"], peak["mean"]]) in points

    def test_panels_have_letters(self, figures):
        titles = [axes.get_title("left") for axes in figures["tot_k"].figure.axes]
        assert titles == ["(a) Target 3 m/s", "(b) Target 5 m/s"]

    def test_nothing_but_the_target_has_its_color(self, figures):
        from matplotlib.colors import to_hex

        for name in ("tot_share", "xi_share", "tot_k", "xi_k", "sides", "sensitivity_3"):
            lines = [line for axes in figures[name].figure.axes for line in axes.lines]
            assert TARGET.lower() not in {to_hex(line.get_color()) for line in lines}

    def test_bars_of_every_histogram_sum_to_all_agents(self, figures):
        data = [row for row in figures["phi_histograms"].data if row.get("agents") == "all" and "phi" in row]
        panels = {(row["fast"], row["neighbors"], row["target_speed"]) for row in data}
        assert len(panels) == 12
        assert sum(row["mean"] for row in data) == pytest.approx(50 * len(panels))

    def test_every_variant_has_its_peaks(self, figures):
        data = where(figures["sensitivity_3"].data, fast=15, quantity="k* (time on target peaks)")
        assert [row["variant"] for row in data] == list(VARIANTS)
        assert [row["value"] for row in data] == pytest.approx([18.0] * len(VARIANTS), abs=0.1)

    def test_snapshots_list_every_buoy(self, figures):
        rows = [row for row in where(figures["locked"].data, what="moment") if row["who"] != "target"]
        assert len(rows) == 50
        assert {"x [m]", "a_R [m]", "on_target", "locked"} <= set(rows[0])


class TestWhatIsLeftOut:
    def test_failed_runs(self):
        rows = [run_of(15, 20, 3.0, 0), {**run_of(15, 20, 3.0, 1, time_on_target=None), "status": "failed"}]
        assert plain_rows(rows) == rows[:1]

    def test_points_with_another_start(self):
        rows = [run_of(15, 20, 3.0, 0, **{"fleets.BoB-1.start": start}) for start in (None, "corner")]
        assert plain_rows(rows) == rows[:1]

    def test_figures_without_rows(self):
        nothing = Reproduction("oceans2020", True, STEPS, 1, [], [])
        assert [figure.name for figure in make_figures(nothing)] == ["heading_bearing", "locked", "clustering"]
        assert make_aamas_figures(nothing) == []


class TestLittleData:
    @pytest.mark.parametrize(
        ("little", "missing"),
        [
            (oceans(runs=1, sensitivity=False), set()),
            (oceans(ks=(20,), shares=(0, 15), share_ks=(20,), sensitivity=False), {"tot_k", "xi_k"}),
            (oceans(ks=(10, 20), shares=(0,), speeds=(3.0,), sensitivity=False), set()),
            (oceans(shares=(15,), speeds=(3.0,), sensitivity=False), set()),
        ],
        ids=["one seed", "one k", "two k, one speed", "two shares"],
    )
    def test_draws_what_there_is(self, little, missing, tmp_path):
        made = make_figures(little)
        expected = [name for name in (*OCEANS, *REFIT) if name.removesuffix("_refit") not in missing]
        assert [figure.name for figure in made] == expected
        for figure in made:
            figure.figure.draw_without_rendering()

    def test_one_seed_has_no_intervals(self):
        points = series([run_of(15, 20, 3.0, 0)], "neighbors", TIME_ON_TARGET)
        assert math.isnan(points.low[0])
        assert points.runs == (1,)

    def test_intervals_of_shares_end_at_0_and_1(self):
        rows = [run_of(15, 20, 3.0, run, time_on_target=value) for run, value in enumerate((0.0, 1.0))]
        points = series(rows, "neighbors", TIME_ON_TARGET)
        assert (points.low[0], points.high[0]) == pytest.approx((0.0, 1.0), abs=1e-6)

    def test_spread_keeps_what_must_be_shown(self):
        assert spread(range(50), 4, 20) == [0, 20, 33, 49]
        assert spread([1, 2], 4) == [1, 2]


class TestPublished:
    def test_shows_curves_published_points_and_residuals(self):
        (figure,) = make_aamas_figures(aamas())
        assert figure.name == "published"
        residuals = where(figure.data, source="measured less published", quantity="time on target")
        assert [row["mean"] for row in residuals] == pytest.approx([0.01] * 4)
        assert {row["source"] for row in figure.data} == {
            "measured, adaptive repulsion", "measured, constant repulsion", "published",
            "measured less published", "tolerance",
        }  # fmt: skip

    def test_our_curves_alone_where_nothing_is_compared(self):
        (figure,) = make_aamas_figures(aamas(published=False))
        figure.figure.draw_without_rendering()
        assert np.isfinite([row["mean"] for row in figure.data]).all()


class TestReadings:
    """The study's figures: a line per reading and stage."""

    @pytest.fixture(scope="class")
    @classmethod
    def made(cls):
        verdicts = dict(zip((f"C{number}" for number in range(1, 14)), ("holds", "holds partly") * 7, strict=False))
        scores = [
            {"reading": name, "trial": stage, "steps": 2000, "seeds": 2, **verdicts, "hold": 7, "score": 10.0,
             "printed": name == "old", "chosen": name == "new"}
            for stage, name in (("final", "new"), ("final", "old"), ("screen", "new"), ("screen", "old"))
        ]  # fmt: skip
        peaks = [
            {"reading": row["reading"], "trial": row["trial"], "fast": fast, "target_speed": speed, "k_star": 18.0,
             "k_star_low": 17.0, "k_star_high": 19.0, "xi_peak_k": 25.0, "xi_peak_k_low": 24.0, "xi_peak_k_high": 26.0}
            for row, fast, speed in product(scores, (15, 0), (3.0, 5.0))
        ]  # fmt: skip
        study = Reproduction("oceans2020-readings", True, 2000, 2, [], [])
        study.tables = {"readings_scores": scores, "readings_peaks": peaks}
        return {figure.name: figure for figure in make_study_figures(study)}

    def test_both_are_drawn_with_their_numbers(self, made):
        assert list(made) == ["readings", "readings_peaks"]
        assert len(made["readings"].data) == 4
        assert len(made["readings_peaks"].data) == 4 * 3 * 2
        for figure in made.values():
            figure.figure.draw_without_rendering()
            assert figure.figure.get_figwidth() <= 7.16

    def test_the_chosen_one_is_bold_and_the_printed_one_named(self, made):
        labels = made["readings"].figure.axes[0].get_yticklabels()
        assert [label.get_fontweight() == "bold" for label in labels] == [True, False, True, False]
        assert [label.get_text() for label in labels] == ["new", "old (printed)"] * 2

    def test_without_readings_there_is_none(self):
        study = Reproduction("oceans2020-readings", True, 2000, 2, [], [])
        study.tables = {"readings_scores": [], "readings_peaks": []}
        assert make_study_figures(study) == []


def test_the_sketch_of_heading_and_bearing_tells_the_cosine(figures):
    assert [row["phi"] for row in figures["heading_bearing"].data] == pytest.approx(
        [math.cos(math.radians(row["angle [deg]"])) for row in figures["heading_bearing"].data]
    )
