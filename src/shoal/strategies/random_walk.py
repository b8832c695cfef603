"""Persistent random walk: full speed ahead, with a heading that diffuses; nobody listens to anybody.

Kareiva and Shigesada, "Analyzing insect movement as a correlated random walk", Oecologia 56, 1983. The mean cosine of
the turn made in a time t is exp(-t / persistence).
"""

import math
from typing import Annotated, NamedTuple

from shoal.core.draws import normal, uniform
from shoal.core.units import Doc, Follows, Range, Seconds
from shoal.strategies.contract import strategy
from shoal.strategies.parts import turned_from_walls


class RandomWalk(NamedTuple):
    """Parameters."""

    persistence: Annotated[
        Seconds, Follows("spacing"), Range(open=True), Doc("after this time the mean cosine of the turn is 1/e")
    ] = 5.0


def begin(me, memory, params, draw):
    """Any heading."""
    memory.heading = 2.0 * math.pi * uniform(draw, 0)


def decide(me, heard, memory, params, draw):
    """Persistent random walk.

    heading <- heading + sqrt(2 dt / persistence) N(0, 1)
    """
    memory.heading += math.sqrt(2.0 * me.time_step / params.persistence) * normal(draw, 0)
    memory.heading = turned_from_walls(me, memory.heading)
    return me.max_speed * math.cos(memory.heading), me.max_speed * math.sin(memory.heading)


strategy(
    "random-walk",
    params=RandomWalk,
    memory={"heading": "rad"},
    begin=begin,
    reference="Kareiva, Shigesada, Oecologia 56, 1983",
)(decide)
