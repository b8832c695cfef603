"""A frame as bytes: docs/reference/view-protocol.md, in the words of numpy."""

from collections.abc import Collection, Iterable
from functools import cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.errors import MessageError
from shoal.core.links import MOST_LINKED
from shoal.record.trajectory import Trajectory
from shoal.record.voyage.voyages import Places

FORMAT = 4  # 1 had no links, 2 no memory but a_R
LEAN = 3  # the format without what can only be seen of few: velocities, a_R and k of each agent
FULL = 10_000  # agents of the largest swarm whose frames are not lean
REPULSION = "repulsion"  # the memory field that the page shows as a_R
MOST_FIELDS = 16  # of memory, besides a_R
BINS = 11  # of phi
RECENT = 1000  # steps of the shorter mean
ON_TARGET, ALIVE, SILENT = 1, 2, 4  # bits of an agent
PRESENT = 1  # bit of a target
_SIZES = ("agents", "targets", "link_bytes", "fields")

SCALARS = ("time_on_target", "recent", "xi", "xi_now", "engaged")


class Gauges(NamedTuple):
    """The numbers of a frame; NaN where one does not exist.

    time_on_target, xi : means since the scene's `since`; recent : time on target over the last 1,000 steps
    xi_now, engaged, phi : of this frame; phi (11,) agents per bin
    """

    time_on_target: float
    recent: float
    xi: float
    xi_now: float
    engaged: float
    phi: npt.ArrayLike


def pack(
    frames: Trajectory, at: int, *, run: int, epoch: int, gauges: Gauges, silent: Collection[int] = (),
    lean: bool = False,
) -> bytes:  # fmt: skip
    """Return the bytes of one frame of a trajectory, in which some are silent; `lean`: where and on target or not."""
    fields = remembered(frames.memory, frames.x.shape[1])
    size = frames.x.shape[1], frames.target_x.shape[1], frames.links.shape[2], len(fields)
    frame = np.zeros((), _layout(*size, lean=lean))
    frame["format"], frame["run"], frame["epoch"] = LEAN if lean else FORMAT, run, epoch % 65536
    frame["step"] = frames.step[at]
    frame["agents"], frame["targets"], frame["link_bytes"], frame["fields"] = size
    frame["gauges"] = [*gauges[:-1], *np.asarray(gauges.phi, float)]
    for name in ("x", "y", "target_x", "target_y", "links", *(() if lean else ("vx", "vy"))):
        frame[name] = getattr(frames, name)[at]
    if not lean:
        frame["repulsion"] = frames.memory[REPULSION][at] if REPULSION in frames.memory else np.nan
        frame["degree"] = frames.neighbors[at]
        for place, name in enumerate(fields):
            frame["memory"][place] = frames.memory[name][at]
    frame["agent_bits"] = frames.on_target[at] * ON_TARGET + frames.alive[at] * ALIVE
    frame["target_bits"] = frames.target_present[at] * PRESENT
    if silent:
        ids = np.fromiter(silent, np.int64, len(silent))
        frame["agent_bits"][ids] |= SILENT
    return frame.tobytes()


def places_of(frame: bytes) -> Places:
    """Return where everybody is in a packed frame.

    Raises
    ------
    MessageError : bytes that are no frame of this format
    """
    try:
        head = np.frombuffer(frame, _layout(0, 0, 0, 0), count=1)[0]
        if head["format"] != FORMAT:
            raise ValueError(f"it is of format {head['format']}, not {FORMAT}")
        (read,) = np.frombuffer(frame, _layout(*(int(head[name]) for name in _SIZES)))
    except (ValueError, TypeError, OverflowError, MemoryError) as error:
        raise MessageError("frame", f"cannot be read: {error}", "watch with the same version of Shoal") from None
    numbers = {name: read[name][None].astype(np.float64) for name in ("x", "y", "vx", "vy", "target_x", "target_y")}
    return Places(
        step=np.array([read["step"]], np.int64),
        on_target=(read["agent_bits"] & ON_TARGET > 0)[None],
        alive=(read["agent_bits"] & ALIVE > 0)[None],
        target_present=(read["target_bits"] & PRESENT > 0)[None],
        **numbers,
    )


def gauges_of(frame: bytes) -> Gauges:
    """Return the numbers of a packed frame."""
    numbers = np.frombuffer(frame, _layout(0, 0, 0, 0), count=1)["gauges"][0]  # they come before the agents
    return Gauges._make([*numbers[:5].tolist(), numbers[5:]])


def remembered(memory: Iterable[str], agents: int) -> list[str]:
    """Fields of memory that a frame of so many agents holds, besides a_R: as for links, those of few are kept."""
    return [name for name in memory if name != REPULSION][: MOST_FIELDS if agents <= MOST_LINKED else 0]


def frame_bytes(agents: int, targets: int, width: int, fields: int = 0, *, lean: bool = False) -> int:
    """Return the size of a packed frame of agents with `width` bytes of links and `fields` fields of memory each."""
    return _layout(agents, targets, width, fields, lean=lean).itemsize


@cache
def _layout(agents: int, targets: int, link_bytes: int, fields: int, *, lean: bool = False) -> np.dtype[np.void]:
    """Little endian, without gaps."""
    per_agent = [(name, "<f4", (agents,)) for name in ("x", "y", *(() if lean else ("vx", "vy", "repulsion")))]
    per_target = [(name, "<f4", (targets,)) for name in ("target_x", "target_y")]
    return np.dtype(
        [
            ("format", "u1"),
            ("run", "u1"),
            ("epoch", "<u2"),
            ("step", "<u4"),
            ("agents", "<u4"),
            ("targets", "<u4"),
            ("link_bytes", "<u2"),
            ("fields", "<u2"),
            ("gauges", "<f4", (5 + BINS,)),
            *per_agent,
            ("memory", "<f4", (fields, agents)),
            *per_target,
            *(() if lean else (("degree", "<u2", (agents,)),)),
            ("agent_bits", "u1", (agents,)),
            ("target_bits", "u1", (targets,)),
            ("links", "u1", (agents, link_bytes)),
        ]
    )
