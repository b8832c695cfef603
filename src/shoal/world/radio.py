"""What the radio does to messages: range, loss, delay, and how many neighbors an agent listens to."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats, both, width
from shoal.core.draws import split, uniform
from shoal.world.lists import note_contact
from shoal.world.neighbors import linked

_LOSS = 1 << 33  # a stream of keys that neither agents nor targets draw from


class Network(NamedTuple):
    """What is chosen of the radio.

    limited : whether any pair may be out of touch, whatever land hides; range_square [m^2]
    delay : steps that a report takes; interval : steps from one report of an agent to its next
    loss : chance that a linked pair misses a report
    max_age : steps that a report may be older than the newest that can have arrived; hops : over how many it may come
    adaptive : k follows the contact, from fewest to most of each agent (L,), with memory `patience` [s]
    """

    limited: bool
    range_square: float
    delay: int
    interval: int
    loss: float
    adaptive: bool
    fewest: npt.NDArray[np.int64]
    most: npt.NDArray[np.int64]
    patience: float
    max_age: int
    hops: int


class Air(NamedTuple):
    """What is on the air: the last D times that all spoke, rows of L lanes, the n-th time in row n % D.

    heard : (N, L) the step at which was said the newest report that each listener (lane) has of each speaker, -1: none;
        no rows where no reports are kept
    """

    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    on_target: npt.NDArray[np.bool_]
    told: Floats
    heard: npt.NDArray[np.int64]


Radio = both("Radio", Air, Network, __name__)


class Said(NamedTuple):
    """The reports that arrive in a step, (L,), except what is told of memories."""

    x: Floats
    y: Floats
    vx: Floats
    vy: Floats
    on_target: npt.NDArray[np.bool_]


def new_radio(
    lanes: int,
    told: tuple[str, ...],
    *,
    limited: bool,
    reach: float,
    delay: int,
    loss: float,
    degree: tuple[int, int, float] | None,
    interval: int = 1,
) -> Any:
    """Return a radio that has heard nothing yet; `degree` is fewest, most and patience of an adaptive one.

    It neither relays nor keeps reports, see world/reception.py.
    """
    rows = -(-delay // interval) + 1
    fewest, most, patience = degree or (0, 0, 0.0)
    return Radio(
        limited=limited,
        range_square=reach * reach,
        delay=delay,
        interval=interval,
        loss=loss,
        adaptive=degree is not None,
        fewest=np.full(lanes, fewest),
        most=np.full(lanes, most),
        patience=patience,
        max_age=0,
        hops=1,
        x=np.zeros((rows, lanes)),
        y=np.zeros((rows, lanes)),
        vx=np.zeros((rows, lanes)),
        vy=np.zeros((rows, lanes)),
        on_target=np.zeros((rows, lanes), np.bool_),
        told=np.zeros((rows, lanes, width(told))),
        heard=np.zeros((0, lanes), np.int64),
    )


@kernel
def speaks(radio, number):
    """Whether agents speak at a step, and what they say must be kept: all do at once, every `interval` steps."""
    return (radio.delay > 0 or radio.interval > 1 or radio.max_age > 0) and number % radio.interval == 0


@kernel
def spoken(radio, number):
    """The step at which was said what is heard at a step: the last one whose reports have arrived by then."""
    arrived = number - radio.delay
    return arrived - arrived % radio.interval


@kernel
def row(radio, number):
    """The row of the air that holds what was said at a step."""
    return (number // radio.interval) % radio.x.shape[0]


@kernel
def send(radio, swarm, number):
    """Keep what is said at a step until it arrives, and until more is said."""
    now = row(radio, number)
    for i in range(swarm.x.size):
        radio.x[now, i] = swarm.fix_x[i]
        radio.y[now, i] = swarm.fix_y[i]
        radio.vx[now, i] = swarm.vx[i]
        radio.vy[now, i] = swarm.vy[i]
        radio.on_target[now, i] = swarm.on_target[i]
        for field in range(swarm.told.shape[1]):
            radio.told[now, i, field] = swarm.told[i, field]


@kernel
def said(radio, swarm, number):
    """What is heard at a step.

    Where it is said in the same step that is the swarm itself: in the sequential order, later agents hear what earlier
    ones just did.
    """
    then = spoken(radio, number)
    if then == number:
        return Said(swarm.fix_x, swarm.fix_y, swarm.vx, swarm.vy, swarm.on_target)
    old = row(radio, then)
    return Said(radio.x[old], radio.y[old], radio.vx[old], radio.vy[old], radio.on_target[old])


@kernel
def adapted(contact, on_contact, weight):
    """The share of recent steps in contact, one step later; a step weighs `weight`."""
    return contact + weight * (on_contact - contact)


@kernel
def hide_far_away(links, swarm, range_square, first, agents):
    """Unlink speakers out of range where reports do not say quite where they are: the waves go by where all are."""
    square = links.square
    for lane in range(min(links.reach.size, agents - first)):
        x, y = swarm.x[first + lane], swarm.y[first + lane]
        for j in range(agents):
            dx, dy = swarm.x[j] - x, swarm.y[j] - y
            square[j, lane] = square[j, lane] if dx * dx + dy * dy <= range_square else np.inf


@kernel
def limit_links(links, swarm, radio, first, agents, number, range_square):
    """Unlink speakers out of range, absent, or yet unheard; links.wanted becomes k, or all that are left.

    The range is to the place that a report says: where the speaker was when it spoke. Absent agents hear no one.

    range_square : infinite where the range was judged already
    """
    then = spoken(radio, number)
    square, wanted = links.square, links.wanted
    lanes = wanted.size
    for i in range(lanes):
        wanted[i] = 0
    for j in range(agents):
        silent = then < swarm.joins[j] or then >= swarm.leaves[j]
        limit = -1.0 if silent else range_square
        for i in range(lanes):
            linked = square[j, i] <= limit and square[j, i] < np.inf and swarm.alive[first + i] > 0.0
            square[j, i] = square[j, i] if linked else np.inf
            wanted[i] += 1 if linked else 0
    for i in range(lanes):
        wanted[i] = min(wanted[i], swarm.neighbors[first + i])


@kernel
def deafen(links, effects, first, agents):
    """Unlink whoever hears nothing from all, before the nearest are sought."""
    square = links.square
    for i in range(min(square.shape[1], agents - first)):
        if effects[first + i].hears <= 0.0:
            for j in range(agents):
                square[j, i] = np.inf


@kernel
def arrival_key(radio, run, number):
    """The key of the step at which arrived what is heard at a step."""
    return split(split(split(run.seed, 0), run.run), spoken(radio, number) + radio.delay)


@kernel
def lose_reports(links, radio, step_key, first, agents):
    """Unlink every pair whose report is lost; `step_key` is that of the step at which it arrives."""
    square = links.square
    for j in range(agents):
        key = split(step_key, _LOSS + j)
        for i in range(square.shape[1]):
            square[j, i] = np.inf if uniform(key, first + i) < radio.loss else square[j, i]


@kernel
def begin_degree(swarm, radio, agents):
    """Let k start between fewest and most, with the contact that belongs to it."""
    for i in range(agents):
        swarm.neighbors[i], swarm.contact[i] = first_degree(swarm.neighbors[i], radio.fewest[i], radio.most[i])


@kernel
def first_degree(k, fewest, most):
    """k to start with, between two bounds, and the contact that belongs to it."""
    above = min(max(k - fewest, 0), most - fewest)
    return fewest + above, above / (most - fewest) if most > fewest else 0.0


@kernel
def degree_of(contact, fewest, most):
    """k that belongs to a contact from 0 to 1."""
    return int(fewest + (most - fewest) * contact + 0.5)


@kernel
def adapt_degree(swarm, radio, links, reports, first, last, world):
    """Let k follow the contact: k = fewest + (most - fewest) x contact.

    Contact is the share of recent steps in which the agent was on target or heard one that was; a step weighs
    exp(-age / patience). A fast target breaks contact more often, and the best k falls as the target speeds up (Kwa,
    Leong Kit, Bouffanais, AAMAS 2020, Fig. 4): the rule needs no knowledge of the speed.
    """
    contact = links.wanted  # scratch by now
    for i in range(first, last):
        contact[i - first] = 1 if swarm.on_target[i] else 0
    for j in range(world.agents if links.silent.size == 0 else 0):
        if radio.max_age > 0:
            for i in range(last - first):
                if linked(links, j, i):
                    contact[i] |= 1 if radio.on_target[row(radio, radio.heard[j, i]), j] else 0
        elif reports.on_target[j]:
            for i in range(last - first):
                contact[i] |= 1 if linked(links, j, i) else 0
    if links.silent.size > 0:
        note_contact(links.lists, reports, contact, last)
    weight = min(1.0, world.time_step / radio.patience)
    for i in range(first, last):
        if swarm.alive[i] > 0.0:
            swarm.contact[i] = adapted(swarm.contact[i], contact[i - first], weight)
            swarm.neighbors[i] = degree_of(swarm.contact[i], radio.fewest[i], radio.most[i])
