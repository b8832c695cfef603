"""The page of a film: title, state, arena, a strip of time and, if wanted, two charts; drawn once, then updated."""

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.drawing.arena import arena_aspect
from shoal.drawing.arena_drawing import ArenaDrawing, Parts
from shoal.drawing.film_charts import Charts
from shoal.drawing.legend import draw_legend, legend_height
from shoal.drawing.snapshot import state_text
from shoal.drawing.stretch import Stretch
from shoal.drawing.style import GRAY, INK, TARGET, new_figure
from shoal.drawing.words import count, shorten
from shoal.record.frames import engaged_by_frame, present_by_frame
from shoal.record.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_EDGE = 0.12  # [inch] around the page
_LINE = 0.21  # of text
_STRIP = 0.07  # height of the strip of time
_KEY = 0.15  # of what its colors mean
_CHARTS = 2.9  # least width of the charts, labels included
_PANELS = 4.6  # least height of a page with charts
_PAD = 0.004  # around the arena
_LETTER = 0.075  # [inch] of the title


class FilmSize(NamedTuple):
    """Pixels of a film, both even, and pixels per inch: larger films have larger letters."""

    width: int
    height: int
    dpi: float


def film_size(record: Record, width: int, height: int | None, parts: Parts, panels: bool) -> FilmSize:
    """The size of a film in pixels; without a height the arena decides."""
    width -= width % 2
    dpi = _dpi(min(width, height or width))
    if height is None:
        inside = _inside(width / dpi, panels)
        tall = inside / _aspect(record) + _above(record, inside, parts) + _below()
        height = round(max(tall, _PANELS if panels else 0.0) * dpi)
    return FilmSize(width, height - height % 2, dpi)


class FilmPage:
    """A figure that shows one frame of a stretch after the other."""

    def __init__(
        self, record: Record, run: int, stretch: Stretch, size: FilmSize, parts: Parts, panels: bool = False
    ) -> None:
        self._record, self._stretch = record, stretch
        self._frames = record.trajectories[run]
        engaged = engaged_by_frame(self._frames)[stretch.frames]
        self._present = present_by_frame(self._frames)[stretch.frames]
        self._on_target = engaged > 0
        with np.errstate(invalid="ignore"):  # no target yet
            self._share = np.cumsum(self._on_target) / np.cumsum(self._present)
        # a thousandth of a pixel more, lest a rounding error take a whole one
        width, height = (size.width + 1e-3) / size.dpi, (size.height + 1e-3) / size.dpi
        self.figure: Figure = new_figure(width, height)
        self.figure.set_dpi(size.dpi)
        self._axes = self._arena(width, height, parts, panels)
        self._drawing = ArenaDrawing(self._axes, record, run, parts, stride=stretch.every, pad=_PAD)
        self._bare(parts)
        self._texts = self._write(width, height, record.scenario.name)
        self._strip = self._time_strip(width, height)
        self._charts = self._make_charts(record, run, stretch, engaged) if panels else None
        self._background: Any = None

    def show(self, number: int) -> None:
        """Set everything to a frame of the stretch, by its number."""
        frame = int(self._stretch.frames[number])
        step = int(self._frames.step[frame])
        self._drawing.show(frame)
        time, state, share = self._texts
        time.set_text(f"step {count(step)}  \u00b7  {step * self._record.facts.time_step:.1f} s")
        state.set_text(state_text(self._frames, frame))
        state.set_color(TARGET if self._on_target[number] else GRAY)
        known = np.isfinite(self._share[number]) and self._share.size > 1
        share.set_text(f"time on target {100 * self._share[number]:.0f} %" if known else "")
        colors = self._strip_colors.copy()
        colors[number + 1 :] = _AHEAD
        self._strip.set_data(colors[None])
        if self._charts:
            self._charts.show(number)

    def pixels(self, number: int) -> memoryview:
        """A frame of the stretch as RGBA bytes, rows from the top; valid until the next call."""
        canvas: Any = self.figure.canvas
        moving = [*self._drawing.artists, *self._texts, self._strip, *(self._charts.artists if self._charts else ())]
        if self._background is None:
            for artist in moving:
                artist.set_animated(True)
            canvas.draw()
            self._background = canvas.copy_from_bbox(self.figure.bbox)
        self.show(number)
        canvas.restore_region(self._background)
        for artist in moving:
            self.figure.draw_artist(artist)
        return memoryview(canvas.buffer_rgba()).cast("B")

    def _make_charts(self, record: Record, run: int, stretch: Stretch, engaged: npt.NDArray[np.int64]) -> Charts:
        left = float(self._axes.get_position(original=True).x1 * self.figure.get_figwidth())
        return Charts(self.figure, record, run, stretch, np.where(self._present, engaged, np.nan), left)

    def _arena(self, width: float, height: float, parts: Parts, panels: bool) -> "Axes":
        """Axes as large as fit in what header, strip and charts leave: under the legend, left of the charts."""
        inside = _inside(width, panels)
        tall = height - _above(self._record, inside, parts) - _below()
        wide = min(inside, max(tall, 0.1) * _aspect(self._record))
        tall = wide / _aspect(self._record)
        left = _EDGE + (0.0 if panels else (inside - wide) / 2)
        bottom = height - _above(self._record, inside, parts) - tall
        self._margins = left - _EDGE, inside
        return self.figure.add_axes((left / width, bottom / height, wide / width, tall / height))

    def _bare(self, parts: Parts) -> None:
        """No ticks in a film: a bar gives the scale."""
        self._axes.set_xticks([])
        self._axes.set_yticks([])
        self._axes.set_xlabel("")
        self._axes.set_ylabel("")
        self._drawing.scale(always=True)
        shift, inside = self._margins
        draw_legend(self._axes, self._record, halos=parts.halos, sensors=parts.sensors, width=inside, shift=shift)

    def _write(self, width: float, height: float, name: str) -> list[Any]:
        """Two lines above all: title and time, state and time on target."""

        def text(x: float, line: int, words: str = "", **look: Any) -> Any:
            y = 1.0 - (_EDGE + _LINE * (line + 0.6)) / height
            return self.figure.text(x, y, words, va="baseline", **look)

        left, right = _EDGE / width, 1.0 - _EDGE / width
        room = int((width - 2 * _EDGE - 1.8) / _LETTER)
        text(left, 0, shorten(name, max(room, 6)), fontsize=10, fontweight="bold")
        return [
            text(right, 0, ha="right", fontsize=9, color=INK),
            text(left, 1, ha="left", fontsize=9, fontweight="bold"),
            text(right, 1, ha="right", fontsize=9, color=INK),
        ]

    def _time_strip(self, width: float, height: float) -> Any:
        """A strip along the bottom: vermilion while somebody was on target, pale without a target; and a key."""
        self._strip_colors = _STRIP_COLORS[np.where(self._on_target, 2, np.where(self._present, 1, 0))]
        box = (_EDGE / width, (_EDGE + _KEY) / height, 1.0 - 2 * _EDGE / width, _STRIP / height)
        axes = self.figure.add_axes(box)
        axes.set_axis_off()
        axes.set_visible(self._share.size > 1)
        if self._share.size > 1:
            self._key(width, height)
        return axes.imshow(self._strip_colors[None], aspect="auto", interpolation="nearest")

    def _key(self, width: float, height: float) -> None:
        """What the colors of the strip mean, of those that are in it."""
        from matplotlib.patches import Rectangle

        x = _EDGE
        kinds = [(True, 2), (bool((self._present & ~self._on_target).any()), 1), (bool((~self._present).any()), 0)]
        for _, kind in (each for each in kinds if each[0]):
            box = Rectangle((x / width, (_EDGE + 0.02) / height), 0.08 / width, 0.08 / height, linewidth=0,
                            facecolor=tuple(_STRIP_COLORS[kind] / 255), transform=self.figure.transFigure)  # fmt: skip
            self.figure.add_artist(box)
            self.figure.text((x + 0.12) / width, (_EDGE + 0.025) / height, _KEYS[kind], fontsize=6.5, color=GRAY)
            x += 0.25 + 0.05 * len(_KEYS[kind])


_KEYS = ("no target", "not on target", "on target")


def _rgb(color: str) -> npt.NDArray[np.uint8]:
    return np.array([int(color[at : at + 2], 16) for at in (1, 3, 5)], np.uint8)


_STRIP_COLORS = np.array([_rgb("#dfe3e7"), _rgb("#a9b0b8"), _rgb(TARGET)])
_AHEAD = _rgb("#f3f5f7")


def _dpi(shorter: int) -> float:
    """Letters are as large as on a page, but shrink a little with films under 480 pixels, grow with those over 720."""
    return 100.0 * (max(0.7, shorter / 480.0) if shorter < 480 else max(1.0, shorter / 720.0))


def _aspect(record: Record) -> float:
    return arena_aspect(record.scenario.area, _PAD)


def _inside(width: float, panels: bool) -> float:
    """Width of a page's arena [inch]."""
    return width - 2 * _EDGE - (min(_CHARTS, 0.45 * width) if panels else 0.0)


def _above(record: Record, width: float, parts: Parts) -> float:
    """Room for text and legend over the arena [inch]."""
    return _EDGE + 2 * _LINE + legend_height(record, width, halos=parts.halos, sensors=parts.sensors) + 0.08


def _below() -> float:
    return _EDGE + _KEY + _STRIP + 0.03
