"""A glance at a running simulation: its frame of now and what this step will measure, without going on."""

import numpy as np

from shoal.metrics.tally import Tally
from shoal.record.trajectory import Trajectory
from shoal.run.simulation import Simulation


def glance(simulation: Simulation) -> tuple[Trajectory, Tally]:
    """Return the frame of the step that comes (K = 1), and the tally of that step alone.

    The engine makes the step and everything is put back: what a watcher sees is the engine's own, and a watched run is
    the same as an unwatched one, bit for bit.
    """
    state = simulation.state()
    before = {name: part.copy() for name, part in state.items() if name not in ("number", "identity")}
    number = simulation.number
    try:
        frame = simulation.advance(1, every=1)
        assert frame is not None
        done = Tally._make(
            np.array(after - before[f"tally.{name}"]) for name, after in simulation.tally._asdict().items()
        )
    finally:
        simulation.number = number
        for name, part in before.items():
            state[name][...] = part
    return frame, done
