"""Specification of shoal.plot: any figure of any record in one line, the same bytes for the same record."""

import numpy as np
import pytest

import shoal
from scenarios import fleets, scenario
from shoal import plot
from shoal.core.errors import RecordError, ScenarioError, ShoalError
from shoal.drawing.style import GRID, new_figure, style

pytest.importorskip("matplotlib", reason="figures need matplotlib: pip install '.[plots]'")

TARGETS = [
    {"kind": "still", "radius": 1.0},
    {"kind": "drift", "radius": 0.5, "current_x": 4.0},
    {"kind": "waypoint", "radius": 1.0, "speed": 3.0, "margin": 2.0, "waypoint_reach": 1.5,
     "surface_time": 2.0, "dive_time": 1.0},
]  # fmt: skip
MANY = {
    "fleets": fleets((6, 3.0), (5, 1.0), (4, 2.0)),
    "targets": TARGETS,
    "network.neighbors": "all",
    "losses": [{"step": 20, "count": 4}],
    "joins": [{"step": 30, "count": 2, "fleet": "make 1"}],
}
STEPS = 60
FIGURES = {
    "snapshot": plot.snapshot,
    "trajectory_map": plot.trajectory_map,
    "phi_histogram": plot.phi_histogram,
    "time_on_target": plot.time_on_target,
    "summary": plot.summary,
}


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    """One run; several runs; several fleets and targets, with buoys that are lost and that join; a folder."""
    folder = tmp_path_factory.mktemp("records") / "record"
    one, many = scenario(changes={"steps": STEPS}), scenario(changes={"steps": STEPS, **MANY})
    shoal.simulate(one, out=folder)
    return {
        "one run": shoal.simulate(one),
        "several runs": shoal.simulate(one, runs=3, every=1),
        "several fleets and targets": shoal.simulate(many, every=1),
        "a folder": folder,
    }


def rows(**changes):
    """A sweep of two fields, two runs each."""
    return [
        {"neighbors": k, "fast": fast, "run_id": f"{k}-{fast}-{run}", "run": run, "seed": 1, "status": "done",
         "time_on_target": k / 100 + fast / 1000 + run / 500, **changes}
        for k in (10, 20, 30) for fast in (0, 15) for run in (0, 1)
    ]  # fmt: skip


@pytest.fixture
def axes():
    with style():
        return new_figure(5.0, 5.0).add_axes((0.1, 0.1, 0.8, 0.8))


@pytest.mark.parametrize("figure", FIGURES)
class TestEveryFigure:
    @pytest.mark.parametrize("record", ["a folder", "several fleets and targets"])
    @pytest.mark.parametrize(("kind", "begins"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
    def test_the_same_record_gives_the_same_bytes(self, records, tmp_path, figure, record, kind, begins):
        for name in ("one", "two"):
            plot.save(FIGURES[figure](records[record]), tmp_path / f"{name}.{kind}")
        one, two = ((tmp_path / f"{name}.{kind}").read_bytes() for name in ("one", "two"))
        assert one.startswith(begins)
        assert one == two

    @pytest.mark.parametrize("record", ["one run", "several runs", "several fleets and targets", "a folder"])
    def test_nothing_leaves_the_page(self, records, figure, record):
        made = FIGURES[figure](records[record])
        with style():
            made.draw_without_rendering()
            boxes = [axes.get_tightbbox() for axes in made.axes]
        width, height = made.bbox.size
        assert min(box.x0 for box in boxes) >= 0.0
        assert min(box.y0 for box in boxes) >= 0.0
        assert max(box.x1 for box in boxes) <= width
        assert max(box.y1 for box in boxes) <= height


class TestAxesOfOnesOwn:
    @pytest.mark.parametrize("figure", [name for name in FIGURES if name != "summary"])
    def test_it_is_drawn_into_them(self, records, axes, figure):
        assert FIGURES[figure](records["one run"], axes=axes) is axes.figure
        assert axes.has_data()

    def test_curves_too(self, axes):
        assert plot.curves(rows(), axes=axes) is axes.figure
        assert axes.get_xlabel() == "neighbors, k"
        assert axes.get_ylabel() == "time on target [share]"

    @pytest.mark.parametrize("figure", [name for name in FIGURES if name != "summary"])
    def test_their_titles_stay_and_there_is_none_of_ours(self, records, axes, figure):
        axes.set_title("(a)", loc="left", fontsize=13.0)
        axes.set_title("mine")
        FIGURES[figure](records["one run"], axes=axes)
        assert [axes.get_title(loc) for loc in ("left", "center", "right")] == ["(a)", "mine", ""]
        assert next(each for each in axes.get_children() if getattr(each, "get_text", str)() == "(a)").get_size() == 13

    def test_no_legend_is_above_them_or_wider(self, records):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(7.16, 3.0), layout="constrained")
        left, right = figure.subplots(1, 2)
        plot.curves(rows(), axes=left)
        plot.snapshot(records["several fleets and targets"], axes=right)
        figure.draw_without_rendering()
        for axes in (left, right):
            legend = axes.get_legend().get_window_extent()
            assert legend.y1 <= axes.bbox.y1
            assert legend.x1 <= figure.bbox.x1
        assert right.get_legend().get_window_extent().y1 < right.bbox.y0

    def test_they_get_our_grid(self):
        from matplotlib.colors import to_hex
        from matplotlib.figure import Figure

        axes = Figure().add_subplot()  # made by somebody with other settings
        plot.curves(rows(), axes=axes)
        assert to_hex(axes.xaxis.get_gridlines()[0].get_color()) == GRID


class TestSnapshot:
    def test_of_a_step(self, records):
        (axes,) = plot.snapshot(records["several runs"], run=2, step=33).axes
        assert axes.get_title("left").startswith("Run 2, step 33 ")

    def test_of_a_simulation_as_it_is_now(self, records):
        simulation = shoal.Simulation(scenario(changes={"steps": STEPS}))
        simulation.advance(50)
        drawn = [
            np.concatenate([np.asarray(marks.get_offsets()) for marks in figure.axes[0].collections])
            for figure in (
                plot.snapshot(simulation, trail=0),
                plot.snapshot(records["several runs"], run=0, step=50, trail=0),
            )
        ]
        assert np.array_equal(*drawn)

    def test_buoys_that_are_lost_are_gone_and_counted(self, records):
        (axes,) = plot.snapshot(records["several fleets and targets"], step=25).axes
        drawn = sum(len(marks.get_offsets()) for marks in axes.collections if str(marks.get_gid()).startswith("fleet-"))
        assert drawn == 15 - 4
        assert "11 of 17 there" in axes.get_title("left")

    def test_a_step_that_was_not_kept(self, records):
        with pytest.raises(RecordError, match="step 999: was not kept"):
            plot.snapshot(records["one run"], step=999)

    def test_something_that_is_no_record(self):
        with pytest.raises(RecordError, match="dict: is not a record"):
            plot.snapshot({})


class TestTrajectoryMap:
    def marks(self, figure, gid):
        return [each for each in figure.axes[0].collections if each.get_gid() == gid]

    def test_paths_begin_and_end_where_the_buoys_did(self, records):
        record = records["several runs"]
        figure = plot.trajectory_map(record, start=10, steps=20)
        frames = record.trajectories[0]
        (starts,), (ends,) = self.marks(figure, "starts-0"), self.marks(figure, "fleet-0")
        assert np.array_equal(starts.get_offsets(), np.stack([frames.x[10, :15], frames.y[10, :15]], axis=1))
        assert np.array_equal(ends.get_offsets(), np.stack([frames.x[29, :15], frames.y[29, :15]], axis=1))

    def test_a_path_darkens_from_its_start_to_its_end(self, records):
        (paths,) = self.marks(plot.trajectory_map(records["several runs"], start=0, steps=50), "paths-0")
        alphas = paths.get_colors()[::15, 3]
        assert (np.diff(alphas) > 0).all()

    def test_every_target_has_a_path(self, records):
        figure = plot.trajectory_map(records["several fleets and targets"], start=0, steps=STEPS)
        assert all(self.marks(figure, f"target-path-{number}") for number in range(3))

    def test_a_target_that_re_enters_at_the_other_side_draws_no_line_across(self, records):
        figure = plot.trajectory_map(records["several fleets and targets"], start=0, steps=STEPS)
        (path,) = self.marks(figure, "target-path-1")
        steps = np.concatenate([np.abs(np.diff(piece[:, 0])) for piece in path.get_segments()])
        assert np.nanmax(steps) < 10.0

    def test_steps_that_were_not_kept(self, records):
        with pytest.raises(RecordError, match="the record keeps 0 to 59"):
            plot.trajectory_map(records["several runs"], start=0, steps=500)


class TestPhiHistogram:
    def test_several_records_share_a_scale_and_are_named(self, records):
        one, other = records["one run"], records["several fleets and targets"]
        left, right = plot.phi_histogram({"few": one, "many": other}).axes
        assert (left.get_title("left"), right.get_title("left")) == ("(a) few", "(b) many")
        assert left.get_ylim() == right.get_ylim()
        assert list(left.get_yticks()) == list(right.get_yticks())

    def test_one_pair_of_axes_is_for_one_record(self, records, axes):
        with pytest.raises(RecordError, match="records: are 2"):
            plot.phi_histogram([records["one run"]] * 2, axes=axes)


class TestCurves:
    def test_a_curve_per_value_of_the_other_field_through_the_means(self):
        (axes,) = plot.curves(rows()).axes
        assert axes.get_legend_handles_labels()[1] == ["0 fast agents", "15 fast agents"]
        line = next(line for line in axes.lines if len(line.get_xdata()) == 3)
        assert line.get_xdata().tolist() == [10, 20, 30]
        assert line.get_ydata() == pytest.approx([0.101, 0.201, 0.301])

    @pytest.mark.parametrize(("width", "inches"), [("single", 3.5), ("double", 7.16)])
    def test_a_figure_is_as_wide_as_a_column_or_two(self, records, width, inches):
        for figure in (
            plot.curves(rows(), width=width), plot.summary(records["several runs"], width=width),
            plot.time_on_target(records["one run"], width=width), plot.phi_histogram(records["one run"], width=width),
            plot.phi_histogram([records["one run"]] * 3, width=width),
        ):  # fmt: skip
            assert figure.get_figwidth() == inches

    def test_another_width_is_refused(self):
        with pytest.raises(ShoalError, match="single, double"):
            plot.curves(rows(), width="wide")

    def test_its_axes_say_name_and_unit(self):
        (axes,) = plot.curves(rows(reacquisition=2.0), y="reacquisition", x="fast").axes
        assert (axes.get_xlabel(), axes.get_ylabel()) == ("fast agents", "reacquisition [s]")

    def test_a_dataframe_is_rows_too(self):
        pandas = pytest.importorskip("pandas", reason="pandas is not installed")
        (axes,) = plot.curves(pandas.DataFrame(rows()), x="fast").axes
        assert axes.get_xlabel() == "fast agents"

    def test_words_are_categories(self):
        (axes,) = plot.curves(
            [{"strategy": name, "run": run, "time_on_target": 0.5} for name in ("b", "a") for run in (0, 1)],
            x="strategy",
        ).axes
        assert [label.get_text() for label in axes.get_xticklabels()] == ["a", "b"]

    BAD = (
        ({"y": "fun"}, "y fun: is not a metric"),
        ({"x": "fun"}, "field fun: is not a field of this sweep"),
        ({"hue": "fun"}, "field fun: is not a field of this sweep"),
    )

    @pytest.mark.parametrize(("wish", "says"), BAD, ids=[each[1] for each in BAD])
    def test_a_name_that_is_not_there(self, wish, says):
        with pytest.raises(ScenarioError, match=says):
            plot.curves(rows(), **wish)

    def test_runs_that_all_failed(self):
        with pytest.raises(ScenarioError, match="hold no run that ended well"):
            plot.curves(rows(status="failed"))

    def test_a_folder_without_a_sweep(self, tmp_path):
        with pytest.raises(ShoalError, match="holds no sweep"):
            plot.curves(tmp_path)
