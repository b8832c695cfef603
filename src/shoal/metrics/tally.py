"""What the engine adds up while it runs, and nothing more: sums per batch of steps, so memory is constant."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats
from shoal.metrics.coverage import CELLS

BINS = 11  # of the heading-bearing histogram
LENGTHS = 32  # bins of the lengths of losses
WINDOWS = 50  # of the timeline, per batch

NONE_SEEN = 1e300  # [m^2] what the smallest square of a distance begins at: finite, so that tallies can be subtracted


class Tally(NamedTuple):
    """Sums over the steps of each batch b (B batches of consecutive steps, for batch means).

    F fleets, N agents, T targets; a column per metric file.

    batch_steps, steps, present, on_target, engaged : (B,) steps planned; done; with a target there; with an agent
        on it; agents on target
    fluctuation : (B, F) [m/s] sum over steps and agents of |v_i - mean v|
    histogram : (B, F, 11) agents per bin of phi over steps with a target there
    stationary : (B, F) agents slower than a tenth of their top speed, over the same steps
    agent_steps : (B, F) sum over steps of the agents alive
    target_steps, watched : (B, T) steps at which each target is there; and somebody watches it
    undetected, losses, ended, ended_steps : (B, T) steps before the first detection; losses begun, ended, their steps
    loss_lengths : (B, 32) ended losses by length, see contacts.py
    timeline_present, timeline_on_target : (B, 50) steps with a target there, and watched, in windows of a batch
    heard : (B,) reports received
    graphs, components, clustering : (B,) looks at the graph, and sums over them
    windows, covered, sweeps, swept : (B,) coverage windows ended and begun, and sums over them, see coverage.py
    distance [m], cubes [m^3/s^2] : (B, N), see effort.py
    closest : (1,) [m^2] the least square of a distance between two agents, no sum, see closest.py
    seen : (1, cells) the state of the coverage grid, no sum
    """

    batch_steps: Floats
    steps: Floats
    present: Floats
    on_target: Floats
    engaged: Floats
    fluctuation: Floats
    histogram: npt.NDArray[np.int64]
    stationary: npt.NDArray[np.int64]
    agent_steps: Floats
    target_steps: Floats
    watched: Floats
    undetected: Floats
    losses: Floats
    ended: Floats
    ended_steps: Floats
    loss_lengths: Floats
    timeline_present: Floats
    timeline_on_target: Floats
    heard: Floats
    graphs: Floats
    components: Floats
    clustering: Floats
    windows: Floats
    covered: Floats
    sweeps: Floats
    swept: Floats
    distance: Floats
    cubes: Floats
    closest: Floats
    seen: npt.NDArray[np.int64]


def batch_of(tally: Tally, batch: int) -> Tally:
    """The sums of one batch, as a tally of its own (B = 1)."""
    return Tally._make(part[batch : batch + 1] for part in tally)


def new_tally(steps: int, batches: int, fleets: int, agents: int, targets: int) -> Tally:
    """Return an empty tally of a run of so many steps."""
    edges = -(-np.arange(batches + 1) * steps // batches)  # step s belongs to batch s * batches // steps
    return Tally(
        batch_steps=np.diff(edges).astype(float),
        fluctuation=np.zeros((batches, fleets)),
        histogram=np.zeros((batches, fleets, BINS), np.int64),
        stationary=np.zeros((batches, fleets), np.int64),
        agent_steps=np.zeros((batches, fleets)),
        **{name: np.zeros((batches, targets)) for name in _PER_TARGET},
        loss_lengths=np.zeros((batches, LENGTHS)),
        timeline_present=np.zeros((batches, WINDOWS)),
        timeline_on_target=np.zeros((batches, WINDOWS)),
        distance=np.zeros((batches, agents)),
        cubes=np.zeros((batches, agents)),
        closest=np.full(1, NONE_SEEN),
        seen=np.zeros((1, CELLS * CELLS), np.int64),
        **{name: np.zeros(batches) for name in _PLAIN},
    )


_PER_TARGET = ("target_steps", "watched", "undetected", "losses", "ended", "ended_steps")
_PLAIN = (
    "steps", "present", "on_target", "engaged", "heard", "graphs", "components", "clustering",
    "windows", "covered", "sweeps", "swept",
)  # fmt: skip
