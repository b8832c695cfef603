"""Steps of many swarms in one compiled call, for whoever decides outside: memories are written, views are read.

An environment cuts time between hearing and deciding. A call finishes the step that a swarm is in (agents decide, by
what was written into their memories; all move) and begins the next one (what is sensed and heard), which is what agents
can know when they decide again. So a step does nothing twice, and has the bits that step.py gives it.
"""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import entry_kernel, kernel, overload
from shoal.compiler.lanes import WIDTH, either, everywhere, put, take
from shoal.compiler.placed import borrow, part
from shoal.core.agents import Floats
from shoal.core.draws import split
from shoal.engine.arrivals import arriving, choose, sum_up
from shoal.engine.observation import observe
from shoal.engine.stage import NATURE, PHASES, RADIO, RUN, SCRATCH, SWARM, TALLY, TARGETS, WORLD
from shoal.engine.step import Now, Parts, decide, listening, run, tell

NOT_ASKED = -1
REST, STEP, LOOK = 0, 1, 2  # what a swarm does in a call: nothing; a step; it only begins the step it is at, from reset

REWARDS = ("time_on_target", "targets_observed", "engaged", "energy")


class Asked(NamedTuple):
    """What E swarms of N agents are to do.

    doing : (E,) REST, STEP or LOOK; number : (E,) the step that each is in, which is counted on
    actions : (E, N, A) from low to high, (A,), which others are cut to; what they mean is middle + half x action,
        (N, A), and goes into the columns (A,) of the agents' memory
    """

    doing: npt.NDArray[np.int64]
    number: npt.NDArray[np.int64]
    actions: Floats
    low: Floats
    high: Floats
    middle: Floats
    half: Floats
    columns: npt.NDArray[np.int64]


class Earned(NamedTuple):
    """Where the rewards of E swarms are written.

    rewards : (E, N), the sum of terms, (E, N, R) in the order of REWARDS, each times its weight, (R,)
    team : (E,) the mean reward of the agents that are there
    """

    team: Floats

    rewards: Floats
    terms: Floats
    weights: Floats


@entry_kernel
def step_swarms(stages, memories, params, asked, seen, earned):
    """Let every swarm do what it is asked for; returns 1 + the first whose numbers are not finite, 0: none.

    If actions are not finite, nothing is done, and NOT_ASKED returned.

    stages : addresses of E stages, which the caller keeps in place
    memories : those of E swarms, with a leading axis; the stages' memories are views of the same numbers
    seen, earned : where it is written what agents know now, and their rewards
    """
    spoiled, orders, views, rewards = 0, borrow(asked), borrow(seen), borrow(earned)
    if not _is_asked(orders.actions.ravel()):
        return NOT_ASKED
    for e in range(asked.doing.size):
        doing = asked.doing[e]
        if doing == REST:
            continue
        stage = stages[e]
        parts = Parts(
            stage,
            part(stage, PHASES),
            part(stage, WORLD),
            part(stage, SWARM),
            part(stage, RADIO),
            part(stage, TARGETS),
            part(stage, SCRATCH),
        )
        if doing == STEP:
            _end_step(parts, e, of_swarm(memories, e), params, orders)
            asked.number[e] += 1
        number = asked.number[e]
        now = _moment(stage, number)
        run(parts.phases.sense, parts, now, 0)
        run(parts.phases.link, parts, now, 0)
        _settle(parts, now)
        arrived = arriving(of_swarm(memories, e), parts.radio, parts.swarm, number, parts.world.time_step)
        observe(parts, arrived, e, views)
        reward(parts.swarm, parts.targets, parts.world.agents, e, rewards)
        if spoiled == 0 and not _is_sound(parts.swarm, parts.targets, part(stage, NATURE).clock, parts.world.agents):
            spoiled = e + 1
    return spoiled


@kernel
def _is_asked(actions):
    """Whether all actions are finite."""
    total = 0.0
    for action in actions:
        total += 0.0 * action
    return total == 0.0


@kernel
def _moment(stage, number):
    """The step of a number."""
    which, batches = part(stage, RUN), part(stage, TALLY).steps.size
    batch = min(number * batches // which.steps, batches - 1)
    return Now(number, batch, split(split(split(which.seed, 0), which.run), number), -1)


@kernel
def _end_step(parts, e, memories, params, asked):
    """Do what is left of a step when everybody has heard: decide, move, measure; see step.py."""
    world, scratch = parts.world, parts.scratch
    now = _moment(parts.stage, asked.number[e])
    write_actions(parts.swarm, e, asked, world.agents)
    arrived = arriving(memories, parts.radio, parts.swarm, now.number, world.time_step)
    listeners = listening(parts, now, 0)
    sum_up(arrived, listeners, scratch.links, params, world.agents, scratch.sums)
    choose(arrived, listeners, scratch.links, params, world.agents, scratch.leader, scratch.a)
    decide(parts.swarm, parts, arrived, memories, params, now, 0)
    tell(parts.swarm, 0, world.agents)
    run(parts.phases.move, parts, now, 0)
    run(parts.phases.measure, parts, now, 0)
    run(parts.phases.move_targets, parts, now, 0)


@kernel
def write_actions(swarm, e, asked, agents):
    """Write what the actions of swarm e mean into its memory."""
    for i in range(agents):
        for a in range(asked.columns.size):
            action = min(max(asked.actions[e, i, a], asked.low[a]), asked.high[a])
            swarm.memory[i, asked.columns[a]] = asked.middle[i, a] + asked.half[i, a] * action


@kernel
def _settle(parts, now):
    """Settle ties and lose reports, before anything is summed."""
    links = parts.scratch.links
    if links.silent.size == 0:  # lists are settled
        _count_heard(links, parts.world.agents)
        run(parts.phases.settle_ties, parts, now, 0)


@kernel
def _count_heard(links, agents):
    """Set links.heard to how many each listener hears."""
    for i in range(0, links.reach.size, WIDTH):
        reach = take(links.reach, i, everywhere(0.0))
        heard = everywhere(0.0)
        for j in range(agents):
            heard = either(take(links.square, (j, i), reach) <= reach, heard + 1.0, heard)
        put(links.heard, i, heard)


@kernel
def reward(swarm, targets, agents, e, earned):
    """Write what each agent of swarm e earns at the state that it is in now."""
    engaged, present, watched, count, team = 0, 0, 0, 0, 0.0
    for i in range(agents):
        engaged += 1 if swarm.engaged[i] else 0
    for target in targets:
        present += 1 if target.present != 0 else 0
        watched += 1 if target.watchers > 0 else 0
    for i in range(agents):
        there = swarm.alive[i] > 0.0
        share = np.sqrt(swarm.vx[i] * swarm.vx[i] + swarm.vy[i] * swarm.vy[i]) / swarm.max_speed[i]
        earned.terms[e, i, 0] = 1.0 if there and engaged > 0 else 0.0
        earned.terms[e, i, 1] = watched / present if there and present > 0 else 0.0
        earned.terms[e, i, 2] = 1.0 if there and swarm.engaged[i] else 0.0
        earned.terms[e, i, 3] = -share * share * share if there else 0.0
        total = 0.0
        for term in range(earned.weights.size):
            total += earned.weights[term] * earned.terms[e, i, term]
        earned.rewards[e, i] = total
        team += total
        count += 1 if there else 0
    earned.team[e] = team / max(count, 1)


@kernel
def _is_sound(swarm, targets, clock, agents):
    """Whether all numbers of a state are finite."""
    sound = clock[1] == 0
    for i in range(agents):
        sound &= np.isfinite(swarm.x[i]) & np.isfinite(swarm.y[i])
        sound &= np.isfinite(swarm.vx[i]) & np.isfinite(swarm.vy[i])
    for target in targets:
        sound &= np.isfinite(target.x) & np.isfinite(target.y)
    return sound


def of_swarm(memories: Any, e: int) -> Any:
    """The memories of one of E swarms; their class says how agents listen, see arrivals.py."""
    return type(memories)(*(each[e] for each in memories))


@overload(of_swarm, inline="always")
def _of_swarm(memories, e):
    kind = memories.instance_class
    return lambda memories, e: kind(memories.memory[e], memories.told[e], memories.arrived[e])
