"""What every figure has in common: widths of columns, colors that can be seen, text that is text."""

from itertools import pairwise

import pytest

from shoal.core.errors import UnknownNameError
from shoal.core.palette import FLEET_COLORS, TARGET
from shoal.drawing.files import save_figure
from shoal.drawing.style import LINE_COLORS, RC, fleet_line, lettered, new_figure, style, width_of


def luminance(color):
    """Relative luminance of WCAG 2."""
    from matplotlib.colors import to_rgb

    linear = [each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in to_rgb(color)]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one, other):
    light, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (light + 0.05) / (dark + 0.05)


@pytest.mark.parametrize("color", [*LINE_COLORS, *map(fleet_line, range(len(FLEET_COLORS))), TARGET])
def test_lines_stand_out_from_white(color):
    assert contrast(color, "white") >= 3.0


def test_no_curve_has_the_color_of_targets():
    assert TARGET not in LINE_COLORS


def test_the_first_four_differ_in_gray():
    grays = sorted(luminance(color) for color in LINE_COLORS[:4])
    assert min((light + 0.05) / (dark + 0.05) for dark, light in pairwise(grays)) > 1.4


def test_a_width_is_that_of_a_column_or_two():
    assert (width_of("single"), width_of("double")) == (3.5, 7.16)
    with pytest.raises(UnknownNameError, match="single, double"):
        width_of("triple")


def test_letters_of_panels():
    assert [lettered(0, "one"), lettered(1), lettered(2, "three")] == ["(a) one", "(b)", "(c) three"]


def test_text_in_vector_files_is_text(tmp_path):
    with style():
        figure = new_figure(3.5, 1.0)
        figure.text(0.1, 0.5, "time on target")
    save_figure(figure, tmp_path / "f.svg")
    assert ">time on target</text>" in (tmp_path / "f.svg").read_text()
    assert RC["pdf.fonttype"] == 42


def test_letters_that_the_font_lacks_are_no_warning(tmp_path, recwarn):
    with style():
        figure = new_figure(3.5, 1.0)
        figure.text(0.1, 0.5, "浮標 \u26f5 \U0001f6df")
    for kind in ("png", "svg", "pdf"):
        save_figure(figure, tmp_path / f"f.{kind}")
    assert not [each for each in recwarn if "lyph" in str(each.message)]
