"""A fleet beside the simulator."""

import numpy as np

from shoal.run.simulation import Simulation


def differences(record):
    """Of a fleet's record, the arrays of frames and the sums that the simulator has otherwise in the same scenario."""
    scenario = record.scenario
    simulation = Simulation(scenario)
    wanted = simulation.advance(scenario.steps, every=1).arrays()
    found = record.trajectories[0].arrays()
    assert list(found) == list(wanted)
    sums = zip(simulation.tally._fields, record.tallies[0], simulation.tally, strict=True)
    return [name for name in wanted if not np.array_equal(found[name], wanted[name])] + [
        name for name, one, other in sums if not np.array_equal(one, other, equal_nan=True)
    ]
