"""The thread that runs a session: it keeps time, obeys requests between frames, and waits for no watcher."""

import threading
import time
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, Full, Queue
from typing import NamedTuple

from shoal.core.errors import ShoalError
from shoal.core.waiting import wait_for
from shoal.viewer.requests import Export, Request
from shoal.viewer.ring import Kept
from shoal.viewer.session import Session

PATIENCE = 0.25  # [s] time that is not made up for when the engine cannot keep the speed
WAITING = 256  # requests in the queue, at most
AT_ONCE = 8  # requests that are obeyed before a frame that is due


class View(NamedTuple):
    """What every page should see now: the frame shown, and the status message."""

    kept: Kept
    status: str


class Watcher(NamedTuple):
    """What hears, from the worker's thread, that `view` has changed; that something failed; a file it asked for."""

    changed: Callable[[], None]
    failed: Callable[[str], None]
    sent: Callable[[str], None] = lambda message: None


class _Asked(NamedTuple):
    request: Request
    watcher: Watcher


def next_due(due: float, now: float, lasts: float) -> float:
    """When the frame that comes is due [s], after one that was due and lasts so long; long delays are forgiven."""
    return max(due, now - PATIENCE) + lasts


class Worker:
    """Runs a session in a thread of its own while it is a context.

    Attributes
    ----------
    hello : the message that a page begins with
    view : the newest, replaced as a whole
    on_done : called once in the thread when the session's limit is reached
    """

    def __init__(self, session: Session, on_done: Callable[[], None] = lambda: None) -> None:
        self.session = session
        self.hello = session.hello()
        self.view = View(session.shown, session.status())
        self._on_done = on_done
        self._asked: Queue[_Asked | None] = Queue(WAITING)
        self._watchers: set[Watcher] = set()
        self._lock = threading.Lock()
        self._ended = threading.Event()
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="shoal-engine")
        session.on_busy = self._publish

    def __enter__(self) -> "Worker":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        with suppress(Full):
            self._asked.put_nowait(None)  # wakes it up
        self._thread.join()

    def history(self) -> list[str]:
        """For each run the message that fills a new page's charts."""
        return self.session.history()

    def wait(self) -> None:
        """Wait until the thread ends; raise what ended it."""
        wait_for(self._ended)
        if self._error:
            raise self._error

    def watch(self, watcher: Watcher) -> None:
        """Tell a watcher of everything from now on."""
        with self._lock:
            self._watchers.add(watcher)

    def leave(self, watcher: Watcher) -> None:
        """Tell it nothing more."""
        with self._lock:
            self._watchers.discard(watcher)

    def ask(self, request: Request, watcher: Watcher) -> None:
        """Queue a request; the watcher hears if it is refused."""
        try:
            self._asked.put_nowait(_Asked(request, watcher))
        except Full:
            watcher.failed("request: the engine is busy\n  fix: wait a moment")

    def _run(self) -> None:
        try:
            self._keep_time()
        except BaseException as error:  # a bug: whoever waits gets it
            self._error = error
        finally:
            self._ended.set()

    def _keep_time(self) -> None:
        due = time.monotonic()
        obeyed = 0  # since the last frame
        was_done = False
        while not self._ended.is_set():
            playing = self.session.playing
            try:
                if playing and obeyed >= AT_ONCE and time.monotonic() >= due:
                    raise Empty  # whoever asks without end holds nobody up
                asked = self._asked.get(timeout=max(0.0, due - time.monotonic()) if playing else None)
            except Empty:
                obeyed = 0
                due = next_due(due, time.monotonic(), self._play_on())
            else:
                obeyed += 1
                played = self.session.playing
                if asked:
                    self._obey(asked)
                if not played:
                    due = time.monotonic()
            if self.session.done and not was_done:
                was_done = True
                self._on_done()

    def _play_on(self) -> float:
        try:
            return self.session.play_on()
        except ShoalError as error:
            self.session.playing = False
            for watcher in self._everybody():
                watcher.failed(str(error))
            return 0.0
        finally:
            self._publish()

    def _obey(self, asked: _Asked) -> None:
        try:
            if isinstance(asked.request, Export):
                asked.watcher.sent(self.session.export(asked.request))
                return
            self.session.obey(asked.request)
        except ShoalError as error:
            asked.watcher.failed(str(error))
        self._publish()

    def _publish(self) -> None:
        self.view = View(self.session.shown, self.session.status())
        for watcher in self._everybody():
            watcher.changed()

    def _everybody(self) -> list[Watcher]:
        with self._lock:
            return list(self._watchers)
