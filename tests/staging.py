"""One decision seen from outside: agents are put where a test wants them, and the velocity they then want is read."""

import numpy as np

import replay
from scenarios import fleets, scenario
from shoal.core.agents import as_records
from shoal.run.simulation import Simulation
from shoal.scenario.strategy_choice import following
from shoal.strategies import CATALOGUE

ENDLESS = 1e9  # a top speed that limits nobody [m/s]
NOWHERE = (1e6, 1e6)  # a target that nobody finds
DT = 0.1  # [s]


def staged(strategy, places, targets=(NOWHERE,), top=ENDLESS, changes=None):
    """Agents at rest at these places [m] in an area of 20 m x 20 m, still targets of 1 m; everybody hears all.

    strategy : its name and parameters, those that are not said as declared; top : their top speed [m/s], or one each
    """
    tops = np.broadcast_to(top, len(places))
    name, params = strategy if isinstance(strategy, tuple) else (strategy, {})
    chosen = scenario(
        "oceans2020",
        {
            "strategy": {"name": name, **declared(name), **params},
            "fleets": fleets(*((1, float(speed)) for speed in tops)),
            "network.neighbors": "all",
            "area.agent_margin": 0.0,
            "targets": [{"kind": "still", "x": x, "y": y, "radius": 1.0} for x, y in targets],
            **(changes or {}),
        },
    )
    simulation = Simulation(chosen)
    put(simulation, places)
    return simulation


def declared(name):
    """The parameters that would follow the scenario, as they are said for the paper's."""
    known = CATALOGUE[name]
    return {each: known.params._field_defaults[each] for each in following(known)}


def put(simulation, places):
    """Move the agents to these places, at rest."""
    n = simulation.scenario.agents
    with simulation.edit() as now:
        now.swarm.x[:n], now.swarm.y[:n] = np.array(places, float).T
        now.swarm.vx[:n] = now.swarm.vy[:n] = 0.0


def memory_of(simulation):
    """What agents remember, as records that a test may write to."""
    return as_records(simulation._swarm.memory, simulation.memory_fields)


def places(simulation):
    """(N, 2) [m]"""
    n = simulation.scenario.agents
    return np.stack([simulation.swarm.x[:n], simulation.swarm.y[:n]], axis=1)


def wanted(simulation):
    """(N, 2): the velocities that the agents want in the next step, as far as their top speeds allow [m/s]."""
    n = simulation.scenario.agents
    simulation.advance(1)
    return np.stack([simulation.swarm.command_x[:n], simulation.swarm.command_y[:n]], axis=1)


def chance(simulation, agent, purpose):
    """What `uniform(draw, purpose)` gives this agent in the next step."""
    key = replay.step_key(simulation.scenario, simulation.run, simulation.number)
    return replay.uniform(replay.split(key, agent), purpose)


def plain(kernel):
    """The Python function inside a kernel."""
    return getattr(kernel, "py_func", kernel)
