"""One page at the other end of a WebSocket."""

import asyncio
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import Protocol

from starlette.websockets import WebSocket, WebSocketDisconnect

from shoal.viewer.requests import Request, RequestError, parse_request
from shoal.viewer.scene import as_json
from shoal.viewer.worker import View, Watcher

NONSENSE = 20  # malformed messages after which a page is disconnected
UNHEARD = 32  # error messages that wait for one page, at most
PACE = 0.005  # [s] between two requests that a page may ask for all the time: no hand is faster
BURST = 1000  # requests that it may be ahead of that; beyond, it is disconnected


class Show(Protocol):
    """What a page looks at: a worker with its session, or the outlook on a fleet."""

    hello: str
    view: View

    def history(self) -> list[str]:
        """For each run the message that fills a new page's charts."""

    def watch(self, watcher: Watcher) -> None:
        """Tell a watcher of everything from now on."""

    def leave(self, watcher: Watcher) -> None:
        """Tell it nothing more."""

    def ask(self, request: Request, watcher: Watcher) -> None:
        """Do what a page asks for; the watcher hears if it is refused."""


class Client:
    """One page: hears the newest that there is whenever it is ready for more, and asks.

    It may be as slow as it likes: what comes meanwhile is skipped, and nobody waits for it.
    """

    def __init__(self, socket: WebSocket, show: Show) -> None:
        self._socket = socket
        self._show = show
        self._news = asyncio.Event()
        self._nonsense = 0
        self._due = 0.0  # [s] of the loop's clock: when all that was heard would have come at its pace
        self._errors: deque[str] = deque(maxlen=UNHEARD)
        self._file: str | None = None  # asked for, and not sent yet
        loop = asyncio.get_running_loop()

        def changed() -> None:
            _call(loop, self._news.set)

        def failed(message: str) -> None:
            _call(loop, lambda: self._fail(message))

        def sent(message: str) -> None:
            _call(loop, lambda: self._send(message))

        self._watcher = Watcher(changed, failed, sent)

    async def serve(self) -> None:
        """Until the page is closed."""
        await self._socket.accept()
        self._show.watch(self._watcher)
        telling = asyncio.create_task(self._tell())
        try:
            await self._hear()
        finally:
            self._show.leave(self._watcher)
            telling.cancel()
            with suppress(asyncio.CancelledError, WebSocketDisconnect, RuntimeError):  # told after it was closed
                await telling
        if self._nonsense > NONSENSE:
            with suppress(WebSocketDisconnect, RuntimeError):  # it has left already
                await self._socket.close(1008, "too many requests, or messages that are none")

    async def _tell(self) -> None:
        await self._socket.send_text(self._show.hello)
        for history in self._show.history():
            await self._socket.send_text(history)
        scenes: tuple[str, ...] = ()
        kept = None
        self._news.set()
        while True:
            await self._news.wait()
            self._news.clear()
            while self._errors:
                await self._socket.send_text(as_json({"type": "error", "message": self._errors.popleft()}))
            if self._file is not None:
                file, self._file = self._file, None
                await self._socket.send_text(file)
            view = self._show.view
            for run, scene in enumerate(view.kept.scenes):
                if scene not in scenes[run : run + 1]:
                    await self._socket.send_text(scene)
            scenes = view.kept.scenes
            if view.kept is not kept:
                kept = view.kept
                for numbers in kept.numbers:
                    await self._socket.send_text(numbers)
                for frame in kept.frames:
                    await self._socket.send_bytes(frame)
            await self._socket.send_text(view.status)

    async def _hear(self) -> None:
        """Pass requests on; a page that sends nonsense gets an error, and is in the end disconnected."""
        while self._nonsense <= NONSENSE:
            message = await self._socket.receive()
            if message["type"] != "websocket.receive":
                return
            if self._asks_too_much():
                self._nonsense = NONSENSE + 1
                return
            try:
                text = message.get("text")
                request = parse_request(text if text is not None else message.get("bytes") or b"")
            except RequestError as error:
                self._nonsense += 1
                self._fail(str(error))
            else:
                self._show.ask(request, self._watcher)

    def _asks_too_much(self) -> bool:
        """Whether a page asks on and on, faster than anybody can."""
        now = asyncio.get_running_loop().time()
        self._due = max(self._due, now) + PACE
        return self._due > now + BURST * PACE

    def _send(self, file: str) -> None:
        self._file = file  # whoever asks again before the last one is sent gets the newest
        self._news.set()

    def _fail(self, message: str) -> None:
        self._errors.append(message)
        self._news.set()


def _call(loop: asyncio.AbstractEventLoop, function: Callable[[], None]) -> None:
    """Call in the loop's thread, unless the loop has ended."""
    try:
        loop.call_soon_threadsafe(function)
    except RuntimeError:
        return
