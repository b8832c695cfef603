"""Where results will go, checked before the work that makes them."""

import os
from pathlib import Path

from shoal.core.errors import RecordError


def check_places(out: Path | None, figure: Path | None) -> None:
    """Refuse a figure that cannot be written; one in the folder of --out, which is made first, can be.

    Raises
    ------
    ShoalError, RecordError, MissingExtraError : it cannot
    """
    if figure is None:
        return
    from shoal.drawing.files import check_figure, figure_format

    folder = os.path.realpath(out) if out else None
    if folder == os.path.realpath(figure):
        raise RecordError("--figure", f"is {figure}, as is --out, a folder", "give them different names")
    if folder == os.path.realpath(figure.parent):
        figure_format(figure)
    else:
        check_figure(figure)
