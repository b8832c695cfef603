"""What a file of metrics declares: its sums, when they are counted, and the numbers that are made of them.

    @kernel
    def count_closest(tally, step, world, swarm, targets, scratch):
        ...

    MEASUREMENT = Measurement(
        "closest",
        sums=(Sum("closest", "m^2", "the least square of a distance", shape=("run",), start=NONE_SEEN),),
        before_move=count_closest,
        metrics=(Metric("closest", "m", "smallest distance between two agents", of_tally, better="higher"),),
    )

All sums of all files make the Tally (tally.py), and all their metrics METRICS (summary.py).
"""

import math
from collections.abc import Callable
from typing import Any, Literal, NamedTuple

from shoal.core.messages import REPORT_BYTES

Kernel = Callable[[Any, "Step", Any, Any, Any, Any], None]  # (tally, step, world, swarm, targets, scratch)
MOMENTS = ("before_move", "linked", "after_move")

# Bounds that a scenario decides, and what they are where it is not known: number of agents, share of cells where they
# may go, length of a run [s], and how often a target is lost that is found at every other step [1/h].
LIMITS = {"agents": math.inf, "reach": 1.0, "duration": math.inf, "flicker": math.inf}


class Step(NamedTuple):
    """Which step is counted.

    number : of the step in the run, from 0
    batch : the row of every sum that it belongs to
    first : of the agents that just listened, when they are linked; 0 at other moments
    """

    number: int
    batch: int
    first: int


class Facts(NamedTuple):
    """What metrics need to know of a scenario.

    fleets, counts, max_speeds : name, number of agents (those that join later too) and top speed [m/s] of each fleet
    unit [m] : one arena unit; time_step [s]; area [m^2]; report_bytes : size of one report [B]
    interval [s] : from one report of an agent to its next, 0 for every step; airtime [s] : of a report, 0 if not known
    capacities [J] : of a battery of each fleet, 0 for none; costs : of an agent of each fleet; empty if not known
    """

    fleets: tuple[str, ...]
    counts: tuple[int, ...]
    max_speeds: tuple[float, ...]
    unit: float
    time_step: float
    area: float = float("nan")
    report_bytes: int = REPORT_BYTES
    interval: float = 0.0
    airtime: float = 0.0
    capacities: tuple[float, ...] = ()
    costs: tuple[float, ...] = ()

    @property
    def report_interval(self) -> float:
        """Time from one report of an agent to its next [s]."""
        return self.interval or self.time_step

    @property
    def agents(self) -> int:
        """All agents that ever take part."""
        return sum(self.counts)


class Sum(NamedTuple):
    """An array that the engine adds to.

    name : its field in the tally
    unit, sentence : of what is added
    shape : "batch", or "run" of what is not added up but kept for the whole run; then "fleet", "agent" or "target" for
        one of each, or a number of bins
    integer : whole numbers, int64 instead of float64
    start : what it begins at, finite
    """

    name: str
    unit: str
    sentence: str
    shape: tuple[str | int, ...] = ("batch",)
    integer: bool = False
    start: float = 0.0


class Metric(NamedTuple):
    """A number per run.

    name, unit, sentence : as tables, files and lists say them
    formula : (tally, facts) -> number, of a tally whose batches are to be summed; NaN where there is none
    label : in tables and figures; default: the name
    better : whether higher or lower is better, or neither
    once : it happens once in a run, or the scenario decides it, so that batches of steps say nothing about its spread
    low, high : its bounds; those that a scenario decides have a name, see LIMITS
    several_targets : it says something only where there are several
    asked : it has a value only where the scenario asks for it, and no place in tables of others
    package : the installed package that it is from, as errors call it; empty of built-in ones
    """

    name: str
    unit: str
    sentence: str
    formula: Callable[[Any, Facts], float]
    label: str = ""
    better: Literal["higher", "lower", "neither"] = "neither"
    once: bool = False
    low: float = 0.0
    high: float | str = math.inf
    several_targets: bool = False
    asked: bool = False
    package: str = ""

    @property
    def words(self) -> str:
        """What tables and figures call it."""
        return self.label or self.name.replace("_", " ")

    @property
    def direction(self) -> int:
        """1: higher is better, -1: lower is, 0: neither."""
        return {"higher": 1, "lower": -1, "neither": 0}[self.better]


class Measurement(NamedTuple):
    """What one file counts, and the metrics that are made of it.

    name : of the file, or of the entry point of an installed package
    sums : what it adds to; a metric may also use those of other files
    before_move : kernel called at the start of every step: who is where, and on target
    linked : kernel called when agents have listened: all at once, or one by one in the sequential order
    after_move : kernel called when agents have moved and targets have not
    metrics : what is made of the sums
    order : of the built-in files, in the tally and in tables
    """

    name: str
    sums: tuple[Sum, ...] = ()
    before_move: Kernel | None = None
    linked: Kernel | None = None
    after_move: Kernel | None = None
    metrics: tuple[Metric, ...] = ()
    order: int = 0
