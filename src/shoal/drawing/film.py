"""Film: a stretch of a run as .mp4 or .gif, or one moment of it as .png (extra: video)."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from shoal.core.errors import ShoalError
from shoal.core.files import check_file
from shoal.drawing.arena_drawing import Parts
from shoal.drawing.encoder import encoder, find_ffmpeg
from shoal.drawing.files import save_figure
from shoal.drawing.film_page import FilmPage, film_size
from shoal.drawing.snapshot import frames_of
from shoal.drawing.stretch import stretch_of
from shoal.drawing.style import require_matplotlib, style
from shoal.record.record import Record

if TYPE_CHECKING:
    from shoal.run.simulate import ProgressCallback

FORMATS = ("mp4", "gif", "png")
SMALLEST, LARGEST = 200, 4096  # [pixel] a side
SLOWEST, FASTEST = 1.0, 60.0  # [frames/s]
_FPS = {"mp4": 30.0, "gif": 20.0, "png": 1.0}
_WIDTH = {"mp4": 720, "gif": 480, "png": 720}
_WIDER = 1.5  # with charts
_SAMPLES = 12  # frames from which a gif's colors are chosen


class FilmLook(NamedTuple):
    """How a film looks. None: what suits its format.

    fps : frames per second; width, height [pixel], rounded down to even: without a height the arena decides
    """

    fps: float | None = None
    width: int | None = None
    height: int | None = None
    parts: Parts = Parts()
    panels: bool = False  # charts beside the arena


PLAIN = FilmLook()


class Film(NamedTuple):
    """What was written: number of frames, of the steps first to last, one in `every`; its size [pixel]."""

    file: Path
    frames: int
    first: int
    last: int
    every: int
    fps: float
    size: tuple[int, int]


def write_film(
    record: Record,
    path: str | Path,
    *,
    run: int = 0,
    start: int | None = None,
    steps: int | None = None,
    every: int | None = None,
    look: FilmLook = PLAIN,
    progress: "ProgressCallback | None" = None,
) -> Film:
    """Write a film of the steps `start` to `start + steps - 1`, or of the last stretch kept that is evenly apart.

    A .png shows the last of these steps. A file of this name is replaced when the film is complete.

    `write_film(record, "swarm.mp4", steps=200, look=FilmLook(fps=25, parts=Parts(links=True)))`

    Parameters
    ----------
    record : of a run that kept a trajectory
    path : a file .mp4, .gif, or .png
    run : number of the run
    start, steps, every : first step shown, how many, and one in how many
    look : size, frame rate, and what is drawn
    progress : called as progress(frames done, frames in all)

    Raises
    ------
    ShoalError : another suffix, or a frame rate or size that cannot be
    RecordError : frames that were not kept, nothing to show of a part, a file that cannot be written
    MissingExtraError : matplotlib or imageio-ffmpeg is not installed
    """
    file = Path(path)
    kind = check_film(file, look)
    kept = np.asarray(frames_of(record, run).step)
    stretch = stretch_of(kept, start, steps, every)
    fps = look.fps or _FPS[kind]
    width = look.width or round(_WIDTH[kind] * (_WIDER if look.panels else 1.0))
    with style():
        size = film_size(record, width, look.height, look.parts, look.panels)
        page = FilmPage(record, run, stretch, size, look.parts, look.panels)
        if kind == "png":
            page.show(stretch.frames.size - 1)
            save_figure(page.figure, file, dpi=size.dpi)
        else:
            _encode(page, file, stretch.frames.size, size[:2], fps, progress)
    first, last = (int(kept[at]) for at in (stretch.frames[0], stretch.frames[-1]))
    return Film(file, stretch.frames.size, first, last, stretch.every, fps, size[:2])


def check_film(file: Path, look: FilmLook) -> str:
    """Return mp4, gif or png, as the suffix says; refuse, before anything is run, a film that cannot be.

    Raises
    ------
    ShoalError, MissingExtraError : as `write_film`
    """
    kind = file.suffix.lower().removeprefix(".")
    if kind not in FORMATS:
        raise ShoalError(str(file), "does not end in .mp4, .gif or .png", "name a film .mp4 or .gif, a still .png")
    check_file(file, ours=True)
    if look.fps is not None and not SLOWEST <= look.fps <= FASTEST:
        raise ShoalError("fps", f"is {look.fps:g}", f"choose {SLOWEST:g} to {FASTEST:g} frames per second")
    for side in (look.width, look.height):
        if side is not None and not SMALLEST <= side <= LARGEST:
            raise ShoalError("size", f"has a side of {side} pixels", f"choose {SMALLEST} to {LARGEST}")
    require_matplotlib()
    if kind != "png":
        find_ffmpeg()
    return kind


def default_fps(file: Path) -> float:
    """Frames per second of a film of this name if nobody says otherwise."""
    return _FPS[file.suffix.lower().removeprefix(".")]


def _encode(
    page: FilmPage, file: Path, frames: int, size: tuple[int, int], fps: float, progress: "ProgressCallback | None"
) -> None:
    samples = b""
    if file.suffix.lower() == ".gif":
        chosen = np.unique(np.linspace(0, frames - 1, min(frames, _SAMPLES)).round().astype(int))
        samples = b"".join(bytes(page.pixels(number)) for number in chosen.tolist())
    with encoder(file, size, fps, samples) as write:
        for number in range(frames):
            write(page.pixels(number))
            if progress:
                progress(number + 1, frames)
