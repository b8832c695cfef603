"""A figure that a notebook shows by itself, though no window and no global state knows it."""

import io

from matplotlib.figure import Figure

from shoal.drawing.style import style

DPI = 150


class Page(Figure):
    """A matplotlib Figure, shown in a notebook as it would be saved."""

    def _repr_png_(self) -> bytes:
        stream = io.BytesIO()
        with style():
            self.savefig(stream, format="png", dpi=DPI)
        return stream.getvalue()
