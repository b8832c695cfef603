"""Frames into a film: raw pixels piped to the ffmpeg that imageio-ffmpeg brings, written atomically (extra: video)."""

import os
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Any

from shoal.core.errors import MissingExtraError, RecordError
from shoal.core.files import MARK, atomic_file

COLORS = 96  # of a gif's palette; figures have few, and their edges blend

_MP4: tuple[str, ...] = (
    *("-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"),  # what every player can show
    *("-c:v", "libx264", "-preset", "medium", "-crf", "18", "-tune", "animation"),
    *("-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"),
    *("-metadata", f"comment={MARK.decode()}", "-movflags", "+faststart", "-f", "mp4"),
)
_GIF = ("-lavfi", "paletteuse=dither=none:diff_mode=rectangle", "-f", "gif")


def find_ffmpeg() -> str:
    """The path of ffmpeg.

    Raises
    ------
    MissingExtraError : imageio-ffmpeg is not installed, or has no ffmpeg for this machine
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe

        return str(get_ffmpeg_exe())
    except (ImportError, RuntimeError) as error:
        raise MissingExtraError.of("imageio-ffmpeg", "video", "writing a film") from error


@contextmanager
def encoder(file: Path, size: tuple[int, int], fps: float, palette: bytes | None = None) -> Iterator[Any]:
    """Yield a function that takes a frame after the other: RGBA bytes, rows from the top, of a size [pixel].

    The file appears under its name when the context ends well; else nothing is left of it.

    Parameters
    ----------
    palette : for a .gif: frames like those to come, RGBA bytes behind each other, that its colors are chosen from

    Raises
    ------
    RecordError : ffmpeg fails, or the file cannot be written
    """
    ffmpeg = find_ffmpeg()
    look: tuple[str, ...]
    with atomic_file(file, ours=True) as partial, tempfile.TemporaryDirectory(prefix="shoal-film-") as folder:
        if file.suffix.lower() == ".gif":
            colors = _palette(file, ffmpeg, Path(folder) / "palette.png", size, palette or b"")
            look = ("-i", str(colors), *_GIF)
        else:
            look = _MP4
        with _running(file, [ffmpeg, *_raw(size, fps), *look, "-bitexact", "-y", str(partial)]) as pipe:
            yield pipe.write
        if file.suffix.lower() == ".gif":
            _mark(partial)


def _mark(gif: Path) -> None:
    """Say in a comment, before the last byte, who made it; ffmpeg writes none into a gif."""
    with gif.open("r+b") as stream:
        stream.seek(-1, os.SEEK_END)
        if stream.read() == b";":
            stream.seek(-1, os.SEEK_END)
            stream.write(b"\x21\xfe" + bytes([len(MARK)]) + MARK + b"\x00;")


def _raw(size: tuple[int, int], fps: float) -> list[str]:
    width, height = size
    how = ["-hide_banner", "-loglevel", "error", "-nostdin"]
    return [*how, "-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{width}x{height}", "-r", f"{fps:g}", "-i", "-"]


def _palette(file: Path, ffmpeg: str, colors: Path, size: tuple[int, int], frames: bytes) -> Path:
    """Choose the colors of a gif from some of its frames, so that all of them need not be held at once."""
    look = ["-vf", f"palettegen=max_colors={COLORS}:reserve_transparent=1:stats_mode=full", "-y", str(colors)]
    with _running(file, [ffmpeg, *_raw(size, 1), *look]) as pipe:
        pipe.write(frames)
    return colors


@contextmanager
def _running(file: Path, command: list[str]) -> Iterator[IO[bytes]]:
    """Yield the standard input of a process; it has ended when the context has."""
    with tempfile.TemporaryFile() as output:
        # a session of its own: Ctrl-C is for us, and we end it
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=output, stderr=output, start_new_session=True)
        pipe = process.stdin
        assert pipe is not None  # asked for
        broken = False
        try:
            try:
                yield pipe
                pipe.close()
            except BrokenPipeError:
                broken = True  # and it has said why
            if process.wait() != 0 or broken:
                output.seek(0)
                lines = output.read().decode(errors="replace").split("\n")
                raise _failed(file, next((line for line in reversed(lines) if line.strip()), "ffmpeg failed"))
        finally:
            process.kill()
            with suppress(OSError):
                pipe.close()
            process.wait()


def _failed(file: Path, why: str) -> RecordError:
    return RecordError(str(file), f"cannot be written: {why}", "name a file in a folder that exists and you may write")
