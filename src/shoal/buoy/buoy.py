"""A buoy: one agent of a scenario that decides by itself. It opens no socket and no port, and has no clock."""

import math
from collections.abc import Iterable
from functools import reduce
from typing import Any, NamedTuple

from shoal.buoy.plain import NO_TRUTH, PlainMind
from shoal.compiler.kernel import plain
from shoal.compiler.late import compiles
from shoal.core.errors import MessageError, StrategyError
from shoal.core.messages import Own, Reading, Report
from shoal.scenario.briefing import briefing, degrees, fleet_of
from shoal.scenario.commands import Command
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.instructions import changed
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario
from shoal.world.motion import maneuvered, speed_scale
from shoal.world.orders import homeward
from shoal.world.radio import degree_of, first_degree


class Decision(NamedTuple):
    """What a buoy wants, and what it tells the others: velocity vx, vy [m/s] within its limits, and its report."""

    vx: float
    vy: float
    report: Report


class Buoy:
    """One agent of a scenario without a simulator: the same decisions, from what it measures and hears.

    Its clock is the number of the step, which the caller counts; its chance is that of the same agent, seed and run in
    the simulator. It is compiled where numba is installed, and plain Python where it is not.

    Parameters
    ----------
    scenario : what the whole swarm is told: a scenario, or what shoal.load makes one of
    id : which agent it is, 0 to N - 1 in the order of the fleets
    seed : decides all chance, with the run; default: the scenario's
    run : number of the replicate

    Attributes
    ----------
    briefing : what it is told before it leaves
    told : names of the fields that reports tell besides place, velocity and whether on target, for Report.from_bytes
    neighbors : k, to how many neighbors it listens; changes where the scenario lets k adapt
    heard : the reports that it decided on last
    wanted : the velocity that its strategy, or the order that it is under, wanted last [m/s], before its limits: for a
        body that knows them itself
    under : the order that it is under, hold or recall; or resume, which is none

    Raises
    ------
    ScenarioError : there is no such agent
    StrategyError : its strategy is told where targets are, which no buoy can know
    """

    def __init__(self, scenario: Source, id: int, *, seed: int | None = None, run: int = 0) -> None:
        scenario = load(scenario)
        crew = crew_of(scenario)
        self.id = id
        self.fleet = fleet_of(scenario, id)
        strategy = crew.strategies[self.fleet]
        if strategy.informed:
            problem = f"strategy {strategy.name!r} is told where targets are, which no buoy can know"
            raise StrategyError(f"agent {id}", problem, "choose another; `shoal strategies` says which are informed")
        self.briefing = briefing(scenario, id)
        self.told = crew.told
        self.neighbors = degrees(scenario, crew)[self.fleet]
        self._crew = crew
        self._make = scenario.fleets[self.fleet]
        self._time_step = scenario.time_step
        self._divide = scenario.motion.speed_rule == "divide"
        self._adaptive = scenario.network.adaptive
        self._seed, self._run = scenario.seed if seed is None else seed, run
        self._mind = _mind_of(crew, self._seed, run)
        self._begun = False
        self._scenario = scenario
        self._commands = sorted(
            (each for each in scenario.commands if id in (each.agents or (id,))), key=lambda each: each.step
        )
        self._followed = 0  # the step until which it has obeyed the scenario's commands
        self._sets: tuple[dict[str, Any], ...] = ()
        self.under = "resume"
        self._home = (0.0, 0.0)
        self._contact = 0.0
        self.heard: list[Report] = []
        self.wanted = (0.0, 0.0)
        if self._adaptive:
            everybody = scenario.agents - 1
            bounds = (everybody, everybody) if strategy.hears_all else (self._adaptive.fewest, self._adaptive.most)
            self._fewest, self._most = bounds
            self.neighbors, self._contact = _first_degree(self.neighbors, *bounds)

    @property
    def memory(self) -> dict[str, float]:
        """What it remembers, by name."""
        return dict(self._mind.remembered())

    @property
    def state(self) -> tuple[Any, ...]:
        """All that changes in it, to go back to by `restore`, or to go on from after a restart."""
        memory = tuple(self._mind.remembered().values())
        return memory, self.neighbors, self._contact, self.under, self._home, self._sets, self._followed

    def restore(self, state: tuple[Any, ...]) -> None:
        """Be as it was when it had this state.

        Parameters
        ----------
        state : what `state` was
        """
        memory, neighbors, self._contact, self.under, self._home, sets, self._followed = state
        if sets != self._sets:
            self._go_by(sets)
        self.neighbors = neighbors
        self._mind.recall(memory)
        self._begun = True

    def obey(self, command: Command) -> None:
        """Be under a command from now on, whatever its step is; those that the scenario has it obeys by itself.

        Parameters
        ----------
        command : shoal.scenario.commands.Command

        Raises
        ------
        ScenarioError : it sets a field that cannot change on the way, or a value that it cannot have
        """
        if command.set:
            self._go_by((*self._sets, command.set))
        else:
            self.under = str(command.order)

    def check(self, command: Command) -> None:
        """Refuse a command that cannot be obeyed.

        Parameters
        ----------
        command : shoal.scenario.commands.Command

        Raises
        ------
        ScenarioError : see `obey`
        """
        if command.set:
            self._after((*self._sets, command.set))

    def _after(self, sets: tuple[dict[str, Any], ...]) -> Scenario:
        """The scenario with fields set, one command after the other."""
        return reduce(changed, sets, self._scenario)

    def _go_by(self, sets: tuple[dict[str, Any], ...]) -> None:
        """Decide by the scenario with these fields set."""
        scenario = self._after(sets)
        memory = tuple(self._mind.remembered().values())
        self._crew = crew_of(scenario)
        self._mind = _mind_of(self._crew, self._seed, self._run)
        self._mind.recall(memory)
        self._sets = sets
        if not self._adaptive:
            self.neighbors = degrees(scenario, self._crew)[self.fleet]

    def begin(self, reading: Reading) -> None:
        """Set up the memory before the first step; `decide` and `report` do so if it was not done.

        Parameters
        ----------
        reading : what its instruments say where it lies; only the position counts
        """
        start = Reading(reading.x, reading.y, 0.0, 0.0, False)
        self._home = float(reading.x), float(reading.y)
        with self._crew.naming_errors():
            self._mind.begin(self._own(start, 0))
        self._begun = True

    def report(self, reading: Reading, step: int) -> Report:
        """Return what it tells the others in a step, from what it measures and from what it remembers so far.

        Parameters
        ----------
        reading : what its instruments say at the start of the step
        step : number of the step, from 0

        Raises
        ------
        MessageError : the reading holds a number that is not finite
        """
        x, y, vx, vy, on_target, drift_x, drift_y, _ = reading
        if not all(map(math.isfinite, (x, y, vx, vy, drift_x, drift_y))):
            problem = f"of agent {self.id} holds a number that is not finite, in step {step}"
            raise MessageError("reading", problem, "say and decide nothing until the instrument is well")
        if not self._begun:
            self.begin(reading)
        time = step * self._time_step
        return Report(self.id, float(x), float(y), float(vx), float(vy), bool(on_target), self._mind.told(), time)

    def decide(self, reading: Reading, inbox: Iterable[Report], step: int) -> Decision:
        """Return the velocity wanted in a step, and the report of that step.

        Of the reports that reached it, it hears the newest of each other agent, and of those the k nearest, ties to
        the lower id. It remembers what its strategy makes of them: ask once for each step.

        Parameters
        ----------
        reading : what its instruments say at the start of the step
        inbox : reports that reached it, in any order
        step : number of the step, from 0

        Raises
        ------
        MessageError : the reading holds a number that is not finite
        StrategyError : its strategy cannot be compiled, raises an error, or wants what is not finite
        """
        report = self.report(reading, step)
        self.follow(step)
        me = self._own(reading, step)
        heard = self.heard = self._heard(me, inbox)
        with self._crew.naming_errors():
            try:
                vx, vy = self._mind.decide(me, heard, step)
            except (ZeroDivisionError, OverflowError):  # compiled code would go on with infinity
                vx = vy = math.nan
        if not (math.isfinite(vx) and math.isfinite(vy)):
            problem = f"strategy {self._crew.name!r} wanted a velocity that is not finite, in step {step}"
            raise StrategyError(self._crew.source, problem, "guard divisions, roots and logarithms")
        self._adapt(me, heard)
        vx, vy = self._as_ordered(me, vx, vy)
        self.wanted = vx, vy
        return Decision(*self._limited(me, vx, vy), report)

    def _own(self, reading: Reading, step: int) -> Own:
        return Own(
            self.id,
            float(reading.x),
            float(reading.y),
            float(reading.vx),
            float(reading.vy),
            bool(reading.on_target),
            self._make.max_speed,
            self._time_step,
            step * self._time_step,
            self.fleet,
            self.briefing,
            NO_TRUTH,
            float(reading.drift_x),
            float(reading.drift_y),
            bool(reading.aground),
        )

    def _heard(self, me: Own, inbox: Iterable[Report]) -> list[Report]:
        """The newest report of each of the k nearest others, in the order of ids."""
        newest: dict[int, Report] = {}
        for report in inbox:
            if report.id != self.id and (report.id not in newest or report.time >= newest[report.id].time):
                newest[report.id] = report
        x, y = me.x, me.y
        far = [((x - it.x) * (x - it.x) + (y - it.y) * (y - it.y), id) for id, it in newest.items()]
        nearest = [newest[id] for _, id in sorted(far)[: self.neighbors]]
        if self._crew.ranked:
            nearest = [report._replace(rank=rank) for rank, report in enumerate(nearest)]
        return sorted(nearest, key=lambda report: report.id)

    def _adapt(self, me: Own, heard: list[Report]) -> None:
        """Let k follow the contact, where the scenario says so."""
        if self._adaptive:
            contact = 1 if me.on_target or any(report.on_target for report in heard) else 0
            self._contact += min(1.0, self._time_step / self._adaptive.patience) * (contact - self._contact)
            self.neighbors = _degree_of(self._contact, self._fewest, self._most)

    def follow(self, step: int) -> None:
        """Obey the commands of the scenario up to a step; `decide` does so by itself.

        Parameters
        ----------
        step : number of the step, from 0
        """
        for command in self._commands:
            if self._followed < command.step <= step:
                self.obey(command)
        self._followed = max(self._followed, step)

    def _as_ordered(self, me: Own, vx: float, vy: float) -> tuple[float, float]:
        """What it wants, under the order that it is under; it senses, reports and remembers as under none."""
        if self.under == "hold":
            return 0.0, 0.0
        if self.under == "recall":
            turn, change = math.radians(self._make.max_turn_rate or math.inf), self._make.max_acceleration or math.inf
            away = self._home[0] - me.x, self._home[1] - me.y
            vx, vy = _homeward(*away, me.max_speed, change, turn, self._time_step)
        return vx, vy

    def _limited(self, me: Own, vx: float, vy: float) -> tuple[float, float]:
        """A velocity within what the buoy can do."""
        make = self._make
        if make.max_acceleration or make.max_turn_rate:
            turn = math.radians(make.max_turn_rate or math.inf) * self._time_step
            change = (make.max_acceleration or math.inf) * self._time_step
            vx, vy = _maneuvered(me.vx, me.vy, vx, vy, turn, change)
        scale = _speed_scale(vx, vy, make.max_speed, self._divide)
        return vx * scale, vy * scale


def _mind_of(crew: Crew, seed: int, run: int) -> Any:
    if not compiles():
        return PlainMind(crew, seed, run)
    from shoal.buoy.compiled import CompiledMind

    return CompiledMind(crew, seed, run)


# Of the world's formulas, the plain functions: one number takes longer to hand to compiled code than to work out.
_first_degree, _degree_of, _homeward = plain(first_degree), plain(degree_of), plain(homeward)
_maneuvered, _speed_scale = plain(maneuvered), plain(speed_scale)
