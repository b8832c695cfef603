"""What stands left of axes is on the page, however long its numbers are."""

import pytest

from shoal.drawing.margins import keep_on_page


@pytest.mark.parametrize("most", [1.0, 12_345_678.0])
def test_numbers_and_label_are_on_the_page(axes, most):
    axes.set_position((0.02, 0.1, 0.8, 0.8))
    axes.plot([0, 1], [0.0, most])
    axes.ticklabel_format(style="plain")
    axes.set_ylabel("a label")
    right = axes.get_position().x1
    keep_on_page(axes)
    assert axes.get_tightbbox().x0 >= 0.0
    assert axes.get_position().x1 == pytest.approx(right)


def test_axes_with_room_stay(axes):
    before = axes.get_position().bounds
    keep_on_page(axes)
    assert axes.get_position().bounds == before
