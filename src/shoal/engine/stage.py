"""The stage: everything that a run works on but the strategy's parameters and memories, in one NamedTuple."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.placed import all_like
from shoal.core.agents import Floats, Swarm, aligned_zeros, new_swarm
from shoal.core.links import link_bytes
from shoal.metrics.tally import Tally, new_tally
from shoal.world.arena import World
from shoal.world.disturbances.catalogue import DISTURBANCE_FIELDS, MEMORY
from shoal.world.disturbances.contract import EFFECTS, NOT_BEGUN, Nature
from shoal.world.neighbors import Links, new_links
from shoal.world.radio import Radio, new_radio
from shoal.world.reception import new_words
from shoal.world.sea.sea import Sea, calm_sea
from shoal.world.sea.sight import Sight, new_sight
from shoal.world.targets.catalogue import TARGET_FIELDS
from shoal.world.targets.contract import Tracks


class Scratch(NamedTuple):
    """Working arrays; nothing in them outlives a step but the guess in links.reach.

    leader : (B,) index of whom each of the B agents that decide together follows; sums : (S, B) of their influences
    hops : (N, L) over how many the report of each (row) reaches the others now, 0: not; no rows where nobody relays or
        keeps reports, see world/reception.py; words : (N + 3, W) sets of agents, for that
    """

    links: Links
    leader: npt.NDArray[np.int64]
    sums: Floats
    a: Floats
    b: Floats
    c: Floats
    d: Floats
    sight: Sight
    hops: npt.NDArray[np.int8]
    words: npt.NDArray[np.int64]


class Frames(NamedTuple):
    """Room for K frames of a trajectory, each the state at the start of a step. N agents, T targets, M memory fields.

    step : (K,); x, y, vx, vy, command_x, command_y, on_target, engaged, alive, neighbors : (K, N); memory : (K, N, M)
    links : (K, N, W) whom each agent hears in the step, W = link_bytes(N), see core/links.py
    target_x, target_y, target_present : (K, T)
    """

    step: npt.NDArray[np.int64]
    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    command_x: Floats
    command_y: Floats
    on_target: npt.NDArray[np.bool_]
    engaged: npt.NDArray[np.bool_]
    alive: npt.NDArray[np.bool_]
    neighbors: npt.NDArray[np.int64]
    links: npt.NDArray[np.uint8]
    memory: Floats
    target_x: Floats
    target_y: Floats
    target_present: npt.NDArray[np.bool_]


class Addresses(NamedTuple):
    """Where the machine code of each phase is, in the order of a step."""

    sense: Any
    disturb: Any
    record_frame: Any
    link: Any
    hide: Any
    receive: Any
    settle_ties: Any
    record_links: Any
    move: Any
    sail: Any
    measure: Any
    drift_targets: Any
    move_targets: Any
    stop_target: Any
    come_to_rest: Any
    look_at_links: Any
    launch: Any


class Run(NamedTuple):
    """Which run it is: what all its chance comes from, and how many steps it is planned to have, for its batches."""

    seed: np.uint64
    run: int
    steps: int


WORLD, SWARM, RADIO, TARGETS, TRACKS, NATURE, SEA, TALLY, SCRATCH, FRAMES, PHASES, RUN = range(
    12
)  # fields, for kernels


class Stage(NamedTuple):
    """World, agents, radio, targets, disturbances, sea, sums, working arrays, frames, phases and chance of one run."""

    world: World
    swarm: Swarm
    radio: Radio
    targets: npt.NDArray[Any]
    tracks: Tracks
    nature: Nature
    sea: Sea
    tally: Tally
    scratch: Scratch
    frames: Frames
    phases: Addresses
    run: Run


def new_scratch(world: World, lanes: int, sums: int = 2, ranked: bool = False, collecting: bool = False) -> Scratch:
    """Return scratch for blocks of agents that decide together: all of them, or one in the sequential order.

    sums : how many the strategy has; ranked : whether it asks for the ranks of neighbors; collecting : whether radios
    relay or keep reports
    """
    width = 1 if world.sequential else lanes
    return Scratch(
        links=new_links(world.agents, width, ranked, world.listed, world.single),
        leader=np.zeros(width, np.int64),
        sums=aligned_zeros(sums * width).reshape((sums, width)),
        a=aligned_zeros(lanes),
        b=aligned_zeros(lanes),
        c=aligned_zeros(lanes),
        d=aligned_zeros(lanes),
        sight=new_sight(world.agents if world.coastal else 0, lanes),
        hops=np.zeros((world.agents if collecting else 0, lanes), np.int8),
        words=new_words(world.agents if collecting else 0),
    )


def new_nature(disturbances: int, lanes: int) -> Nature:
    """Return so many disturbances, which have not acted yet on so many lanes of agents."""
    effects = np.zeros(lanes, EFFECTS).view(np.recarray)
    for name in ("senses", "hears", "speed"):
        effects[name] = 1.0
    return Nature(
        disturbances=np.zeros(disturbances, DISTURBANCE_FIELDS).view(np.recarray),
        effects=effects,
        memory=np.zeros((disturbances, lanes), MEMORY).view(np.recarray),
        clock=np.array([NOT_BEGUN, 0]),
    )


def new_frames(count: int, agents: int, targets: int, fields: int) -> Frames:
    """Return room for `count` frames."""
    return Frames(
        step=np.empty(count, np.int64),
        x=np.empty((count, agents)),
        y=np.empty((count, agents)),
        vx=np.empty((count, agents)),
        vy=np.empty((count, agents)),
        command_x=np.empty((count, agents)),
        command_y=np.empty((count, agents)),
        on_target=np.empty((count, agents), np.bool_),
        engaged=np.empty((count, agents), np.bool_),
        alive=np.empty((count, agents), np.bool_),
        neighbors=np.empty((count, agents), np.int64),
        links=np.empty((count, agents, link_bytes(agents)), np.uint8),
        memory=np.empty((count, agents, fields)),
        target_x=np.empty((count, targets)),
        target_y=np.empty((count, targets)),
        target_present=np.empty((count, targets), np.bool_),
    )


@all_like
def model_stage() -> Stage:
    """The smallest stage there is, of the type that all stages have."""
    world = World(*(kind() for kind in World.__annotations__.values()))._replace(agents=2)
    return Stage(
        world,
        new_swarm([2], ()),
        new_radio(1, (), limited=False, reach=1.0, delay=0, loss=0.0, degree=None),
        np.zeros(1, TARGET_FIELDS).view(np.recarray),
        Tracks(np.zeros(1), np.zeros(1), np.zeros(1)),
        new_nature(1, 1),
        calm_sea(),
        new_tally(1, 1, 1, 2, 1),
        new_scratch(world, 2),
        new_frames(0, 2, 1, 1),
        Addresses(*(0 for _ in Addresses._fields)),
        Run(np.uint64(0), 0, 1),
    )
