"""Titles of panels that fit above them."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SMALLEST = 6.5  # [pt]


def entitle(axes: "Axes", text: str, **look: Any) -> None:
    """Give axes a title, in smaller letters and then in two lines where it would be wider than they are."""
    title = axes.set_title(text, **look)
    figure = axes.get_figure(root=True)
    if figure is None or not text:
        return
    room = axes.get_position(original=True).width * figure.bbox.width
    wide = title.get_window_extent().width
    if wide <= room:
        return
    size = max(_SMALLEST, float(title.get_fontsize()) * room / wide)
    title.set_fontsize(size)
    if title.get_window_extent().width > 1.02 * room:
        words = text.split(" ")
        cut = min(range(1, len(words)), key=lambda at: abs(len(" ".join(words[:at])) - len(text) / 2), default=0)
        title.set_text("\n".join(part for part in (" ".join(words[:cut]), " ".join(words[cut:])) if part))
