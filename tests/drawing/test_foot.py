"""The note at the foot of a figure stays on the page, at any width."""

import pytest

from shoal.drawing.foot import draw_foot, foot_height
from shoal.drawing.style import WIDTHS, new_figure, style

NOTE = "whiskers: 95 % interval over runs on fresh seeds; numbers: " + " + ".join(["a-fleet-of-some-name"] * 4)


@pytest.mark.parametrize("width", WIDTHS.values())
def test_it_fits_the_room_made_for_it(width):
    with style():
        figure = new_figure(width, 2.0)
        draw_foot(figure, NOTE)
        (text,) = figure.texts
        box = text.get_window_extent()
    assert text.get_text().split() == NOTE.split()
    assert 0.0 <= box.x0 <= box.x1 <= figure.bbox.x1
    assert box.y0 >= 0.0
    assert box.y1 <= foot_height(NOTE, width) * figure.dpi
