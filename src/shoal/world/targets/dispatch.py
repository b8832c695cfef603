"""What every target does, and the kind that each is asked for it: kernels chained once, one link per kind."""

from typing import Any

from shoal.compiler.kernel import kernel
from shoal.core.draws import uniform
from shoal.world.sea.land import anywhere_afloat
from shoal.world.targets.catalogue import KINDS
from shoal.world.targets.contract import Around
from shoal.world.targets.dive import surface_or_dive


@kernel
def begin_target(target, tracks, swarm, sea, world, draw):
    """Put a target where it starts, uniform in its box if it moves by a rule, and let its kind set it up."""
    around = Around(world.time_step, 0.0, world.agents, swarm.x, swarm.y, swarm.alive, tracks, sea.shore)
    _begin(target, around, draw)


@kernel
def advance_target(target, tracks, swarm, sea, world, steps_done, draw):
    """Move a target by one time-step; `steps_done` counts the steps completed with this one."""
    time = steps_done * world.time_step
    around = Around(world.time_step, time, world.agents, swarm.x, swarm.y, swarm.alive, tracks, sea.shore)
    _advance(target, around, draw)
    surface_or_dive(target, time)


@kernel
def heading_to(target):
    """Velocity of a target, and where it is heading to."""
    return _heading_to(target)


@kernel
def _place_and_begin(target, around, draw):
    """Start anywhere in the box where there is water."""
    target.x, target.y = anywhere_afloat(around.shore, target.half_x, target.half_y, draw)


@kernel
def _dive_anywhere(target, draw):
    """Begin anywhere in the cycle."""
    target.dive_phase = uniform(draw, 9)
    surface_or_dive(target, 0.0)


def _chained(role: str, last: Any, link: Any) -> Any:
    chain = last
    for number, each in reversed(list(enumerate(KINDS))):
        chain = link(number, getattr(each.value, role), each.value.moves, chain)
    return chain


def _begin_link(number: int, chosen: Any, moves: bool, others: Any) -> Any:
    def begin_moving(target, around, draw):
        if target.kind == number:
            _place_and_begin(target, around, draw)
            chosen(target, around, draw)
            _dive_anywhere(target, draw)
        else:
            others(target, around, draw)

    def begin(target, around, draw):
        if target.kind == number:
            chosen(target, around, draw)
        else:
            others(target, around, draw)

    return kernel(begin_moving if moves else begin)


def _advance_link(number: int, chosen: Any, moves: bool, others: Any) -> Any:
    def advance(target, around, draw):
        if target.kind == number:
            chosen(target, around, draw)
        else:
            others(target, around, draw)

    return kernel(advance)


def _heading_link(number: int, chosen: Any, moves: bool, others: Any) -> Any:
    def heading_to(target):
        if target.kind == number:
            return chosen(target)
        return others(target)

    return kernel(heading_to)


@kernel
def _nothing(target, around, draw):
    """No kind."""


@kernel
def _nowhere(target):
    """No kind."""
    return 0.0, 0.0, target.x, target.y


_begin = _chained("begin", _nothing, _begin_link)
_advance = _chained("advance", _nothing, _advance_link)
_heading_to = _chained("heading_to", _nowhere, _heading_link)
