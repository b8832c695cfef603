"""Specification of films: as many frames of the size asked for, showing what was; whole files or none."""

import re
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from shoal.core.errors import MissingExtraError, RecordError, ShoalError
from shoal.drawing.arena_drawing import Parts
from shoal.drawing.encoder import find_ffmpeg
from shoal.drawing.film import FilmLook, write_film
from shoal.drawing.film_page import FilmPage, film_size
from shoal.drawing.stretch import stretch_of
from shoal.drawing.style import style

pytest.importorskip("imageio_ffmpeg", reason="imageio-ffmpeg is not installed")

SMALL = FilmLook(fps=25, width=240, height=240)
PLAIN = Parts()
TWO_TARGETS = [{"kind": "still", "radius": 1.0}, {"kind": "waypoint", "radius": 0.5, "speed": 3.0}]


def decoded(file):
    """What a player sees: what ffmpeg says of the stream, and its pixels (K, height, width, 3)."""
    command = [find_ffmpeg(), "-i", file, "-fps_mode", "passthrough", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    done = subprocess.run(command, capture_output=True, check=True)
    stream = next(line for line in done.stderr.decode().splitlines() if "Video:" in line)
    width, height = map(int, re.search(r" (\d{2,})x(\d+)", stream).groups())
    return stream, np.frombuffer(done.stdout, np.uint8).reshape(-1, height, width, 3)


def pixels(record, number, parts=PLAIN, panels=False, width=240):
    """A frame (height, width, 4)."""
    with style():
        size = film_size(record, width, None, parts, panels)
        page = FilmPage(record, 0, stretch_of(record.trajectories[0].step), size, parts, panels)
        return np.frombuffer(page.pixels(number), np.uint8).reshape(size.height, size.width, 4).copy()


class TestFilm:
    @pytest.mark.parametrize("kind", ["mp4", "gif"])
    def test_it_has_the_frames_and_the_size_asked_for(self, make_record, tmp_path, kind):
        made = write_film(make_record(), tmp_path / f"film.{kind}", steps=6, look=SMALL)
        stream, frames = decoded(made.file)
        assert (made.frames, made.first, made.last, made.size) == (6, 34, 39, (240, 240))
        assert frames.shape == (6, 240, 240, 3)
        assert " 25 fps" in stream

    def test_a_film_plays_everywhere(self, make_record, tmp_path):
        made = write_film(make_record(), tmp_path / "film.mp4", steps=2, look=SMALL)
        stream, _ = decoded(made.file)
        assert "h264" in stream
        assert "yuv420p(tv, bt709" in stream
        content = made.file.read_bytes()
        assert content.index(b"moov") < content.index(b"mdat")  # it starts before all of it is there

    def test_odd_sizes_are_rounded_down(self, make_record, tmp_path):
        look = FilmLook(width=301, height=241)
        assert write_film(make_record(), tmp_path / "film.mp4", steps=2, look=look).size == (300, 240)

    def test_without_a_height_the_arena_decides(self, make_record):
        wide, tall = (
            film_size(make_record(area=area), 300, None, Parts(), panels=False)
            for area in ((40.0, 10.0, 1.0), (10.0, 40.0, 1.0))
        )
        assert wide.width == tall.width == 300
        assert wide.height < 300 < tall.height
        assert wide.height % 2 == tall.height % 2 == 0

    def test_every_second_step(self, make_record, tmp_path):
        made = write_film(make_record(), tmp_path / "film.mp4", start=10, steps=10, every=2, look=SMALL)
        assert (made.frames, made.first, made.last, made.every) == (5, 10, 18, 2)

    def test_progress_counts_frames(self, make_record, tmp_path):
        told = []
        write_film(make_record(), tmp_path / "f.mp4", steps=3, look=SMALL, progress=lambda *each: told.append(each))
        assert told == [(1, 3), (2, 3), (3, 3)]

    def test_the_same_film_has_the_same_frames(self, make_record, tmp_path):
        files = [write_film(make_record(), tmp_path / name, steps=3, look=SMALL).file for name in ("a.gif", "b.gif")]
        assert files[0].read_bytes() == files[1].read_bytes()


class TestFrames:
    """What a frame shows is drawn anew each time; nothing of the frame before is left."""

    @pytest.mark.parametrize("panels", [False, True])
    def test_a_frame_is_the_same_whatever_was_shown_before(self, make_record, panels):
        record = make_record(targets=TWO_TARGETS)
        parts = Parts(links=True)
        with style():
            size = film_size(record, 320, None, parts, panels)
            page = FilmPage(record, 0, stretch_of(record.trajectories[0].step), size, parts, panels)
            once = bytes(page.pixels(20))
            for number in (39, 0, 7):
                page.pixels(number)
            assert bytes(page.pixels(20)) == once

    @pytest.mark.parametrize("kind", ["mp4", "gif"])
    def test_each_frame_of_the_file_shows_its_own_step(self, make_record, tmp_path, kind):
        record = make_record()
        _, film = decoded(write_film(record, tmp_path / f"f.{kind}", start=0, steps=40, look=FilmLook(width=240)).file)
        steps = (0, 15, 39)
        drawn = [pixels(record, step)[:, :, :3].astype(int) for step in steps]
        for place, step in enumerate(steps):
            assert np.argmin([np.abs(film[step] - each).mean() for each in drawn]) == place

    def test_the_target_is_where_it_was(self, make_record):
        """The only thing between two frames of a swarm at rest that differs in the arena is the target."""
        record = make_record()
        record.trajectories[0].target_y[...] = 0.0
        record.trajectories[0].target_y[-1] = 5.0
        before, after = (pixels(record, number, Parts(trails=False)).astype(int) for number in (38, 39))
        differ = np.argwhere(np.abs(before - after).max(axis=2)[70:-28] > 0)  # between legend and strip
        rows, columns = differ.min(axis=0), differ.max(axis=0)
        meter = 240 / 20
        assert columns[0] - rows[0] == pytest.approx(7 * meter, abs=0.15 * 7 * meter)  # 5 m, and a radius of 1 m each
        assert columns[1] - rows[1] == pytest.approx(2 * meter, abs=4)

    @pytest.mark.parametrize("absent", ["agents", "target"])
    def test_who_is_not_there_is_not_drawn(self, make_record, absent):
        record = make_record()
        frames = record.trajectories[0]
        (frames.alive if absent == "agents" else frames.target_present)[-1] = False
        colors = {"agents": (0x00, 0x72, 0xB2), "target": (0xD5, 0x5E, 0x00)}
        arena = pixels(record, 39, Parts(trails=False), width=300)[100:-28, :, :3]
        seen = {name: bool((arena == color).all(axis=2).any()) for name, color in colors.items()}
        assert seen == {name: name != absent for name in colors}

    def test_halos_are_drawn_to_scale(self, make_record):
        record = make_record(counts=(2,))
        drawn = []
        for radius in (0.0, 3.0):
            frames = replace(record.trajectories[0], memory={"repulsion": np.full((40, 2), radius)})
            drawn.append(pixels(replace(record, trajectories={0: frames}), 39, Parts(halos=True, trails=False)))
        rows = np.flatnonzero((drawn[0] != drawn[1]).any(axis=(1, 2)))
        assert rows.max() - rows.min() == pytest.approx(6.0 * 240 / 20, abs=6)


class TestStill:
    def test_a_png_shows_the_last_step(self, make_record, tmp_path):
        made = write_film(make_record(), tmp_path / "still.png", look=SMALL)
        assert made.file.read_bytes().startswith(b"\x89PNG")
        assert (made.last, made.size) == (39, (240, 240))

    def test_it_is_the_frame_of_the_film(self, make_record, tmp_path):
        from matplotlib.image import imread

        record = make_record()
        still = imread(write_film(record, tmp_path / "s.png", look=FilmLook(width=300)).file)
        film = pixels(record, 39, width=300)
        assert still.shape == film.shape
        assert np.abs(still * 255 - film).mean() < 0.5  # what moves lies over what does not, but for the scale bar

    def test_any_step_that_was_kept(self, make_record, tmp_path):
        assert write_film(make_record(), tmp_path / "s.png", start=7, steps=1, look=SMALL).first == 7


class TestErrors:
    """What cannot be filmed is said at the door, and nothing is left behind."""

    BAD = (
        ("film.avi", FilmLook(), {}, "does not end in .mp4, .gif or .png"),
        ("film", FilmLook(), {}, "does not end in"),
        ("nowhere/film.mp4", FilmLook(), {}, "there is no folder nowhere"),
        ("film.mp4", FilmLook(fps=0.1), {}, "choose 1 to 60 frames"),
        ("film.mp4", FilmLook(width=50), {}, "has a side of 50 pixels"),
        ("film.mp4", FilmLook(width=300, height=9000), {}, "has a side of 9000"),
        ("film.mp4", FilmLook(), {"start": 50}, "step 50: was not kept"),
        ("film.mp4", FilmLook(), {"run": 1}, "kept no trajectory"),
        ("film.mp4", FilmLook(parts=Parts(halos=True)), {}, "halos: show a_R, which strategy knn-pso has none of"),
        ("film.mp4", FilmLook(parts=Parts(sensors=True)), {}, "sensor discs: have radius 0"),
    )

    @pytest.mark.parametrize(("name", "look", "wish", "says"), BAD, ids=[each[3] for each in BAD])
    def test_bad_input(self, make_record, tmp_path, monkeypatch, name, look, wish, says):
        monkeypatch.chdir(tmp_path)
        with pytest.raises(ShoalError, match=says):
            write_film(make_record(), name, look=look, **wish)
        assert not list(tmp_path.iterdir())

    @pytest.mark.parametrize("kind", ["mp4", "gif"])
    def test_an_interrupt_leaves_what_was_there_before(self, make_record, tmp_path, kind):
        def interrupt(done, total):
            raise KeyboardInterrupt

        file = tmp_path / f"film.{kind}"
        file.write_text("old, of shoal")
        with pytest.raises(KeyboardInterrupt):
            write_film(make_record(), file, steps=4, look=SMALL, progress=interrupt)
        assert [(each.name, each.read_text()) for each in tmp_path.iterdir()] == [(file.name, "old, of shoal")]

    def test_an_ffmpeg_that_fails_is_one_error_with_its_words(self, make_record, tmp_path, monkeypatch):
        broken = tmp_path / "ffmpeg"
        broken.write_text("#!/bin/sh\necho no space left >&2\nexit 1\n")
        broken.chmod(0o755)
        monkeypatch.setattr("shoal.drawing.encoder.find_ffmpeg", lambda: str(broken))
        with pytest.raises(RecordError, match="cannot be written: no space left"):
            write_film(make_record(), tmp_path / "film.mp4", look=SMALL)
        assert [each.name for each in tmp_path.iterdir()] == ["ffmpeg"]

    def test_a_missing_extra_is_one_sentence(self, make_record, tmp_path, monkeypatch):
        monkeypatch.setitem(__import__("sys").modules, "imageio_ffmpeg", None)
        with pytest.raises(MissingExtraError, match=r"pip install '\.\[video\]'"):
            write_film(make_record(), tmp_path / "film.mp4", look=SMALL)

    def test_a_still_needs_no_ffmpeg(self, make_record, tmp_path, monkeypatch):
        monkeypatch.setitem(__import__("sys").modules, "imageio_ffmpeg", None)
        assert Path(write_film(make_record(), tmp_path / "still.png", look=SMALL).file).exists()
