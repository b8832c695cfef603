"""What an agent knows, what it says and what it heard.

All SI: positions [m] in the arena's frame (origin at its center), velocities [m/s]. Nothing here needs more than
Python: a small computer on a buoy imports it, too.
"""

from typing import Any, NamedTuple

from shoal.core.wire import pack, unpack


class Briefing(NamedTuple):
    """What an agent is told before it leaves, and nothing that it could only learn at sea.

    agents : N; half_x, half_y : agents may go to +- these [m]
    reach : how far its sensor sees the smallest target [m]
    share_begin, share_end : its part of the swarm's summed top speeds, in the order of ids, from 0 to 1
    charted : whether there is a coast; station_x, station_y : its place in an even cover of the water then [m]
    """

    agents: int
    half_x: float
    half_y: float
    reach: float
    share_begin: float
    share_end: float
    charted: bool = False
    station_x: float = 0.0
    station_y: float = 0.0


class Reading(NamedTuple):
    """What an agent's own instruments say: place [m], velocity [m/s], and whether its sensor has a target.

    drift_x, drift_y : what water and wind added in the last step [m/s]; aground : whether land stopped it then
    """

    x: float
    y: float
    vx: float
    vy: float
    on_target: bool
    drift_x: float = 0.0
    drift_y: float = 0.0
    aground: bool = False


class Truth(NamedTuple):
    """The nearest target as it is, for strategies declared `informed`; all others get zeros.

    present : whether there is any; x, y [m]; vx, vy [m/s]; goal_x, goal_y : where it is heading to [m]
    """

    present: bool
    x: float
    y: float
    vx: float
    vy: float
    goal_x: float
    goal_y: float


class Own(NamedTuple):
    """What an agent knows of itself. `time` [s] since the start of the run, `fleet`: index of its fleet.

    vx, vy : through the water [m/s]; drift_x, drift_y : what water and wind added in the last step [m/s]
    aground : whether land stopped it in the last step
    """

    id: int
    x: float
    y: float
    vx: float
    vy: float
    on_target: bool
    max_speed: float
    time_step: float
    time: float
    fleet: int
    briefing: Briefing
    truth: Truth
    drift_x: float = 0.0
    drift_y: float = 0.0
    aground: bool = False


class Report(NamedTuple):
    """What an agent tells its neighbors: the one message of the swarm.

    told : the memory fields that its strategy tells
    time : when it was said [s] since the start of the run
    rank : 0 for the nearest of those that the listener hears, 1 for the next ...; the listener's finding, never sent
    """

    id: int
    x: float
    y: float
    vx: float
    vy: float
    on_target: bool
    told: Any
    time: float = 0.0
    rank: Any = None

    def to_bytes(self) -> bytes:
        """The report as it goes over the air: 50 bytes, and 8 for each field told.

        Raises
        ------
        MessageError : a number is not finite, or the id is not one of 32 bits
        """
        return pack(self)

    @classmethod
    def from_bytes(cls, data: bytes, told: tuple[str, ...] = ()) -> "Report":
        """The report in bytes that came over the air.

        Parameters
        ----------
        data : what `to_bytes` made
        told : names of the fields that the swarm tells, in their order; Buoy.told

        Raises
        ------
        MessageError : too few or too many bytes, of another version, or damaged
        """
        read: Report = unpack(data, told, cls)
        return read


REPORT_BYTES = 4 + 4 * 8 + 1  # what it says: id, position and velocity, on target; each field of `told` adds 8
ENVELOPE_BYTES = 1 + 8 + 4  # what sending it takes besides: version, time, checksum


class Heard(NamedTuple):
    """What an agent made of its neighbors' reports: one leader, and sums over all of them.

    `found` is whether any neighbor may lead; x, y, vx, vy, on_target, told are the leader's (the agent's own if none).
    `sums` has what the strategy's influence adds up to over all neighbors, by the names that it declares; `sum_x`,
    `sum_y` are the first two of them. `neighbors` is how many were heard.
    """

    found: bool
    x: float
    y: float
    vx: float
    vy: float
    on_target: bool
    sum_x: float
    sum_y: float
    neighbors: int
    told: Any
    sums: Any = ()
