"""Replay: a record as one page that needs no engine and no network."""

from typing import Literal

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError, ScenarioError
from shoal.record.record import Record
from shoal.viewer.frame import FULL, frame_bytes, remembered
from shoal.viewer.page import inline_page
from shoal.viewer.recorded import recorded_frames, recorded_scene
from shoal.viewer.ring import evenly

Part = Literal["all", "end"]

FRAMES = 2000  # in a page, unless asked otherwise
ROOM = 64_000_000  # [bytes] of frames in a page, at most: what browsers open in a moment


def replay_page(record: Record, *, frames: int = FRAMES, part: Part = "all") -> str:
    """Return one HTML text that plays a record's first recorded run.

    Parameters
    ----------
    frames : at most this many, and no more than `most_frames`
    part : spread evenly in time over the whole run; or the last ones, as far as every step was kept

    Raises
    ------
    RecordError : the record keeps no frames
    ScenarioError : fewer than one frame is asked for
    ShoalError : the page is not built
    """
    if frames < 1:
        raise ScenarioError("frames", f"is {frames}", "ask for 1 or more")
    if not record.trajectories:
        raise RecordError("record", "keeps no frames", "run the scenario again with --out")
    run, kept = next(iter(record.trajectories.items()))
    fields = len(remembered(kept.memory, record.facts.agents))
    most = most_frames(record.facts.agents, kept.target_x.shape[1], kept.links.shape[2], fields)
    chosen = choose_frames(np.asarray(kept.step), min(frames, most), part)
    return inline_page(recorded_scene(record, run), b"".join(recorded_frames(record, run, chosen)))


def most_frames(agents: int, targets: int, width: int, fields: int = 0) -> int:
    """How many frames a page has room for: of agents, with `width` bytes of links and fields of memory, and targets."""
    return max(1, ROOM // frame_bytes(agents, targets, width, fields, lean=agents > FULL))


def choose_frames(steps: npt.NDArray[np.int64], frames: int, part: Part) -> npt.NDArray[np.int64]:
    """Indices of the kept frames to show, given their steps in order (K,): see `replay_page`."""
    if part == "end":
        gaps = np.flatnonzero(np.diff(steps) > 1)
        first = int(gaps[-1]) + 1 if gaps.size else 0
        return np.arange(max(first, steps.size - frames), steps.size)
    return evenly(steps, frames)
