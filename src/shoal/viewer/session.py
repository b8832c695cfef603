"""A session: one run, or two side by side, that is played, paused, sought and changed. No threads, no network."""

from collections.abc import Callable, Sequence

from shoal.core.errors import ScenarioError
from shoal.run.simulate import chunk_steps
from shoal.scenario.crew import crew_of
from shoal.scenario.schema import Scenario
from shoal.strategies import CATALOGUE
from shoal.viewer.frame import SCALARS, gauges_of
from shoal.viewer.live import LiveRun, Table
from shoal.viewer.requests import (
    FASTEST,
    SLOWEST,
    Add,
    Change,
    Drag,
    Kill,
    Pause,
    Play,
    Request,
    Restart,
    Seek,
    Speed,
    Step,
)
from shoal.viewer.ring import Kept, Ring
from shoal.viewer.scene import as_json, describe

SPEEDS = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
ROOM = 64_000_000  # bytes of frames that can be sought
POINTS = 300  # of the charts that a new page begins with
FRAMES_PER_SECOND = 25  # at least, where the speed allows; at most twice as many
STRIDES = (1, 2, 4, 5, 8, 10, 20, 25, 40, 50, 100, 125, 200, 250, 500, 1000)  # steps between frames: they divide 1,000


class Session:
    """Runs of raw scenario tables, in step with each other.

    Parameters
    ----------
    tables : one, or two to compare; their seeds and time-steps are the same
    names : what errors call them
    limit : no step is made from this one on; then nothing can be changed (of a run that is recorded)
    speed : times real time
    room : bytes of frames kept to go back to

    Attributes
    ----------
    shown : the frame that is shown
    playing, speed, busy : see docs/reference/view-protocol.md
    on_busy : called when `busy` changes, while the caller waits

    Raises
    ------
    ScenarioError, TrackError, StrategyError : what cannot run
    """

    def __init__(
        self,
        tables: Sequence[Table],
        *,
        names: Sequence[str] = (),
        limit: int | None = None,
        speed: float = 1.0,
        room: int = ROOM,
    ) -> None:
        if not SLOWEST <= speed <= FASTEST:
            raise ScenarioError("speed", f"is {speed:g}", f"give {SLOWEST:g} to {FASTEST:g} times real time")
        where = [*names, *("scenario" for _ in tables)]
        self.runs = [LiveRun(table, place, where=where[place]) for place, table in enumerate(tables)]
        self.time_step = self.runs[0].simulation.scenario.time_step
        for run in self.runs:
            if run.simulation.scenario.time_step != self.time_step:
                raise ScenarioError("time_step", "is not the same in both scenarios", "compare runs in step")
        self.limit = limit
        self.playing = True
        self.speed = speed
        self.busy: str | None = None
        self.on_busy: Callable[[], None] = lambda: None
        self._loaded = {run.simulation.crew.name for run in self.runs}
        self._ring = Ring(room)
        self._keep()

    @property
    def number(self) -> int:
        """Steps done."""
        return self.runs[0].simulation.number

    @property
    def done(self) -> bool:
        """Whether the limit is reached."""
        return self.limit is not None and self.number >= self.limit

    def hello(self) -> str:
        """The message that a page begins with."""
        owners = [run.simulation.scenario.strategy.owner for run in self.runs]
        known = {each.name: each for each in (*CATALOGUE.values(), *owners)}
        return as_json(
            {
                "type": "hello",
                "runs": len(self.runs),
                "recording": self.limit is not None,
                "speeds": SPEEDS,
                "strategies": [describe(known[name]) for name in sorted(known)],
            }
        )

    def status(self) -> str:
        """The message about where it stands."""
        return as_json(
            {
                "type": "status",
                "playing": self.playing,
                "speed": self.speed,
                "step": self.shown.step,
                "first": self._ring.oldest.step,
                "last": self._ring.newest.step,
                "at_end": self.shown is self._ring.newest,
                "busy": self.busy,
            }
        )

    def history(self) -> list[str]:
        """For each run the message that fills a new page's charts; may be called from any thread."""
        kept = self._ring.spread(POINTS)
        return [history_of(run, kept) for run in range(len(self.runs))]

    def play_on(self) -> float:
        """Run to the next frame of the speed, keep it, show it; return how long it lasts [s]."""
        begin, stride = self.number, self.stride()
        over = min((run.ends for run in self.runs if run.ends is not None and run.ends > begin), default=None)
        until = begin - begin % stride + stride
        self._advance(until if over is None else min(until, over))
        if self.done or self.number == over:  # where a recorded track is over, time stops once
            self.playing = False
        return (self.number - begin) * self.time_step / self.speed

    def stride(self) -> int:
        """Steps between frames: as many as the speed asks for, and no more than the engine does in a moment."""
        wanted = self.speed / self.time_step / FRAMES_PER_SECOND
        possible = max(1, chunk_steps(max(run.simulation.scenario.agents for run in self.runs)))
        return max(stride for stride in STRIDES if stride <= max(1.0, min(wanted, possible)))

    def obey(self, request: Request) -> None:
        """Do what a page asks for.

        Raises
        ------
        ScenarioError, StrategyError : it cannot be done; then nothing has changed
        """
        match request:
            case Play():
                self.shown = self._ring.newest
                self.playing = not self.done
            case Pause():
                self.playing = False
            case Speed(value=value):
                self.speed = value
            case Seek(step=step):
                self.playing = False
                self.shown = self._ring.at(step)
            case Step(steps=steps):
                self.playing = False
                self._step(steps)
            case _:
                self._alter(request)

    def _step(self, steps: int) -> None:
        if steps > 0 and self.shown is self._ring.newest:
            self._advance(self.number + steps)
        else:
            self.shown = self._ring.beside(self.shown.step, steps)

    def _alter(self, request: Request) -> None:
        if self.limit is not None:
            raise ScenarioError("request", "nothing can be changed while a record is written", "watch without --out")
        match request:
            case Restart(seed=seed):
                for run in self.runs:
                    run.restart(seed)
                self._ring.clear()
            case Change(run=place, changes=changes):
                run = self._run(place)
                self._warn_of_loading(run.scenario_with(changes)[1])
                try:
                    run.change(changes)
                finally:
                    self._set_busy(None)
            case Kill(run=place, agent=agent):
                self._run(place).kill(agent)
            case Add(run=place, fleet=fleet, x=x, y=y):
                self._run(place).add(fleet, x, y)
            case Drag(run=place, target=target, x=x, y=y):
                self._run(place).drag(target, x, y)
        self._keep()

    def _run(self, place: int) -> LiveRun:
        if not 0 <= place < len(self.runs):
            raise ScenarioError("run", f"is {place}", f"name one from 0 to {len(self.runs) - 1}")
        return self.runs[place]

    def _advance(self, until: int) -> None:
        last = until if self.limit is None else min(until, self.limit)
        for run in self.runs:
            run.advance(max(0, last - run.simulation.number))
        self._keep()

    def _keep(self) -> None:
        """Keep the current frame, and show it."""
        scenes = tuple(run.message for run in self.runs)
        self._ring.add(Kept(self.number, scenes, tuple(run.frame() for run in self.runs)))
        self.shown = self._ring.newest

    def _warn_of_loading(self, scenario: Scenario) -> None:
        name = crew_of(scenario).name
        if name not in self._loaded:
            self._set_busy(f"loading strategy {name!r}; the very first time it is compiled, for some 10 s")
            self._loaded.add(name)

    def _set_busy(self, sentence: str | None) -> None:
        if self.busy != sentence:
            self.busy = sentence
            self.on_busy()


def history_of(run: int, kept: Sequence[Kept]) -> str:
    """The message that fills the charts of a run with some of its frames."""
    gauges = [gauges_of(each.frames[run]) for each in kept]
    return as_json(
        {
            "type": "history",
            "run": run,
            "step": [each.step for each in kept],
            **{name: [getattr(each, name) for each in gauges] for name in SCALARS},
        }
    )
