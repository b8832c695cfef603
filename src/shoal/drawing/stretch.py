"""Which frames a film or a map shows: a stretch of a run, its steps evenly apart."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError

Steps = npt.NDArray[np.int64]


class Stretch(NamedTuple):
    """Frames, as indices into those of a run (K,), and the steps between two of them."""

    frames: npt.NDArray[np.intp]
    every: int


def stretch_of(kept: Steps, start: int | None = None, steps: int | None = None, every: int | None = None) -> Stretch:
    """Return the frames of `steps` steps from step `start` on, as many of them as `every` says.

    Parameters
    ----------
    kept : (K,) steps of the frames that there are, rising
    start : default: the last `steps` steps; without these too, the last stretch of frames that are evenly apart
    steps : default: all from `start` on
    every : steps between two frames; default: as few as the frames kept allow

    Raises
    ------
    RecordError : a frame that is needed was not kept
    """
    first = _first(kept, start, steps)
    last = int(kept[-1]) if steps is None else first + steps - 1
    inside = np.flatnonzero((kept >= first) & (kept <= last))
    apart = np.diff(kept[inside])
    every = every or int(apart.max(initial=1))
    chosen = inside[(kept[inside] - first) % every == 0]
    if (np.diff(kept[chosen]) != every).any() or last - kept[chosen[-1]] >= every:
        raise _missing(kept, f"steps {first} to {last}", f"were not all kept, {every} apart")
    return Stretch(chosen, every)


def frame_of(kept: Steps, step: int) -> int:
    """The index of the frame of a step.

    Raises
    ------
    RecordError : it was not kept
    """
    at = int(np.searchsorted(kept, step))
    if at == kept.size or kept[at] != step:
        raise _missing(kept, f"step {step}", "was not kept")
    return at


def kept_text(kept: Steps) -> str:
    """The steps kept, in few words: 0, 10, ... 4690 and 4700 to 4999."""
    ends = np.flatnonzero(np.diff(np.diff(kept)) != 0) + 1 if kept.size > 2 else np.empty(0, np.intp)
    parts = []
    begin = 0
    for end in [*ends.tolist(), kept.size - 1]:
        if end > begin:
            first, second, last = (int(kept[at]) for at in (begin, begin + 1, end))
            parts.append(f"{first} to {last}" if second == first + 1 else f"{first}, {second}, ... {last}")
            begin = end
    return " and ".join(parts[:2] + ["..."] * (len(parts) > 2)) or str(int(kept[0]))


def _first(kept: Steps, start: int | None, steps: int | None) -> int:
    if start is not None:
        return int(kept[frame_of(kept, start)])
    if steps is not None:
        first = max(int(kept[-1]) - steps + 1, int(kept[0]))
        return int(kept[np.searchsorted(kept, first)])
    uneven = np.flatnonzero(np.diff(np.diff(kept)) != 0) if kept.size > 2 else np.empty(0, np.intp)
    return int(kept[uneven[-1] + 1 if uneven.size else 0])


def _missing(kept: Steps, what: str, problem: str) -> RecordError:
    return RecordError(
        what,
        f"{problem}; the record keeps {kept_text(kept)}",
        "choose among these, or run again with --every 1 (in Python every=1) to keep all",
    )
