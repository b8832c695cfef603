"""What tests of runs on a card do in a process of its own, where numba simulates one: python -m cards TASK.

A simulated card is chosen by the environment, before numba is imported. Kernels are plain Python there, or compiled
for the processor (memory).
"""

import json
import sys

import numpy as np

from shoal.compiler.known import column, place_of, read
from shoal.core.agents import Memories
from shoal.engine.stage import SWARM, WORLD, model_stage
from shoal.run.simulate import simulate
from shoal.run.simulation import Simulation
from shoal.run.state import arrays_of
from shoal.scenario.load import load

SMALL = {"agents": 7, "fast": 3, "neighbors": 3, "fleets.BoB-1.sensor_radius": 4.0, "steps": 8}


def strategies(names):
    """Which of these strategies end with other numbers on the card."""
    return {name: differing({"strategy": name}) for name in names}


def cases(changes):
    """The same of changes to the paper's scenario."""
    return [differing(each) for each in changes]


def differing(changes):
    """Names of arrays that two runs on the card do not end with as on the processor."""
    from shoal.run.on_card import run_on_card

    scenario = load("oceans2020", **{**SMALL, **changes})
    there = [Simulation(scenario)]
    run_on_card(there)
    wrong = set()
    for run, simulation in enumerate(there):
        here = Simulation(scenario, run)
        here.advance(scenario.steps)
        assert here.tally.engaged.sum() > 0, "nobody ever leads"
        cut = {"swarm": np.s_[: scenario.agents], "air": np.s_[:, : scenario.agents]}
        other = dict(arrays_of(simulation.moment))
        for name, array in arrays_of(here.moment):
            where = cut.get(name.split(".")[0], ...)
            if not np.array_equal(array[where], other[name][where], equal_nan=True):
                wrong.add(name)
    return sorted(wrong)


def records():
    """What a record and a sweep of the card say, and of the processor."""
    import shoal

    found = []
    for device in ("cpu", "cuda"):
        record = simulate("oceans2020", runs=2, every=5, device=device, **SMALL)
        frames = record.trajectories[1]
        rows = shoal.sweep("oceans2020", {"neighbors": [2, 4]}, runs=2, device=device, **SMALL).rows
        found.append(
            {
                "device": record.provenance.get("device"),
                "x": frames.x.tolist(),
                "links": frames.links.tolist(),
                "tallies": [[array.tolist() for array in tally] for tally in record.tallies],
                "rows": [{k: repr(v) for k, v in row.items()} for row in rows],
            }
        )
    return found


def many():
    """What `records` finds where a run on the processor goes by lists of neighbors."""
    from shoal.run import build

    build.FEWEST_LISTED = 2
    SMALL.update(agents=12, fast=5)
    simulation = Simulation(load("oceans2020", **SMALL))
    return simulation.world.listed, *records()


def memory():
    """What compiled code reads and writes in an arena, of three groups, if it is said that all of them are coastal."""
    import numba

    from shoal.compiler.packed import reader
    from shoal.engine.gpu.arena import Arena
    from shoal.strategies import CATALOGUE

    params = CATALOGUE["knn-pso"].params()
    fields = np.dtype([("a", float)])
    groups = []
    for number in range(3):
        stage = model_stage()
        stage.swarm.x[:] = number + np.arange(stage.swarm.x.size)
        stage = stage._replace(world=stage.world._replace(time_step=0.5 * number, coastal=number == 1))
        stage.swarm.memory[:] = 100 + number
        seen = (stage.swarm.memory, stage.swarm.told, stage.radio.told)
        memories = Memories(*(array.view(fields).reshape(array.shape[:-1]) for array in seen))
        groups.append((stage, memories, params._replace(delta=0.25 * number)))
    arena = Arena(groups)
    at_memories, at_params, place = reader(groups[0][1]), reader(groups[0][2]), place_of(((WORLD, "coastal", True),))

    @numba.njit
    def look(stage, memories, params):
        swarm, world = read(place(stage), SWARM), read(place(stage), WORLD)
        swarm.vx[0] = 2.0 * column(swarm.fix_x)[1, 0]  # where fix_x is x itself
        at_memories(memories).memory[0].a += 1.0
        return world.time_step, world.coastal, at_params(params).delta

    seen = [[float(each) for each in look(*addresses)] for addresses in arena.addresses]
    arena.fetch()
    return {"read": seen, "written": [[float(g[0].swarm.vx[0]), float(g[0].swarm.memory[0, 0])] for g in groups]}


if __name__ == "__main__":
    task, *arguments = sys.argv[1:]
    sys.stdout.write(json.dumps(globals()[task](*map(json.loads, arguments))) + "\n")
