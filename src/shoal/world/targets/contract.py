"""What a file says to declare a kind of target: TARGET = Target(name=..., options=..., advance=...).

    begin(target, around, draw)       once, at the start: set up its state
    advance(target, around, draw)     every step, after the agents have moved: move it
    heading_to(target) -> (vx, vy, x, y)     its velocity [m/s] and where it is heading to [m], for informed strategies

`target` is a record: its state, what is chosen of it, and what is worked out from that, by name. Nothing but `go` and
the mirrors in moves.py changes x and y, so that a current carries every kind. `draw` is the key of its chance in this
step, see core/draws.py.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from shoal.compiler.kernel import kernel
from shoal.core.agents import Floats
from shoal.core.errors import PluginError
from shoal.core.text import checked_name
from shoal.world.assembled import refuse_wrong_arguments, refuse_wrong_fields
from shoal.world.sea.land import Land
from shoal.world.targets.moves import any_heading

STATE: dict[str, type[Any]] = {  # what every target is doing
    "present": int,  # 0: nobody can detect it
    "x": float,
    "y": float,
    "watchers": int,  # agents that detect it in this step
    "lost": int,  # steps since somebody did; -1 before the first detection
    "heading_x": float,  # of kinds that move
    "heading_y": float,
    "dive_phase": float,
    "drift_x": float,  # what nature adds to its next displacement [m]
    "drift_y": float,
}
MAKE: dict[str, type[Any]] = {  # what is chosen of every target
    "kind": int,
    "radius": float,
    "speed": float,
    "half_x": float,  # of the box that it stays in
    "half_y": float,
    "surface_time": float,  # of those that dive; 0: never
    "dive_time": float,
    "first_fix": int,  # of those that follow a recorded track
    "fixes": int,
    "max_gap": float,
    "leeway_slope": float,  # how the wind moves it, see world/sea/sea.py's Leeway
    "leeway_offset": float,
    "leeway_cosine": float,
    "leeway_sine": float,
}
SHARED = ("radius", "speed", "surface_time", "dive_time", "x", "y", "max_gap")  # that options of a kind may be


class Tracks(NamedTuple):
    """The fixes of all recorded targets, one behind the other: time [s] from the start, x, y [m]."""

    time: Floats
    x: Floats
    y: Floats


class Around(NamedTuple):
    """What a target may go by in a step.

    time_step [s]; time : at the end of the step [s]
    agents : how many; x, y, alive : of each, positions [m] and 1.0, or 0.0 of one that is not there
    tracks : the fixes of recorded targets
    shore : land, and where they may not go; see world/sea/land.py, `anywhere_afloat`
    """

    time_step: float
    time: float
    agents: int
    x: Floats
    y: Floats
    alive: Floats
    tracks: Tracks
    shore: Land


@kernel
def _head_anywhere(target, around, draw):
    any_heading(target, draw)


@kernel
def _straight_on(target):
    return target.speed * target.heading_x, target.speed * target.heading_y, target.x, target.y


@dataclass(frozen=True)
class Target:
    """A kind of target.

    Parameters
    ----------
    name : what scenarios call it, `kind`
    options : class whose annotations are what a scenario may say of one, with units, ranges and sentences; its
        docstring says what the kind is. Numbers among them are fields of the record
    advance : moves it, see above
    begin : sets it up; default: it heads anywhere
    heading_to : default: its speed along its heading, to where it is
    state : {field: float or int}, what else it remembers from step to step, zero at first
    make : {field: function of the options}, what else kernels need to know, worked out once [float]
    check : function of the options that raises ValueError("what is wrong; how to fix it")
    moves : whether it has a speed and a margin, may dive, and starts anywhere in its box; else it starts where its
        options x, y or `begin` say. Draws 0, 1 and 9 of its start are then taken

    Raises
    ------
    PluginError : names that are taken, functions that take other arguments
    """

    name: str
    options: type[Any]
    advance: Callable[..., Any]
    begin: Callable[..., Any] = _head_anywhere
    heading_to: Callable[..., Any] = _straight_on
    state: Mapping[str, type[Any]] = field(default_factory=dict)
    make: Mapping[str, Callable[[Any], float]] = field(default_factory=dict)
    check: Callable[[Any], None] | None = None
    moves: bool = True

    def __post_init__(self) -> None:
        """Check, and compile the functions that are not compiled yet."""
        where = f"target {self.name!r}"
        try:
            checked_name(self.name)
        except ValueError as error:
            raise PluginError(where, str(error), "name it by words, such as my-boat") from None
        arguments = {
            "begin": (self.begin, ("target", "around", "draw")),
            "advance": (self.advance, ("target", "around", "draw")),
            "heading_to": (self.heading_to, ("target",)),
        }
        refuse_wrong_arguments(where, arguments)
        refuse_wrong_fields(where, self, {**STATE, **MAKE}, SHARED)
        for role in arguments:
            object.__setattr__(self, role, kernel(getattr(self, role)))
