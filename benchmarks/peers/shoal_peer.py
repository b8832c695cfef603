"""The paper's step in Shoal: the preset, all its metrics counted."""

import numpy as np

import shoal
from paper import SEED, measure

if __name__ == "__main__":
    simulation = shoal.Simulation(shoal.load("oceans2020", steps=10**9, seed=SEED))

    def advance(steps: int) -> float:
        """Steps at which anybody was on target."""
        before = float(np.sum(simulation.tally.on_target))
        simulation.advance(steps)
        return float(np.sum(simulation.tally.on_target)) - before

    measure(advance, 5000, 1, "f64", shoal.__version__)
