"""A swarm that nothing moves but its own inertia, in front of targets that stay: closed forms for the metrics."""

import numpy as np

from scenarios import fleets, scenario
from shoal.run.simulation import Simulation


def coasting(places, velocities, targets=((0.0, 0.0),), makes=None, radius=1.0, **changes):
    """Agents of 1 m/s that go on as they are; velocities [m/s]."""
    places, velocities = np.array(places, float), np.array(velocities, float)
    chosen = scenario(
        "oceans2020",
        {
            "fleets": fleets(*(makes or [(len(places), 1.0)])),
            "network.neighbors": 1,
            "steps": 20,
            "area.agent_margin": 0.0,
            "strategy.social": 0.0,
            "strategy.repulsion_step": 0.0,
            "targets": [{"kind": "still", "x": x, "y": y, "radius": radius} for x, y in targets],
            **changes,
        },
    )
    simulation, n = Simulation(chosen), len(places)
    with simulation.edit() as now:
        now.swarm.x[:n], now.swarm.y[:n] = places.T
        now.swarm.vx[:n], now.swarm.vy[:n] = velocities.T
    return simulation
