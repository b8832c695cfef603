"""What an agent knows, what it says, what it heard, and the whole swarm as arrays.

All SI: positions [m] in the arena's frame (origin at its center), velocities [m/s].
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.kernel import kernel

Floats = npt.NDArray[np.float64]
LANE_BLOCK = 8  # arrays are padded to whole vector registers (8 doubles of AVX-512)


def aligned_zeros(size: int) -> Floats:
    """Return `size` doubles that start on a cache line: whole vectors then never straddle two (10-20 % faster)."""
    room = np.zeros(size + LANE_BLOCK)
    shift = (-(room.ctypes.data // 8)) % LANE_BLOCK
    return room[shift : shift + size]


aligned_zeros_kernel = kernel(aligned_zeros)


class Own(NamedTuple):
    """What an agent knows of itself."""

    id: int
    x: float
    y: float
    vx: float
    vy: float
    on_target: bool
    max_speed: float
    time_step: float


class Report(NamedTuple):
    """What an agent tells its neighbors: the one message of the swarm."""

    id: int
    x: float
    y: float
    vx: float
    vy: float
    on_target: bool


class Heard(NamedTuple):
    """What an agent made of its neighbors' reports: one leader and one sum.

    `found` is whether any neighbor may lead; x, y, vx, vy are the leader's (the agent's own if none).
    `sum_x`, `sum_y` are the sums of the strategy's influence over all neighbors; `neighbors` is how many were heard.
    """

    found: bool
    x: float
    y: float
    vx: float
    vy: float
    sum_x: float
    sum_y: float
    neighbors: int


class Swarm(NamedTuple):
    """State and make of N agents, in arrays of L >= N lanes; lanes from N on are padding and never seen.

    x, y, vx, vy : position and velocity; command_x, command_y : the speed-limited velocity before the wall
    neighbors : k of each agent; memory : the strategy's own fields
    fleet : index of the agent's fleet; fleet_end : (F,) one past the last agent of each fleet
    """

    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    command_x: Floats
    command_y: Floats
    on_target: npt.NDArray[np.bool_]
    max_speed: Floats
    sensor_radius: Floats
    neighbors: npt.NDArray[np.int64]
    fleet: npt.NDArray[np.int64]
    fleet_end: npt.NDArray[np.int64]
    memory: npt.NDArray[Any]


def memory_dtype(fields: tuple[str, ...]) -> np.dtype[Any]:
    """One double per name; a strategy without memory gets one unused field (an empty dtype has no size)."""
    return np.dtype([(name, np.float64) for name in fields or ("unused",)])


def new_swarm(counts: list[int], fields: tuple[str, ...]) -> Swarm:
    """Return a swarm at rest at the origin; padding lanes lie far away, each at a place of its own."""
    agents = sum(counts)
    lanes = -(-agents // LANE_BLOCK) * LANE_BLOCK
    neighbors = np.full(lanes, agents - 1)
    neighbors[agents:] = agents  # a padding lane hears everybody, which never needs a search
    x = aligned_zeros(lanes)
    x[agents:] = 1e15 * np.arange(1, lanes - agents + 1)
    y = aligned_zeros(lanes)
    y[:] = x
    fleet = np.zeros(lanes, np.int64)
    fleet[:agents] = np.repeat(np.arange(len(counts)), counts)
    return Swarm(
        x=x,
        y=y,
        vx=aligned_zeros(lanes),
        vy=aligned_zeros(lanes),
        command_x=aligned_zeros(lanes),
        command_y=aligned_zeros(lanes),
        on_target=np.zeros(lanes, np.bool_),
        max_speed=np.ones(lanes),
        sensor_radius=aligned_zeros(lanes),
        neighbors=neighbors,
        fleet=fleet,
        fleet_end=np.cumsum(counts),
        memory=np.zeros(lanes, memory_dtype(fields)).view(np.recarray),
    )
