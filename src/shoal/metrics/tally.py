"""What the engine adds up while it runs, and nothing more: sums per batch of steps, so memory is constant."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Floats

BINS = 11  # of the heading-bearing histogram


class Tally(NamedTuple):
    """Sums over the steps of each batch b (B batches of consecutive steps, for batch means) and fleet f.

    steps, present, on_target, engaged : (B,) steps done; with a target there; with an agent on it; agents on target
    fluctuation : (B, F) [m/s] sum over steps and agents of |v_i - mean v|
    histogram : (B, F, 11) agents per bin of phi over steps with a target there
    stationary : (B, F) agents slower than a tenth of their top speed, over the same steps
    """

    steps: Floats
    present: Floats
    on_target: Floats
    engaged: Floats
    fluctuation: Floats
    histogram: npt.NDArray[np.int64]
    stationary: npt.NDArray[np.int64]


def batch_of(tally: Tally, batch: int) -> Tally:
    """The sums of one batch, as a tally of its own (B = 1)."""
    return Tally._make(part[batch : batch + 1] for part in tally)


def new_tally(batches: int, fleets: int) -> Tally:
    """Return an empty tally."""
    return Tally(
        steps=np.zeros(batches),
        present=np.zeros(batches),
        on_target=np.zeros(batches),
        engaged=np.zeros(batches),
        fluctuation=np.zeros((batches, fleets)),
        histogram=np.zeros((batches, fleets, BINS), np.int64),
        stationary=np.zeros((batches, fleets), np.int64),
    )
