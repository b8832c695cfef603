"""Specification of the summary page: every record fits on it, and nothing on it covers anything else."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest

from shoal.drawing.style import RC, style
from shoal.drawing.summary import summary_figure
from shoal.run.simulate import simulate
from shoal.scenario.load import read_table, scenario_from

SOLENT = Path(__file__).resolve().parents[2] / ".." / "shared" / "data" / "solent" / "solent_ais_2016-01-12.csv"
TWO_TARGETS = [{"kind": "still", "radius": 1.0}, {"kind": "waypoint", "radius": 0.5, "speed": 3.0}]

SHAPES = {
    "one run": {"runs": 1},
    "thirty runs": {"runs": 30},
    "two agents": {"counts": (2,)},
    "four fleets of 500 agents": {"counts": (20, 60, 120, 300)},
    "two targets": {"targets": TWO_TARGETS},
    "wide": {"area": (40.0, 10.0, 1.0)},
    "tall": {"area": (10.0, 40.0, 0.0)},
    "kilometers": {"area": (9000.0, 9000.0, 700.0)},
    "no trajectories": {"frames": 0},
    "one frame": {"frames": 1},
    "no target": {"present": 0.0},
}


def texts(figure):
    return "\n".join(text.get_text() for text in figure.texts)


def boxes(figure):
    """Where axes with all their labels, and the lines of the page, are."""
    figure.draw_without_rendering()
    parts = [axes.get_tightbbox() for axes in figure.axes] + [text.get_window_extent() for text in figure.texts]
    return [(box.x0, box.y0, box.x1, box.y1) for box in parts]


def overlap(one, other):
    """Overlap of two boxes [pixel], the smaller of both directions; not above 0: they are apart."""
    return min(min(one[2], other[2]) - max(one[0], other[0]), min(one[3], other[3]) - max(one[1], other[1]))


@pytest.mark.parametrize("shape", SHAPES)
class TestEveryShape:
    """The page keeps order whatever the record."""

    def test_no_part_covers_another_or_leaves_the_page(self, make_record, shape):
        with style():
            figure = summary_figure(make_record(**SHAPES[shape]))
            parts = boxes(figure)
        assert max(overlap(one, other) for one, other in combinations(parts, 2)) <= 1.0
        left, bottom, right, top = np.array(parts).T
        width, height = figure.bbox.size
        assert left.min() >= 0.0
        assert bottom.min() >= 0.0
        assert right.max() <= width
        assert top.max() <= height


class TestWords:
    """What was run, how it went, how sure that is and where it comes from."""

    def test_the_page_says_what_was_run(self, make_record):
        page = texts(summary_figure(make_record(counts=(3, 2), runs=2)))
        for part in (
            "by-hand",
            "5 agents (3 make 0, 2 make 1)",
            "k = 1",
            "knn-pso",
            "target 3 m/s",
            "40 steps",
            "2 runs",
        ):
            assert part in page

    def test_metrics_have_intervals(self, make_record):
        page = texts(summary_figure(make_record(runs=30)))
        assert "time on target 0.400 [0.327, 0.478]" in page
        assert "95 % interval over 30 runs" in page

    def test_where_it_comes_from(self, make_record):
        assert "scenario 0123456789abcdef  ·  seed 7  ·  shoal 9.9.9" in texts(summary_figure(make_record()))

    def test_metrics_that_do_not_exist_are_unknown(self, make_record):
        assert "time on target unknown" in texts(summary_figure(make_record(present=0.0)))

    def test_names_are_no_formulas(self, make_record):
        record = make_record()
        vars(record.scenario)["name"] = "$x_1$ $\\undefined$"
        summary_figure(record).draw_without_rendering()


class TestGlobalState:
    """Drawing leaves matplotlib as it was."""

    def test_rc_values_are_restored(self, make_record):
        import matplotlib

        before = dict(matplotlib.rcParams)
        summary_figure(make_record())
        assert dict(matplotlib.rcParams) == before
        assert before["svg.hashsalt"] != RC["svg.hashsalt"]

    def test_pyplot_knows_nothing_of_the_figure(self, make_record):
        pyplot = pytest.importorskip("matplotlib.pyplot")
        summary_figure(make_record())
        assert not pyplot.get_fignums()


class TestRealRecords:
    """Straight from the engine."""

    def test_the_shortest_run(self):
        table = read_table("oceans2020") | {"steps": 1}
        figure = summary_figure(simulate(scenario_from(table)))
        assert len(figure.axes) == 3
        assert "too short for intervals" in texts(figure)

    def test_a_recorded_track_with_silences(self):
        if not SOLENT.is_file():
            pytest.skip(f"the real data file {SOLENT.name} is not beside this repository")
        pytest.importorskip("pyproj", reason="pyproj is not installed")
        table = read_table("oceans2020") | {"steps": 9000, "time_step": 1.0}
        table["area"] = {"width": 9000.0, "height": 9000.0, "agent_margin": 700.0}
        target = {"kind": "track", "file": str(SOLENT), "id": "mmsi=235069877", "radius": 300.0}
        record = simulate(scenario_from(table | {"targets": [target]}))
        figure = summary_figure(record)
        assert "recorded target (mmsi=235069877)" in texts(figure)
        assert str(SOLENT.parent) not in texts(figure)
        assert figure.axes[0].findobj(lambda artist: artist.get_gid() == "scale-bar")
