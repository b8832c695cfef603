"""The whole swarm as arrays; what one agent knows, says and hears is in messages.py.

All SI: positions [m] in the arena's frame (origin at its center), velocities [m/s].
"""

from collections import namedtuple
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
LANE_BLOCK = 8  # arrays are padded to whole vector registers (8 doubles of AVX-512)


def aligned_zeros(size: int) -> Floats:
    """Return `size` doubles that start on a cache line: whole vectors then never straddle two (10-20 % faster)."""
    room = np.zeros(size + LANE_BLOCK)
    shift = (-(room.ctypes.data // 8)) % LANE_BLOCK
    return room[shift : shift + size]


class Bodies(NamedTuple):
    """State of N agents, all that changes of them, in arrays of L >= N lanes; lanes from N on are padding, never seen.

    x, y, vx, vy : position and velocity; command_x, command_y : the speed-limited velocity before the wall
    on_target : what it believes and reports; engaged : whether it detects a present target, not a false alarm
    alive : 1.0, or 0.0 if lost or not yet joined; joins, leaves : it is present in steps [joins, leaves)
    neighbors : k of each agent; contact : share of recent steps with a leader, by which k may adapt
    drift_x, drift_y : what nature added to its velocity in the last step [m/s]; aground : whether land stopped it then
    fix_x, fix_y : where it believes to be; the arrays x, y themselves where everybody knows
    error_x, error_y : how far that is off [m]; spent : taken from its battery so far [J]
    order : which it is under, see world/orders.py; home_x, home_y : where it believed to be when it set out
    memory, told : (L, fields) what agents remember, and what of it they tell; the strategy sees them as `Memories`
    """

    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    command_x: Floats
    command_y: Floats
    on_target: npt.NDArray[np.bool_]
    engaged: npt.NDArray[np.bool_]
    alive: Floats
    joins: npt.NDArray[np.int64]
    leaves: npt.NDArray[np.int64]
    neighbors: npt.NDArray[np.int64]
    contact: Floats
    drift_x: Floats
    drift_y: Floats
    aground: npt.NDArray[np.bool_]
    fix_x: Floats
    fix_y: Floats
    error_x: Floats
    error_y: Floats
    spent: Floats
    order: npt.NDArray[np.int64]
    home_x: Floats
    home_y: Floats
    memory: Floats
    told: Floats


class Makes(NamedTuple):
    """What is chosen of N agents and does not change, in arrays of L lanes.

    max_speed [m/s], sensor_radius [m]
    detection, false_alarm : chance per step to notice a target within reach, and to report an absent one
    horizon : how far the sensor sees at all [m]; glimpse : its rate of detection times the cube of the range [m^3/s], 0
        where every range within is alike
    position_error : standard deviation of each coordinate [m]; position_memory : share of an error left a step later
    capacity : of the battery [J], inf for none; hotel [W], drag [W/(m/s)^3] : what it draws, see world/energy.py
    curve : (F, 2, P) speeds [m/s] and powers [W] of each fleet's propulsion besides
    max_acceleration [m/s^2], max_turn_rate [rad/s] : inf for none
    share_end : its part of the swarm's summed top speeds ends here, see `Briefing`; station_x, station_y : see there
    leeway : (L, 4) how the wind moves it, fields of world/sea/sea.py's Leeway
    fleet : index of the agent's fleet; fleet_end : (F,) one past the last agent of each fleet
    """

    max_speed: Floats
    sensor_radius: Floats
    horizon: Floats
    glimpse: Floats
    detection: Floats
    false_alarm: Floats
    position_error: Floats
    position_memory: Floats
    capacity: Floats
    hotel: Floats
    drag: Floats
    curve: Floats
    max_acceleration: Floats
    max_turn_rate: Floats
    share_end: Floats
    station_x: Floats
    station_y: Floats
    leeway: Floats
    fleet: npt.NDArray[np.int64]
    fleet_end: npt.NDArray[np.int64]


def both(name: str, state: Any, chosen: Any, module: str) -> Any:
    """A class of NamedTuples with the fields of two, as kernels take them: what changes, and what is chosen."""
    return namedtuple(name, state._fields + chosen._fields, module=module)


Swarm = both("Swarm", Bodies, Makes, __name__)


def part_of(whole: Any, kind: Any) -> Any:
    """The part of a value that a class of NamedTuples names, such as part_of(swarm, Bodies); arrays are shared."""
    return kind(*(getattr(whole, name) for name in kind._fields))


class Memories(NamedTuple):
    """Memory and what is told of it as records, in the words of the strategy: views of Swarm.memory and Swarm.told.

    arrived : (D, L) what was told in the last steps, a view of Radio.told
    """

    memory: npt.NDArray[Any]
    told: npt.NDArray[Any]
    arrived: npt.NDArray[Any]


class TurnMemories(Memories):
    """Memories where agents decide one after the other: what is compiled for them goes by any number of listeners."""


class SingleMemories(Memories):
    """Memories in single precision: what is compiled for them goes by such distances, and lanes of such numbers."""


class SingleListedMemories(Memories):
    """Memories in single precision where there are many agents."""


class KeptMemories(Memories):
    """Memories where reports are kept: what is compiled for them goes by a report of its own for each pair."""


class ListedMemories(Memories):
    """Memories where there are many agents: what is compiled for them goes by lists of neighbors."""


NEVER = 1 << 62  # a step that does not come


def as_records(numbers: Floats, fields: tuple[str, ...]) -> npt.NDArray[Any]:
    """Numbers (..., fields) as records with one double per name; see `width`."""
    dtype = np.dtype([(name, np.float64) for name in fields or ("unused",)])
    return numbers.view(dtype).reshape(numbers.shape[:-1]).view(np.recarray)


def width(fields: tuple[str, ...]) -> int:
    """Numbers per agent: no names have one unused, for an empty dtype has no size."""
    return len(fields) or 1


def new_swarm(
    counts: list[int], fields: tuple[str, ...], told: tuple[str, ...] = (), *, exact: bool = True, points: int = 1
) -> Any:
    """Return a swarm at rest at the origin; padding lanes lie far away, each at a place of its own.

    fields : of the memory; the first of them are `told`
    exact : everybody knows where it is; points : how many the longest curve of a fleet's power has
    """
    agents = sum(counts)
    lanes = -(-agents // LANE_BLOCK) * LANE_BLOCK
    neighbors = np.full(lanes, agents - 1)
    neighbors[agents:] = agents  # a padding lane hears everybody, which never needs a search
    x = aligned_zeros(lanes)
    x[agents:] = 1e15 * np.arange(1, lanes - agents + 1)
    y = aligned_zeros(lanes)
    y[:] = x
    sensor_radius = aligned_zeros(lanes)
    fleet = np.zeros(lanes, np.int64)
    fleet[:agents] = np.repeat(np.arange(len(counts)), counts)
    alive = aligned_zeros(lanes)
    alive[:agents] = 1.0
    return Swarm(
        x=x,
        y=y,
        vx=aligned_zeros(lanes),
        vy=aligned_zeros(lanes),
        command_x=aligned_zeros(lanes),
        command_y=aligned_zeros(lanes),
        on_target=np.zeros(lanes, np.bool_),
        engaged=np.zeros(lanes, np.bool_),
        alive=alive,
        max_speed=np.ones(lanes),
        sensor_radius=sensor_radius,
        horizon=sensor_radius,
        glimpse=np.zeros(lanes),
        detection=np.ones(lanes),
        false_alarm=np.zeros(lanes),
        position_error=np.zeros(lanes),
        position_memory=np.zeros(lanes),
        capacity=np.full(lanes, np.inf),
        hotel=np.zeros(lanes),
        drag=np.zeros(lanes),
        curve=np.zeros((len(counts), 2, points)),
        max_acceleration=np.full(lanes, np.inf),
        max_turn_rate=np.full(lanes, np.inf),
        joins=np.zeros(lanes, np.int64),
        leaves=np.full(lanes, NEVER),
        neighbors=neighbors,
        contact=np.zeros(lanes),
        drift_x=np.zeros(lanes),
        drift_y=np.zeros(lanes),
        aground=np.zeros(lanes, np.bool_),
        fix_x=x if exact else x.copy(),
        fix_y=y if exact else y.copy(),
        error_x=np.zeros(lanes),
        error_y=np.zeros(lanes),
        spent=np.zeros(lanes),
        order=np.zeros(lanes, np.int64),
        home_x=np.zeros(lanes),
        home_y=np.zeros(lanes),
        share_end=np.zeros(lanes),
        station_x=np.zeros(lanes),
        station_y=np.zeros(lanes),
        leeway=np.zeros((lanes, 4)),
        fleet=fleet,
        fleet_end=np.cumsum(counts),
        memory=np.zeros((lanes, width(fields))),
        told=np.zeros((lanes, width(told))),
    )
