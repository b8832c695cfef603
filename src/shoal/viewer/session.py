"""A session: one run, or two side by side, that is played, paused, sought and changed. No threads, no network."""

from collections.abc import Callable, Sequence

from shoal.core.errors import ScenarioError
from shoal.run.change_log import ChangeLog
from shoal.run.changes import Restart
from shoal.run.settings import Table
from shoal.run.simulate import chunk_steps
from shoal.strategies import CATALOGUE
from shoal.viewer.live import LiveRun
from shoal.viewer.requests import FASTEST, SLOWEST, Export, Pause, Play, Request, Seek, Speed, Step
from shoal.viewer.ring import Kept, Ring
from shoal.viewer.scene import as_json, describe
from shoal.viewer.sent import file_of, history_of, words_at_end
from shoal.viewer.steersman import Steersman

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
    limit : no step is made from this one on (of a run that is recorded)
    script : a log whose changes are made when their steps come; until its end nobody else can change anything
    speed : times real time
    room : bytes of frames kept to go back to

    Attributes
    ----------
    shown : the frame that is shown
    playing, speed, busy, ended : see docs/reference/view-protocol.md
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
        script: ChangeLog | None = None,
        speed: float = 1.0,
        room: int = ROOM,
    ) -> None:
        if not SLOWEST <= speed <= FASTEST:
            raise ScenarioError("speed", f"is {speed:g}", f"give {SLOWEST:g} to {FASTEST:g} times real time")
        where = [*names, *("scenario" for _ in tables)]
        recorded = limit is not None
        self.runs = [LiveRun(table, n, where=where[n], recorded=recorded) for n, table in enumerate(tables)]
        self.time_step = self.runs[0].simulation.scenario.time_step
        for run in self.runs:
            if run.simulation.scenario.time_step != self.time_step:
                raise ScenarioError("time_step", "is not the same in both scenarios", "compare runs in step")
        self.limit = limit
        self.playing = True
        self.speed = speed
        self.busy: str | None = None
        self.ended: str | None = None
        self.on_busy: Callable[[], None] = lambda: None
        self.steersman = Steersman(self.runs, where, script, self._set_busy)
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
                "ended": self.ended,
                "complete": self.done,
                "script": self.steersman.script_end,
                "changes": self.steersman.changes,
            }
        )

    def history(self) -> list[str]:
        """For each run the message that fills a new page's charts; may be called from any thread."""
        kept = self._ring.spread(POINTS)
        return [history_of(run, kept) for run in range(len(self.runs))]

    def play_on(self) -> float:
        """Run to the next frame of the speed, keep it, show it; return how long it lasts [s]."""
        begin, stride = self.number, self.stride()
        self._advance(self._pausing_at(begin - begin % stride + stride))
        if self.done:
            self.playing = False
        return max(0, self.number - begin) * self.time_step / self.speed

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
            case Export():
                raise ScenarioError("request", "is answered to whoever asks", "ask the worker")
            case _:
                if self.done:
                    raise ScenarioError("request", "the record is complete", "watch without --out to go on")
                self.steersman.obey(request)
                self._keep(anew=isinstance(request, Restart))

    def export(self, request: Export) -> str:
        """The message that brings a page the text of a file.

        Raises
        ------
        ScenarioError : there is no such run
        """
        return file_of(request, self.steersman.run(request.run), self.steersman.log)

    def _step(self, steps: int) -> None:
        if steps > 0 and self.shown is self._ring.newest:
            self._advance(self.number + steps)
        else:
            self.shown = self._ring.beside(self.shown.step, steps)

    def _advance(self, until: int) -> None:
        restarted = self.steersman.advance(until if self.limit is None else min(until, self.limit))
        if self.steersman.end_script():
            self.playing = False
        self._keep(anew=restarted)

    def _pausing_at(self, until: int) -> int:
        """Until where to play: where a log or a recorded track ends, time stops once."""
        ends = [self.steersman.stop_of_script(), *(run.ends for run in self.runs)]
        stop = min((each for each in ends if each is not None and self.number < each <= until), default=None)
        if stop is None:
            return until
        self.playing = False
        return stop

    def _keep(self, anew: bool = False) -> None:
        """Keep the current frame, and show it; `anew`: those before it were of a run that is over."""
        if anew:
            self._ring.clear()
            self.ended = None
        self._tell_of_end()
        scenes = tuple(run.message for run in self.runs)
        frames = tuple(run.frame() for run in self.runs)
        self._ring.add(Kept(self.number, scenes, frames, tuple(run.numbers() for run in self.runs)))
        self.shown = self._ring.newest

    def _tell_of_end(self) -> None:
        """Say the total once all recorded tracks have ended."""
        ends = [run.ends for run in self.runs]
        if self.ended is None and all(end is not None and end <= self.number for end in ends):
            self.ended = " ".join(words_at_end(run) for run in self.runs)

    def _set_busy(self, sentence: str | None) -> None:
        if self.busy != sentence:
            self.busy = sentence
            self.on_busy()
