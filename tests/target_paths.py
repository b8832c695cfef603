"""Where a target goes, with buoys that stay."""

import numpy as np

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation

FAR = [(-9.0, -9.0), (9.0, 9.0)]


def path_of(target, steps=2000, start=None, heading=None, buoys=FAR, seed=1, **changes):
    """Place of a target at the start of each step, complex (K,), and whether it is there (K,).

    start, heading : where it is at first and where it heads to, instead of what chance says
    """
    still = {"strategy.social": 0.0, "strategy.repulsion_step": 0.0, "area.agent_margin": 0.0, "network.neighbors": 1}
    chosen = {"fleets": fleets((len(buoys), 1.0)), "targets": [{"radius": 1.0, **target}], "seed": seed, "steps": steps}
    simulation = Simulation(scenario("oceans2020", {**still, **chosen, **changes}))
    with simulation.edit() as now:
        now.swarm.x[: len(buoys)], now.swarm.y[: len(buoys)] = np.transpose(buoys)
        if start is not None:
            now.targets["x"][0], now.targets["y"][0] = start
        if heading is not None:
            now.targets["heading_x"][0], now.targets["heading_y"][0] = np.cos(heading), np.sin(heading)
    frames = simulation.advance(steps, every=1)
    return frames.target_x[:, 0] + 1j * frames.target_y[:, 0], frames.target_present[:, 0]


def turns(path):
    """Angle from each step to the next [rad]."""
    steps = np.diff(path)
    return np.angle(steps[1:] * steps[:-1].conj())


def folded(free, half):
    """A coordinate that is free to go anywhere, folded into [-half, half] as mirrors at the ends would."""
    way = (free + half) % (4 * half)
    return np.minimum(way, 4 * half - way) - half
