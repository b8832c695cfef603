"""Which frames of a run are kept, and whether there is room for them."""

import math
import shutil
from pathlib import Path

from shoal.core.errors import ScenarioError
from shoal.engine.stage import new_frames
from shoal.record.files import RecordFolder
from shoal.run.simulation import count_frames
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario

OVERVIEW = 500  # frames of the first run kept over its whole length, unless asked otherwise
TAIL = 300  # and of its last steps, all
ROOM = 500_000_000  # [bytes] of frames that nobody asked for: of very many agents, they are fewer
_SHARE = OVERVIEW / (OVERVIEW + TAIL)


class Keep:
    """Which frames are kept, and where they go.

    Parameters
    ----------
    scenario : what is run
    every : frames of every n-th step of all runs; default: an overview of the first, and its last steps
    runs : how many there will be
    folder : of the record; default: frames stay in memory

    Attributes
    ----------
    notes : a sentence where fewer frames are kept than usual

    Raises
    ------
    ScenarioError : frames that were asked for need more room than there is
    """

    def __init__(self, scenario: Scenario, every: int | None, runs: int, folder: RecordFolder | None) -> None:
        steps, size = scenario.steps, frame_bytes(scenario)
        fit = max(2, ROOM // size)
        self.every, self.tail = _evenly(steps, OVERVIEW, TAIL)
        self.notes: list[str] = []
        if every:
            self.every, self.tail = every, steps
        elif count_frames(0, steps, self.every, self.tail) > fit:
            overview = math.ceil(_SHARE * fit)
            self.every, self.tail = _evenly(steps, overview, fit - overview)
        self.all_runs = every is not None
        self.folder = folder
        self.frames = count_frames(0, steps, self.every, self.tail)
        if every:
            check_room(runs * self.frames, size, folder.folder if folder else None)
        elif self.frames < count_frames(0, steps, *_evenly(steps, OVERVIEW, TAIL)):
            self.notes.append(
                f"a frame of {scenario.agents:,} agents takes {size / 1e6:.1f} MB: {self.frames} of the first run are "
                "kept; `--every n` keeps every n-th step of all"
            )


def _evenly(steps: int, overview: int, tail: int) -> tuple[int, int]:
    """One step in how many is kept, and the step from which all are."""
    return max(1, -(-steps // overview)), max(0, steps - tail)


def frame_bytes(scenario: Scenario) -> int:
    """What a frame takes in memory, and in a record."""
    return sum(
        each.nbytes for each in new_frames(1, scenario.agents, len(scenario.targets), len(crew_of(scenario).memory))
    )


def check_room(frames: int, frame: int, folder: Path | None) -> None:
    """Refuse frames of so many bytes each that do not fit on the disk of a folder, or without one into memory.

    Raises
    ------
    ScenarioError : there is not enough room
    """
    try:
        room = shutil.disk_usage(_existing(folder)).free if folder else _memory()
    except OSError:
        return  # nobody knows how much there is
    if frames * frame > room:
        problem = f"keeps {frames:,} frames of {frame / 1e6:,.1f} MB: {_size(frames * frame)}, and there is room for"
        where = "on the disk" if folder else "in memory"
        fix = "keep fewer steps with a larger --every" + ("" if folder else ", or write them to a folder with --out")
        raise ScenarioError("every", f"{problem} {_size(room)} {where}", fix)


def _existing(folder: Path) -> Path:
    """The folder, or the one above that is there already."""
    return next(each for each in (folder.absolute(), *folder.absolute().parents) if each.exists())


def _memory() -> int:
    """Bytes of frames that go into what memory nobody uses; raises OSError where the system does not say.

    They take twice as much for a moment, when they are joined.
    """
    for line in Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return int(line.split()[1]) * 1024 // 2
    raise OSError


def _size(number: float) -> str:
    return f"{number / 1e9:,.1f} GB"
