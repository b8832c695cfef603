"""The stage: everything that a run works on but the strategy's parameters and memories, in one NamedTuple."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats, Swarm, aligned_zeros
from shoal.metrics.tally import Tally
from shoal.world.arena import World
from shoal.world.neighbors import Links, new_links
from shoal.world.radio import Radio
from shoal.world.targets import Tracks


class Scratch(NamedTuple):
    """Working arrays; nothing in them outlives a step but the guess in links.reach.

    leader : (B,) index of whom each of the B agents that decide together follows; sums : (S, B) of their influences
    """

    links: Links
    leader: npt.NDArray[np.int64]
    sums: Floats
    a: Floats
    b: Floats
    c: Floats


class Frames(NamedTuple):
    """Room for K frames of a trajectory, each the state at the start of a step. N agents, T targets, M memory fields.

    step : (K,); x, y, vx, vy, on_target, alive : (K, N); memory : (K, N, M)
    target_x, target_y, target_present : (K, T)
    """

    step: npt.NDArray[np.int64]
    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    on_target: npt.NDArray[np.bool_]
    alive: npt.NDArray[np.bool_]
    memory: Floats
    target_x: Floats
    target_y: Floats
    target_present: npt.NDArray[np.bool_]


WORLD, SWARM, RADIO, TARGETS, TRACKS, TALLY, SCRATCH, FRAMES = range(8)  # the fields of a stage, for kernels


class Stage(NamedTuple):
    """World, agents, radio, targets, sums, working arrays and frames of one run."""

    world: World
    swarm: Swarm
    radio: Radio
    targets: npt.NDArray[Any]
    tracks: Tracks
    tally: Tally
    scratch: Scratch
    frames: Frames


def new_scratch(world: World, lanes: int, sums: int = 2, ranked: bool = False) -> Scratch:
    """Return scratch for blocks of agents that decide together: all of them, or one in the sequential order.

    sums : how many the strategy has; ranked : whether it asks for the ranks of neighbors
    """
    width = 1 if world.sequential else lanes
    return Scratch(
        links=new_links(world.agents, width, ranked),
        leader=np.zeros(width, np.int64),
        sums=aligned_zeros(sums * width).reshape((sums, width)),
        a=aligned_zeros(lanes),
        b=aligned_zeros(lanes),
        c=aligned_zeros(lanes),
    )
