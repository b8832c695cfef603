"""A buoy: one agent of a scenario that decides by itself. It opens no socket and no port, and has no clock."""

import math
from collections.abc import Iterable, Sequence
from functools import reduce
from operator import attrgetter
from typing import Any, NamedTuple

import numpy as np

from shoal.buoy.plain import NO_TRUTH, PlainMinds
from shoal.buoy.rows import ID, ON_TARGET, TIME, TOLD, Floats
from shoal.buoy.said import Near, Said, nearest_alone
from shoal.compiler.kernel import plain
from shoal.compiler.late import compiles
from shoal.core.errors import MessageError, StrategyError
from shoal.core.messages import Own, Reading, Report
from shoal.scenario.briefing import briefing_in, degrees, fleet_of
from shoal.scenario.commands import Command
from shoal.scenario.crew import Crew, crew_of
from shoal.scenario.instructions import changed
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario
from shoal.world.motion import maneuvered, speed_scale
from shoal.world.orders import homeward
from shoal.world.radio import degree_of, first_degree

_ON_TARGET = Reading._fields.index("on_target")
_BEGUN = attrgetter("_begun")


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
    heard : the reports that it decided on last, in the order of ids
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
        self._set_up(scenario, crew, id, scenario.seed if seed is None else seed, run)
        self._minds, self._place = _minds_of(crew, self._seed, run, [self]), 0

    @classmethod
    def several(cls, scenario: Source, ids: Iterable[int], *, run: int = 0) -> dict[int, "Buoy"]:
        """Several agents of a scenario, which is read once for all of them.

        Parameters
        ----------
        scenario, run : as of one
        ids : which agents

        Raises
        ------
        ScenarioError, StrategyError : as of one
        """
        scenario = load(scenario)
        crew = crew_of(scenario)
        made = {id: cls.__new__(cls) for id in ids}
        for id, buoy in made.items():
            buoy._set_up(scenario, crew, id, scenario.seed, run)
        minds = _minds_of(crew, scenario.seed, run, list(made.values()))
        for place, buoy in enumerate(made.values()):
            buoy._minds, buoy._place = minds, place
        return made

    def _set_up(self, scenario: Scenario, crew: Crew, id: int, seed: int, run: int) -> None:
        self.id = id
        self._seed, self._run = seed, run
        self.fleet = fleet_of(scenario, id)
        strategy = crew.strategies[self.fleet]
        if strategy.informed:
            problem = f"strategy {strategy.name!r} is told where targets are, which no buoy can know"
            raise StrategyError(f"agent {id}", problem, "choose another; `shoal strategies` says which are informed")
        self.briefing = briefing_in(scenario, id)
        self.told = crew.told
        self.neighbors = degrees(scenario, crew)[self.fleet]
        self._crew = crew
        self._make = scenario.fleets[self.fleet]
        self._time_step = scenario.time_step
        self._divide = scenario.motion.speed_rule == "divide"
        self._adaptive: Any = scenario.network.adaptive
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
        self._heard: tuple[Said, Near] | None = None
        self.wanted = (0.0, 0.0)
        if self._adaptive:
            everybody = scenario.agents - 1
            bounds = (everybody, everybody) if strategy.hears_all else (self._adaptive.fewest, self._adaptive.most)
            self._fewest, self._most = bounds
            self.neighbors, self._contact = _first_degree(self.neighbors, *bounds)

    @property
    def memory(self) -> dict[str, float]:
        """What it remembers, by name."""
        return dict(zip(self._crew.memory, self._minds.numbers(self._place), strict=True))

    @property
    def heard(self) -> list[Report]:
        """The reports that it decided on last, in the order of ids."""
        if self._heard is None:
            return []
        said, near = self._heard
        return said.heard(near, self._crew.ranked)

    def whom(self) -> list[int]:
        """Return whose reports it decided on last, in the order of ids."""
        return [] if self._heard is None else self._heard[0].speakers(self._heard[1])

    @staticmethod
    def memories(buoys: Sequence["Buoy"]) -> Floats:
        """Return what buoys of one scenario remember, (n, M), in the order of the fields.

        Parameters
        ----------
        buoys : n of them
        """
        found = np.empty((len(buoys), len(buoys[0]._crew.memory) if buoys else 0))
        for rows, its in _of_one_mind(buoys):
            found[rows] = its[0]._minds.memories([buoy._place for buoy in its])
        return found

    @property
    def state(self) -> tuple[Any, ...]:
        """All that changes in it, to go back to by `restore`, or to go on from after a restart."""
        memory = self._minds.numbers(self._place)
        return memory, self.neighbors, self._contact, self.under, self._home, self._sets, self._followed, self._begun

    def restore(self, state: tuple[Any, ...]) -> None:
        """Be as it was when it had this state.

        Parameters
        ----------
        state : what `state` was
        """
        memory, neighbors, self._contact, self.under, self._home, sets, self._followed, self._begun = state
        if sets != self._sets:
            self._go_by(sets)
        self.neighbors = neighbors
        self._minds.recall(self._place, memory)

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
        memory = self._minds.numbers(self._place)
        self._crew = crew_of(scenario)
        self._minds, self._place = _minds_of(self._crew, self._seed, self._run, [self]), 0
        self._minds.recall(self._place, memory)
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
            self._minds.begin(self._place, start)
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
        self._check(reading, step)
        x, y, vx, vy, on_target, *_ = reading
        time = step * self._time_step
        return Report(
            self.id, float(x), float(y), float(vx), float(vy), bool(on_target), self._minds.told(self._place), time
        )

    @staticmethod
    def report_together(buoys: Sequence["Buoy"], readings: Floats, step: int) -> Floats:
        """Return what several buoys tell the others in a step: rows of numbers, (n, 7 + T), see buoy/rows.py.

        Parameters
        ----------
        buoys, readings : n of them, and (n, 8) what their instruments say at the start of the step
        step : number of the step, from 0

        Raises
        ------
        MessageError : a reading holds a number that is not finite
        """
        Buoy._check_together(buoys, readings, step)
        tells = len(buoys[0].told) if buoys else 0
        said = np.empty((len(buoys), TOLD + tells))
        said[:, :4], said[:, ON_TARGET] = readings[:, :4], readings[:, _ON_TARGET]
        said[:, ID] = [buoy.id for buoy in buoys]
        said[:, TIME] = step * (buoys[0]._time_step if buoys else 0.0)
        if tells:
            said[:, TOLD:] = Buoy.memories(buoys)[:, :tells]
        return said

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
        newest: dict[int, Report] = {}
        for each in inbox:
            if each.id not in newest or each.time >= newest[each.id].time:
                newest[each.id] = each
        said, near = nearest_alone(newest, self.told, report, self.neighbors)
        ((vx, vy),) = Buoy.decide_together([self], np.array([reading], float), said, near, step).tolist()
        return Decision(*self.limited(reading, vx, vy), report)

    @staticmethod
    def decide_together(buoys: Sequence["Buoy"], readings: Floats, said: Said, near: Near, step: int) -> Floats:
        """Let buoys decide that followed the scenario's commands so far.

        Parameters
        ----------
        buoys, readings : n of them, and (n, 8) what their instruments say at the start of the step
        said, near : the reports that reached them, and (n, k, 2) those of their neighbors
        step : number of the step, from 0

        Returns
        -------
        (n, 2) what they want [m/s], before their limits

        Raises
        ------
        MessageError, StrategyError : as decide
        """
        Buoy._check_together(buoys, readings, step)
        wants = np.empty((len(buoys), 2))
        for rows, its in _of_one_mind(buoys):
            places = [buoy._place for buoy in its]
            with its[0]._crew.naming_errors():
                wants[rows] = its[0]._minds.decide(places, readings[rows], said, near[rows], step)
        if not np.isfinite(wants).all():
            crew = buoys[int(np.isfinite(wants).all(axis=1).argmin())]._crew
            problem = f"strategy {crew.name!r} wanted a velocity that is not finite, in step {step}"
            raise StrategyError(crew.source, problem, "guard divisions, roots and logarithms")
        for n, (buoy, heard, want) in enumerate(zip(buoys, near, wants.tolist(), strict=True)):
            buoy._heard, buoy.wanted = (said, heard), (want[0], want[1])
            if buoy._adaptive:
                buoy._adapt(1 if readings[n, _ON_TARGET] or said.contact(heard) else 0)
            if buoy.under != "resume":  # it senses and remembers as under none
                wants[n] = buoy.wanted = buoy._as_ordered(*readings[n, :2].tolist())
        return wants

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

    def _as_ordered(self, x: float, y: float) -> tuple[float, float]:
        """What it wants under an order, where it is."""
        if self.under == "hold":
            return 0.0, 0.0
        make = self._make
        turn, change = math.radians(make.max_turn_rate or math.inf), make.max_acceleration or math.inf
        vx, vy = _homeward(self._home[0] - x, self._home[1] - y, make.max_speed, change, turn, self._time_step)
        return vx, vy

    def _check(self, reading: Reading, step: int) -> None:
        x, y, vx, vy, _, drift_x, drift_y, _ = reading
        if not all(map(math.isfinite, (x, y, vx, vy, drift_x, drift_y))):
            problem = f"of agent {self.id} holds a number that is not finite, in step {step}"
            raise MessageError("reading", problem, "say and decide nothing until the instrument is well")
        if not self._begun:
            self.begin(reading)

    @staticmethod
    def _check_together(buoys: Sequence["Buoy"], readings: Floats, step: int) -> None:
        if not (np.isfinite(readings).all() and all(map(_BEGUN, buoys))):
            for buoy, reading in zip(buoys, readings.tolist(), strict=True):
                buoy._check(Reading(*reading), step)

    def _adapt(self, contact: int) -> None:
        """Let k follow the contact."""
        self._contact += min(1.0, self._time_step / self._adaptive.patience) * (contact - self._contact)
        self.neighbors = _degree_of(self._contact, self._fewest, self._most)

    def limited(self, me: Reading, vx: float, vy: float) -> tuple[float, float]:
        """Return of a wanted velocity what the buoy can do.

        Parameters
        ----------
        me : how it moves now
        vx, vy : what is wanted [m/s]
        """
        make = self._make
        if make.max_acceleration or make.max_turn_rate:
            turn = math.radians(make.max_turn_rate or math.inf) * self._time_step
            change = (make.max_acceleration or math.inf) * self._time_step
            vx, vy = _maneuvered(float(me.vx), float(me.vy), vx, vy, turn, change)
        scale = _speed_scale(vx, vy, make.max_speed, self._divide)
        return vx * scale, vy * scale


def _of_one_mind(buoys: Sequence[Buoy]) -> list[tuple[Any, Sequence[Buoy]]]:
    """Which of them decide together, rows and buoys: all but those who were told to go by something else."""
    together: dict[int, list[int]] = {}
    for n, buoy in enumerate(buoys):
        together.setdefault(id(buoy._minds), []).append(n)
    if len(together) == 1:
        return [(slice(None), buoys)]  # whose rows need not be copied
    return [(rows, [buoys[n] for n in rows]) for rows in together.values()]


def _minds_of(crew: Crew, seed: int, run: int, buoys: list[Buoy]) -> Any:
    selves = [
        Own(it.id, 0.0, 0.0, 0.0, 0.0, False, it._make.max_speed, it._time_step, 0.0, it.fleet, it.briefing, NO_TRUTH)
        for it in buoys
    ]
    if not compiles():
        return PlainMinds(crew, seed, run, selves)
    from shoal.buoy.compiled import CompiledMinds

    return CompiledMinds(crew, seed, run, selves)


# Of the world's formulas, the plain functions: one number takes longer to hand to compiled code than to work out.
_first_degree, _degree_of, _homeward = plain(first_degree), plain(degree_of), plain(homeward)
_maneuvered, _speed_scale = plain(maneuvered), plain(speed_scale)
