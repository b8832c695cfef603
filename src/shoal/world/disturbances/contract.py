"""What a file says to declare a kind of disturbance: DISTURBANCE = Disturbance(name=..., options=..., advance=...).

    begin(me, memory, options, draw)             once for every agent: set up its memory
    advance(me, memory, options, around, draw)   once for every agent there, before each step: say what it does to it
    carry(target, options, around, draw)         the same for every target: add to target.drift_x, target.drift_y [m]

It acts before anybody senses, on whom the scenario says (`fleet`) and while it says (`since`, `until`). `me` is a
record with the fields of EFFECTS, calm at the start of every step; disturbances act on it one after the other, so
they add to the drift, and multiply what may be a share already. `memory` holds what it remembers of this agent,
`options` what is chosen and worked out of it. `draw` is the key of this agent's chance in this step; `around.chance` is
one for all agents and steps of the run.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.compiler.kernel import kernel
from shoal.core.errors import PluginError
from shoal.core.text import checked_name
from shoal.world.assembled import dtype_of, refuse_wrong_arguments, refuse_wrong_fields

EFFECTS = dtype_of(
    {
        "id": int,  # of the agent; to read, as are the next
        "fleet": int,
        "x": float,  # [m]
        "y": float,
        "vx": float,  # its own velocity [m/s]
        "vy": float,
        "drift_x": float,  # add to it: what is added to its displacement in this step [m]
        "drift_y": float,
        "senses": float,  # multiply it: 1, or 0 if it detects and imagines nothing; between, the chance that it does
        "hears": float,  # 1, or 0 if no report reaches it
        "speed": float,  # multiply it: how much of its top speed it can go, 0 to 1
        "lost": int,  # set it to 1: it is lost from this step on, for good
    }
)

COMMON: dict[str, type[Any]] = {  # what is chosen of every disturbance
    "kind": int,
    "fleet": int,  # -1: all, and targets
    "since": float,  # [s]
    "until": float,
}


class Around(NamedTuple):
    """What a disturbance may go by in a step.

    number : of the step; agents : how many there are, the lost and those who join later, too
    time_step [s]; time : at the start of the step [s]
    half_x, half_y : half the sides of the arena [m]
    chance : key for draws that all agents share, see core/draws.py
    """

    number: int
    agents: int
    time_step: float
    time: float
    half_x: float
    half_y: float
    chance: Any


NOT_BEGUN = -1  # the step of which nothing is done yet


class Nature(NamedTuple):
    """The disturbances of a run, and what they do; D disturbances, L lanes.

    disturbances : (D,) records of what is chosen; effects : (L,) records of EFFECTS, for the coming step
    memory : (D, L) records of what each remembers of each agent
    clock : (2,) the step that the effects are for, NOT_BEGUN before the first; 1 once a drift was not finite
    """

    disturbances: npt.NDArray[Any]
    effects: npt.NDArray[Any]
    memory: npt.NDArray[Any]
    clock: npt.NDArray[np.int64]


class Weather(NamedTuple):
    """What changes of it in a run."""

    effects: npt.NDArray[Any]
    memory: npt.NDArray[Any]
    clock: npt.NDArray[np.int64]


@kernel
def _begin_with_zeros(me, memory, options, draw):
    """Nothing to set up."""


@kernel
def _leave_targets_alone(target, options, around, draw):
    """Nothing to do."""


@dataclass(frozen=True)
class Disturbance:
    """A kind of disturbance.

    Parameters
    ----------
    name : what scenarios call it, `kind`
    options : class whose annotations are what a scenario may say of one, with units, ranges and sentences; its
        docstring says what the kind is
    advance : acts on an agent, see above
    begin : sets up what is remembered of an agent; default: zeros
    carry : acts on a target; default: not at all
    state : {field: float or int}, what it remembers of each agent from step to step
    make : {field: function of the options}, what else kernels need to know, worked out once [float]
    check : function of the options that raises ValueError("what is wrong; how to fix it")

    Raises
    ------
    PluginError : names that are taken, functions that take other arguments
    """

    name: str
    options: type[Any]
    advance: Callable[..., Any]
    begin: Callable[..., Any] = _begin_with_zeros
    carry: Callable[..., Any] = _leave_targets_alone
    state: Mapping[str, type[Any]] = field(default_factory=dict)
    make: Mapping[str, Callable[[Any], float]] = field(default_factory=dict)
    check: Callable[[Any], None] | None = None

    def __post_init__(self) -> None:
        """Check, and compile the functions that are not compiled yet."""
        where = f"disturbance {self.name!r}"
        try:
            checked_name(self.name)
        except ValueError as error:
            raise PluginError(where, str(error), "name it by words, such as my-storm") from None
        arguments = {
            "begin": (self.begin, ("me", "memory", "options", "draw")),
            "advance": (self.advance, ("me", "memory", "options", "around", "draw")),
            "carry": (self.carry, ("target", "options", "around", "draw")),
        }
        refuse_wrong_arguments(where, arguments)
        refuse_wrong_fields(where, self, COMMON, ())
        for role in arguments:
            object.__setattr__(self, role, kernel(getattr(self, role)))
