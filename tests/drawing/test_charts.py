"""Specification of the charts: bars and curves have the heights that the record says."""

import numpy as np
import pytest

from shoal.drawing.curves import draw_band, draw_batches
from shoal.drawing.histogram import draw_phi_histogram


class TestPhiHistogram:
    """11 bins of their true widths, densities of the fleets stacked."""

    def test_the_areas_of_all_bars_sum_to_the_number_of_agents(self, axes, make_record):
        draw_phi_histogram(axes, make_record(counts=(3, 2, 7)))
        assert sum(bar.get_height() * bar.get_width() for bar in axes.patches) == pytest.approx(12.0)

    def test_bars_cover_minus_one_to_one_and_the_outer_two_are_half_as_wide(self, axes, make_record):
        draw_phi_histogram(axes, make_record(counts=(3,)))
        widths = [bar.get_width() for bar in axes.patches]
        assert widths == pytest.approx([0.1, *[0.2] * 9, 0.1])
        assert axes.patches[0].get_x() == pytest.approx(-1.0)

    def test_a_fleet_stands_on_the_one_before(self, axes, make_record):
        record = make_record(counts=(3, 2))
        for tally in record.tallies:
            tally.histogram[:, 1] = tally.histogram[:, 1, ::-1]
            tally.histogram[:, 1, 0] = 1
        draw_phi_histogram(axes, record)
        assert axes.patches[11].get_y() == pytest.approx(3.0 / 0.1)

    def test_the_legend_is_above_the_highest_bar(self, axes, make_record):
        draw_phi_histogram(axes, make_record(counts=(3, 2)))
        axes.figure.draw_without_rendering()
        legend = axes.get_legend().get_window_extent()
        assert axes.transData.inverted().transform(legend)[0, 1] >= 3.0 / 0.1

    def test_a_record_in_which_no_target_was_ever_there_says_so(self, axes, make_record):
        draw_phi_histogram(axes, make_record(present=0.0))
        assert not axes.patches
        assert "no target" in axes.texts[0].get_text()


class TestBatches:
    """Time on target over the run."""

    def test_a_line_per_run_through_the_middle_of_its_batches(self, axes, make_record, marks):
        draw_batches(axes, make_record(runs=2, on_target=(0.2, 0.6)))
        first, second = marks(axes, "run-0")[0], marks(axes, "run-1")[0]
        assert first.get_xdata() == pytest.approx([5, 15, 25, 35])
        assert (first.get_ydata()[0], second.get_ydata()[0]) == pytest.approx((0.2, 0.6))

    def test_the_overall_mean_is_a_line_over_all_steps(self, axes, make_record):
        draw_batches(axes, make_record(runs=2, on_target=(0.2, 0.6)))
        (mean,) = [line for line in axes.lines if str(line.get_label()).startswith("mean 0.4")]
        assert mean.get_xydata().tolist() == [[0.0, pytest.approx(0.4)], [40.0, pytest.approx(0.4)]]

    def test_its_band_stays_within_what_a_share_can_be(self, axes, make_record):
        draw_batches(axes, make_record(runs=2, on_target=(0.2, 0.6)))  # Student's t alone gives [-2.1, 2.9]
        band = axes.collections[0].get_paths()[0].get_extents()
        assert 0.0 <= band.y0 < 0.001
        assert 0.999 < band.y1 <= 1.0

    def test_batches_without_a_target_are_shaded(self, axes, make_record, marks):
        record = make_record(runs=1)
        record.tallies[0].present[2:] = 0.0
        draw_batches(axes, record)
        (shade,) = marks(axes, "absence")
        extents = shade.get_paths()[0].get_extents()
        assert (extents.x0, extents.x1) == pytest.approx((20.0, 40.0))

    def test_a_record_in_which_no_target_was_ever_there_says_so(self, axes, make_record):
        draw_batches(axes, make_record(present=0.0))
        assert "no target" in axes.texts[0].get_text()


class TestBand:
    """A mean as a line, its interval as a band."""

    def test_one_line_and_one_band(self, axes):
        draw_band(axes, [0, 1], [1, 2], [0, 1], [2, 3], "mean", "#0072B2")
        assert axes.lines[0].get_ydata().tolist() == [1, 2]
        band = axes.collections[0].get_paths()[0].get_extents()
        assert (band.y0, band.y1) == (0.0, 3.0)

    def test_a_mean_without_an_interval_has_no_band(self, axes):
        draw_band(axes, [0, 1], [1, 2], [np.nan] * 2, [np.nan] * 2, "mean", "#0072B2")
        assert not axes.collections[0].get_paths()
