"""Records made by hand, for what shows them on the Earth: no engine runs."""

import numpy as np

from scenarios import scenario
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.run.facts import facts_of

ORIGIN = (-1.3, 50.8)  # (lon, lat) [deg], in the Solent
START = "2015-11-16T06:00:00Z"
UNIX = 1_447_653_600  # the same [s]
AGENTS = 5  # two fast, three slow


def made_record(
    steps=range(0, 30, 10), *, names=("fast", "slow"), counts=(2, 3), reach=500.0, origin=ORIGIN, changes=None
):
    """Agents and a target that wander within `reach` [m] in steps of 0.1 s, at speeds made up."""
    chance, steps = np.random.default_rng(1), np.array(list(steps))
    fleets = [
        {"name": f"make {f}", "count": count, "max_speed": 2.6 - f} for f, count in enumerate(counts)
    ]  # a scenario takes no names of all kinds, a record does
    table = {"fleets": fleets, "network.neighbors": 2, **(changes or {})}
    if origin:
        table["area.origin"] = list(origin)
    chosen = scenario(changes=table)
    agents, frames = sum(counts), steps.size
    begin = chance.uniform(-reach, reach, (2, 1, agents + 1))
    x, y = begin + np.cumsum(chance.uniform(-2.0, 2.0, (2, frames, agents + 1)), axis=1)
    vx, vy = chance.uniform(-2.0, 2.0, (2, frames, agents))
    no, yes = np.zeros((frames, agents), np.bool_), np.ones((frames, agents), np.bool_)
    trajectory = Trajectory(
        step=steps,
        x=x[:, :-1],
        y=y[:, :-1],
        vx=vx,
        vy=vy,
        command_x=vx,
        command_y=vy,
        on_target=no.copy(),
        engaged=no,
        alive=yes,
        neighbors=np.full((frames, agents), 2),
        links=np.zeros((frames, agents, 0), np.uint8),
        target_x=x[:, -1:],
        target_y=y[:, -1:],
        target_present=np.ones((frames, 1), np.bool_),
        memory={},
    )
    facts = facts_of(chosen)._replace(fleets=tuple(names))
    return Record(chosen, facts, None, (), {}, {0: trajectory})
