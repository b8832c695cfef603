"""Specification of the charts of a comparison: every strategy once, in order, the yardstick through all."""

import pytest

from shoal.drawing.comparison import Bar, Panel, bars_figure, curves_figure
from shoal.drawing.style import TARGET, WIDTHS
from shoal.drawing.sweep import Curve

pytest.importorskip("matplotlib", reason="matplotlib is not installed")


def panel(names, title="", informed=()):
    bars = [
        Bar(name, 0.9 - 0.04 * n, 0.88 - 0.04 * n, 0.92 - 0.04 * n, name in informed) for n, name in enumerate(names)
    ]
    return Panel(title, bars)


def names(count):
    return ["lattice", *(f"strategy-of-number-{n}" for n in range(count - 1))]


def marked(axes, gid):
    return axes.findobj(lambda artist: (artist.get_gid() or "").startswith(gid))


@pytest.mark.parametrize("count", [2, 6, 18])
class TestBars:
    def test_every_strategy_has_a_bar_of_its_mean_from_the_top_down(self, count):
        (axes,) = bars_figure([panel(names(count))], "share").axes
        bars = marked(axes, "bar-")
        assert [bar.get_gid() for bar in bars] == [f"bar-{name}" for name in names(count)]
        assert [bar.get_width() for bar in bars] == pytest.approx([0.9 - 0.04 * n for n in range(count)])
        assert axes.get_ylim()[0] > axes.get_ylim()[1]

    def test_a_line_marks_the_yardstick_in_every_panel(self, count):
        figure = bars_figure([panel(names(count), "one"), panel(names(count), "other")], "share")
        for axes in figure.axes:
            (line,) = marked(axes, "yardstick")
            assert list(line.get_xdata()) == [0.9, 0.9]

    @pytest.mark.parametrize("width", ["single", "double"])
    def test_nothing_leaves_the_page(self, count, width):
        figure = bars_figure([panel(names(count), str(n)) for n in range(8)], "share", width=width)
        assert figure.get_figwidth() == WIDTHS[width]
        figure.draw_without_rendering()
        width, height = figure.bbox.size
        for part in [*(axes.get_tightbbox() for axes in figure.axes), *(t.get_window_extent() for t in figure.texts)]:
            assert part.x0 >= 0
            assert part.y0 >= 0
            assert part.x1 <= width
            assert part.y1 <= height


class TestLooks:
    def test_references_are_hatched_and_explained(self):
        figure = bars_figure([panel(["lattice", "mine", "oracle"], informed=["oracle"])], "share")
        hatched = {bar.get_gid(): bool(bar.get_hatch()) for bar in marked(figure.axes[0], "bar-")}
        assert hatched == {"bar-lattice": False, "bar-mine": False, "bar-oracle": True}
        assert "Hatched: knows the target" in figure.texts[0].get_text()

    def test_the_yardstick_has_a_color_of_its_own_not_the_target_s(self):
        from matplotlib.colors import to_hex

        figure = bars_figure([panel(["lattice", "mine", "theirs"])], "share")
        colors = {bar.get_gid(): to_hex(bar.get_facecolor()) for bar in marked(figure.axes[0], "bar-")}
        assert colors["bar-mine"] == colors["bar-theirs"] != colors["bar-lattice"]
        assert TARGET.lower() not in colors.values()

    def test_a_difference_that_was_shown_has_its_sign(self):
        bars = [Bar("lattice", 0.5, 0.4, 0.6), Bar("mine", 0.9, 0.8, 0.95, sign="+")]
        (axes,) = bars_figure([Panel("", bars)], "share", "20 runs of each").axes
        (sign,) = marked(axes, "sign-")
        assert (sign.get_gid(), sign.get_text()) == ("sign-mine", "+")
        assert "20 runs of each" in axes.figure.texts[0].get_text()

    def test_panels_have_letters_where_there_are_several(self):
        two = bars_figure([panel(names(3), "one"), panel(names(3), "other")], "share")
        assert [axes.get_title("left") for axes in two.axes] == ["(a) one", "(b) other"]
        assert [axes.get_title("left") for axes in bars_figure([panel(names(3))], "share").axes] == [""]

    def test_long_names_are_whole(self):
        name = "a-strategy-with-quite-a-long-name-that-says-all-of-it"
        (axes,) = bars_figure([panel(["lattice", name])], "share").axes
        assert axes.get_yticklabels()[1].get_text().replace("\n", "") == name

    def test_panels_share_one_scale_from_zero(self):
        small = Panel("small", [Bar("lattice", 0.1, -0.1, 0.3)])
        figure = bars_figure([small, Panel("large", [Bar("lattice", 2.0, 1.0, 3.0)])], "share")
        for axes in figure.axes:
            assert axes.get_xlim() == pytest.approx((0.0, 3.09))

    def test_a_strategy_without_a_value_keeps_its_place(self):
        (axes,) = bars_figure(
            [Panel("", [Bar("lattice", 0.5, None, None), Bar("mine", float("nan"), None, None)])], ""
        ).axes
        axes.figure.draw_without_rendering()
        assert [label.get_text() for label in axes.get_yticklabels()] == ["lattice", "mine"]


class TestCurves:
    def test_a_curve_per_strategy_named_in_the_order_of_the_right_ends_references_last(self):
        ends = {"mine": 0.2, "lattice": 0.5, "oracle": 0.9, "theirs": 0.7}
        curves = [Curve(name, [1, 2], [0.4, end], [None, end - 0.1], [None, end + 0.1]) for name, end in ends.items()]
        figure = curves_figure(curves, ("neighbors", "share"), informed=["oracle"])
        told = [text.get_text() for text in figure.axes[0].get_legend().get_texts()]
        assert told == ["theirs", "lattice", "mine", "oracle (knows the target)"]
        drawn = [line for line in figure.axes[0].lines if line.get_linestyle() != "None" and len(line.get_ydata())]
        assert [line.get_ydata()[-1] for line in drawn] == [0.7, 0.5, 0.2, 0.9]

    def test_has_a_marker_where_it_was_run_and_none_between(self):
        curves = [Curve("mine", [1, 40], [0.4, 0.5], [None, None], [None, None])]
        (marks,) = [line for line in curves_figure(curves, ("k", "share")).axes[0].lines
                    if line.get_linestyle() == "None" and len(line.get_xdata())]  # fmt: skip
        assert list(marks.get_xdata()) == [1, 40]

    def test_eighteen_curves_look_different(self):
        curves = [Curve(name, [1, 2], [0.1, 0.2], [None, None], [None, None]) for name in names(18)]
        lines = curves_figure(curves, ("neighbors", "share")).axes[0].get_legend_handles_labels()[0]
        assert len({(line.get_color(), line.get_linestyle()) for line in lines}) == 18
        assert TARGET not in {line.get_color() for line in lines}
