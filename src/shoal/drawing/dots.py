"""Very many buoys: a dot each, in one picture."""

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.drawing.style import fleet_color
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MARKED = 2000  # more buoys than this are dots
_COVER = 0.75  # of what is under a dot is hidden by it, so that more are darker
_WIDEST = 3  # [pixels]


class Dots:
    """A dot per buoy that is alive, in the color of its fleet; where several lie, their mean."""

    def __init__(self, axes: "Axes", record: Record) -> None:
        from matplotlib.colors import to_rgb
        from matplotlib.image import AxesImage

        area = record.scenario.area
        self._ends = np.cumsum(record.facts.counts)
        self._colors = np.array([to_rgb(fleet_color(fleet)) for fleet in range(len(self._ends))])
        self._sides = np.array([area.height, area.width])
        self._shape = _pixels(axes, area.width, area.height)
        self._dot = dot_side(int(np.prod(self._shape)), record.facts.agents)
        across, up = area.width / 2, area.height / 2
        self._image = AxesImage(axes, extent=(-across, across, -up, up), origin="lower", zorder=1.9)
        self._image.set_gid("dots")
        axes.add_image(self._image)
        self.artists: list[Any] = [self._image]

    def show(self, frames: Trajectory, at: int) -> None:
        """Move to a frame."""
        there = np.asarray(frames.alive[at])
        places = np.stack([frames.y[at], frames.x[at]], axis=-1)
        fleets = np.split(np.arange(len(places)), self._ends[:-1])
        counts = [self._dots(places[each[there[each]]]) for each in fleets]
        self._image.set_data(_blend(np.array(counts), self._colors))

    def _dots(self, places: npt.NDArray[np.float64]) -> npt.NDArray[np.int64]:
        """How many dots lie on each pixel, rows from the south."""
        rows, columns = ((places / self._sides + 0.5) * self._shape).astype(np.int64).T
        height, width = self._shape
        total = np.zeros(height * width, np.int64)
        for row in range(self._dot):
            for column in range(self._dot):
                up, along = (rows + row).clip(0, height - 1), (columns + column).clip(0, width - 1)
                total += np.bincount(up * width + along, minlength=total.size)
        return total.reshape(height, width)


def dot_side(pixels: int, agents: int) -> int:
    """Pixels of a dot's side: as large as leaves most of the water free, 3 at most."""
    return int(np.clip(round((0.3 * pixels / agents) ** 0.5), 1, _WIDEST))


def _blend(counts: npt.NDArray[np.int64], colors: npt.NDArray[np.float64]) -> npt.NDArray[np.float32]:
    """RGBA (H, W, 4) of dots by fleet (F, H, W)."""
    total = counts.sum(axis=0)
    image = np.zeros((*total.shape, 4), np.float32)
    image[..., :3] = np.tensordot(counts, colors, axes=(0, 0)) / np.maximum(total, 1)[..., None]
    image[..., 3] = 1.0 - (1.0 - _COVER) ** total
    return image


def _pixels(axes: "Axes", width: float, height: float) -> tuple[int, int]:
    """Rows and columns of the pixels that an arena [m] takes on its page."""
    figure = axes.get_figure(root=True)
    box = axes.get_position(original=True)
    inches = (
        np.array([figure.get_figheight() * box.height, figure.get_figwidth() * box.width]) if figure else np.ones(2)
    )
    spans = np.array([np.ptp(axes.get_ylim()), np.ptp(axes.get_xlim())])
    scale = float((inches / spans).min()) * (figure.get_dpi() if figure else 100.0)
    return max(1, round(scale * height)), max(1, round(scale * width))
