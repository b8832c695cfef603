"""A batch of runs on the card: each is a block of threads, all run at once."""

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np

from shoal.compiler.known import Fact, place_of
from shoal.compiler.late import compiles
from shoal.compiler.packed import reader
from shoal.engine.gpu.arena import Arena
from shoal.engine.gpu.card import as_on_the_cpu, compiled, finish, numbers
from shoal.engine.stage import RADIO, WORLD, Stage
from shoal.world.neighbors import new_links

MOST_AGENTS = 255  # a block has as many threads and one more
_NEAR = 48 << 10  # bytes that a block has for itself without asking
_WARP = 32


class Work(NamedTuple):
    """What one run works on, as the engine takes it: stage, memories and parameters of its strategies."""

    stage: Stage
    memories: Any
    params: Any


class Batch:
    """Runs whose strategies are of one kind and whose `facts` are the same, on the card.

    Parameters
    ----------
    works : of each run; their arrays are read now, and written by `fetch`
    """

    def __init__(self, works: Sequence[Work]) -> None:
        works = [each._replace(stage=_with_room(each.stage)) for each in works]
        self._arena: Arena | None = None
        self._columns: list[Any] = [list(column) for column in zip(*works, strict=True)]
        if compiles():
            self._arena = Arena(works)
            self._columns = self._arena.columns
        most = max(each.stage.world.agents for each in works)
        size = most * (most + 2)
        near = 8 * size <= _NEAR
        self._far = numbers(1 if near else size * len(works))
        known = facts(works[0].stage.world, works[0].stage.radio)
        self._kernel = _kernel_for(_Kind(works[0].memories), _Kind(works[0].params), known, near)
        threads = -(-(most + 1) // _WARP) * _WARP if compiles() else most + 1
        self._shape = len(works), threads, 0, 8 * size if near else 0

    def advance(self, first: int, last: int, every: int, tail: int) -> None:
        """Run steps first..last of all, and wait; runs with room keep frames of every `every`-th, and all from `tail`.

        Raises
        ------
        DeviceError : they cannot be compiled
        """
        with as_on_the_cpu():
            self._kernel[self._shape](*self._columns, self._far, first, last, every, tail)
            finish()

    def send(self) -> None:
        """Take the state of all runs to the card again, after a change of it here."""
        if self._arena is not None:
            self._arena.send()

    def fetch(self) -> None:
        """Bring the state of all runs back."""
        if self._arena is not None:
            self._arena.fetch()


def facts(world: Any, radio: Any) -> tuple[Fact, ...]:
    """What is not there in a run, and so need not be compiled: all that is on or off, and a radio that does nothing."""
    found: list[Fact] = [(WORLD, name, value) for name, value in world._asdict().items() if isinstance(value, bool)]
    found += [(RADIO, name, value) for name, value in radio._asdict().items() if isinstance(value, bool)]
    found += [(RADIO, name, value) for name, value in _QUIET.items() if getattr(radio, name) == value]
    return tuple(found)


_QUIET = {"delay": 0, "interval": 1, "max_age": 0, "hops": 1, "loss": 0.0}


class _Kind:
    """A value that stands for all of its type."""

    def __init__(self, value: Any) -> None:
        self.value = value
        self.name = type(value), _shape_of(value)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Kind) and self.name == other.name

    def __hash__(self) -> int:
        return hash(self.name)


def _shape_of(value: Any) -> Any:
    """Classes and types of numbers in nested tuples."""
    if isinstance(value, tuple):
        return type(value), tuple(_shape_of(each) for each in value)
    return str(value.dtype) if isinstance(value, np.ndarray) else type(value)


@cache
def _kernel_for(memories: _Kind, params: _Kind, known: tuple[Fact, ...], near: bool) -> Any:
    from shoal.engine.gpu.step import make_rollout

    return compiled(make_rollout(reader(memories.value), reader(params.value), place_of(known), near))


def _with_room(stage: Stage) -> Stage:
    """The same stage, with room for every agent to sort those whom it hears, and no distances: a block has its own.

    On a card it is distances that say who hears whom, however many agents there are.
    """
    scratch, links = stage.scratch, stage.scratch.links
    if stage.world.listed:
        links = new_links(stage.world.agents, links.reach.size, links.lists.rank.shape[0] > 0)
        stage = stage._replace(world=stage.world._replace(listed=0))
    order = np.zeros(links.order.size * links.reach.size, np.int64)
    links = links._replace(order=order, square=np.zeros((0, 0)))
    return stage._replace(scratch=scratch._replace(links=links))
