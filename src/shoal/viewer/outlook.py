"""The outlook on a fleet that runs by itself: its frames to look at and to go back to, and no way to change it."""

from threading import Lock

from shoal.core.errors import ScenarioError, ShoalError
from shoal.viewer.bulletin import Bulletin
from shoal.viewer.requests import Pause, Play, Request, Seek, Step
from shoal.viewer.ring import Kept, Ring
from shoal.viewer.scene import as_json
from shoal.viewer.sent import history_of
from shoal.viewer.session import POINTS, ROOM
from shoal.viewer.worker import View, Watcher


class Outlook:
    """Shows pages what is heard of a fleet; may be used from any thread.

    Parameters
    ----------
    room : bytes of frames kept to go back to

    Attributes
    ----------
    hello : the message that a page begins with
    view : the newest, replaced as a whole
    """

    def __init__(self, room: int = ROOM) -> None:
        about = {"type": "hello", "runs": 1, "recording": False, "fleet": True, "speeds": [], "strategies": []}
        self.hello = as_json(about)
        self._lock = Lock()
        self._watchers: set[Watcher] = set()
        self._ring = Ring(room)
        self._shown = Kept(0, (), ())
        self._scene = ""
        self._playing = True
        self._over = False
        self._speed: float | None = None
        self._busy: str | None = None
        self._show()

    def hear(self, bulletin: Bulletin) -> None:
        """Show what a fleet says from now on."""
        with self._lock:
            scene = as_json({"type": "scene", "run": 0, "scene": bulletin.scene})
            self._scene = self._scene if scene == self._scene else scene  # the same object: pages get it once
            self._speed, self._busy = bulletin.speed, bulletin.busy
            if not bulletin.frame:
                self._shown = Kept(0, (self._scene,), ())
            elif not len(self._ring) or bulletin.step > self._ring.newest.step:
                self._ring.add(Kept(bulletin.step, (self._scene,), (bulletin.frame,)))
                self._shown = self._ring.newest if self._playing else self._shown
            self._show()

    def end(self, sentence: str) -> None:
        """Nothing more will be heard, for a reason."""
        with self._lock:
            self._over, self._playing, self._busy = True, False, sentence
            self._show()

    def history(self) -> list[str]:
        """The message that fills a new page's charts."""
        return [history_of(0, self._ring.spread(POINTS))]

    def watch(self, watcher: Watcher) -> None:
        """Tell a watcher of everything from now on."""
        with self._lock:
            self._watchers.add(watcher)

    def leave(self, watcher: Watcher) -> None:
        """Tell it nothing more."""
        with self._lock:
            self._watchers.discard(watcher)

    def ask(self, request: Request, watcher: Watcher) -> None:
        """Do what a page asks for; the watcher hears if it is refused."""
        try:
            with self._lock:
                self._obey(request)
                self._show()
        except ShoalError as error:
            watcher.failed(str(error))

    def _obey(self, request: Request) -> None:
        if not isinstance(request, (Play, Pause, Seek, Step)):
            raise ScenarioError(
                "request", "the buoys of a fleet decide by themselves", "use shoal watch to change a run"
            )
        if not len(self._ring):
            return
        self._playing = isinstance(request, Play) and not self._over
        match request:
            case Play():
                self._shown = self._ring.newest
            case Seek(step=step):
                self._shown = self._ring.at(step)
            case Step(steps=steps):
                self._shown = self._ring.beside(self._shown.step, steps)

    def _show(self) -> None:
        """Let pages see how it is; the caller has the lock."""
        kept = len(self._ring) > 0
        status = {
            "type": "status",
            "playing": self._playing,
            "speed": self._speed,
            "step": self._shown.step,
            "first": self._ring.oldest.step if kept else 0,
            "last": self._ring.newest.step if kept else 0,
            "at_end": not kept or self._shown is self._ring.newest,
            "busy": self._busy,
        }
        self.view = View(self._shown, as_json(status))
        for watcher in self._watchers:
            watcher.changed()
