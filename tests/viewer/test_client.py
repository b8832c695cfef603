"""One page at the other end: it gets the newest, and what it says is checked."""

import asyncio
import json

from frames import decode
from shoal.scenario.load import read_table
from shoal.viewer.client import BURST, NONSENSE, UNHEARD, Client
from shoal.viewer.session import Session
from shoal.viewer.worker import View, Worker


class Socket:
    """A WebSocket whose other end takes binary messages only while `open_` is set."""

    def __init__(self, *said):
        self.said = list(said)
        self.texts, self.frames, self.closed = [], [], None
        self.open_ = asyncio.Event()
        self.open_.set()
        self.gone = asyncio.Event()

    async def accept(self):
        """Nothing to do."""

    async def send_text(self, text):
        await self.open_.wait()
        self.texts.append(json.loads(text))

    async def send_bytes(self, data):
        await self.open_.wait()
        self.frames.append(decode(data))

    async def receive(self):
        if self.said:
            return {"type": "websocket.receive", "text": self.said.pop(0)}
        await self.gone.wait()
        return {"type": "websocket.disconnect"}

    async def close(self, code, reason=""):
        self.closed = code


def idle():
    """A worker whose thread is not started: the test is its engine."""
    return Worker(Session([read_table("oceans2020")]))


def engine_makes(worker, frames):
    session = worker.session
    for _ in range(frames):
        session.play_on()
        worker.view = View(session.shown, session.status())
        for watcher in list(worker._watchers):
            watcher.changed()


async def a_moment():
    for _ in range(20):
        await asyncio.sleep(0)


def talk(worker, script, *said):
    """Serve a page while `script(socket)` goes on; return its socket."""

    async def both():
        socket = Socket(*said)
        serving = asyncio.create_task(Client(socket, worker).serve())
        await a_moment()
        await script(socket)
        socket.open_.set()
        await a_moment()
        socket.gone.set()
        await serving
        return socket

    return asyncio.run(both())


async def nothing(socket):
    """Wait and see."""


class TestTelling:
    def test_hello_history_scene_frame_status_in_this_order(self):
        socket = talk(idle(), nothing)
        assert [each["type"] for each in socket.texts] == ["hello", "history", "scene", "numbers", "status"]
        assert [frame.step for frame in socket.frames] == [0]

    def test_a_page_that_is_slow_skips_to_the_newest(self):
        worker = idle()

        async def sleepy(socket):
            socket.open_.clear()
            engine_makes(worker, 30)
            await a_moment()

        socket = talk(worker, sleepy)
        assert [frame.step for frame in socket.frames] in ([0, 30], [0, 1, 30])

    def test_a_page_that_keeps_up_gets_every_frame(self):
        worker = idle()

        async def quick(socket):
            for _ in range(5):
                engine_makes(worker, 1)
                await a_moment()

        assert [frame.step for frame in talk(worker, quick).frames] == [0, 1, 2, 3, 4, 5]

    def test_the_scene_comes_again_only_when_it_changes(self):
        worker = idle()

        async def change(socket):
            engine_makes(worker, 1)
            await a_moment()
            worker.session.runs[0].change({"neighbors": 5})
            engine_makes(worker, 1)
            await a_moment()

        socket = talk(worker, change)
        assert [each["scene"]["epoch"] for each in socket.texts if each["type"] == "scene"] == [0, 1]
        assert [frame.epoch for frame in socket.frames] == [0, 0, 1]

    def test_who_left_is_forgotten(self):
        worker = idle()
        talk(worker, nothing)
        assert not worker._watchers


class TestHearing:
    def test_a_page_that_does_not_listen_is_not_told_of_all_its_errors(self):
        async def both():
            socket = Socket()
            client = Client(socket, idle())
            serving = asyncio.create_task(client.serve())
            await a_moment()
            socket.open_.clear()
            for number in range(3 * UNHEARD):
                client._fail(str(number))
            socket.open_.set()
            for _ in range(5):
                await a_moment()
            socket.gone.set()
            await serving
            return socket

        told = [each["message"] for each in asyncio.run(both()).texts if each["type"] == "error"]
        assert told == [str(number) for number in range(2 * UNHEARD, 3 * UNHEARD)]

    def test_nonsense_is_answered(self):
        socket = talk(idle(), nothing, "nonsense")
        assert [each["message"][:8] for each in socket.texts if each["type"] == "error"] == ["request:"]
        assert socket.closed is None

    def test_repeated_nonsense_is_not_listened_to(self):
        socket = talk(idle(), nothing, *["nonsense"] * (NONSENSE + 5))
        assert socket.closed == 1008
        assert len(socket.said) == 4

    def test_a_page_that_asks_without_end_is_not_listened_to(self):
        worker = idle()
        socket = talk(worker, nothing, *['{"do": "speed", "value": 2.0}'] * (BURST + 1000))
        assert socket.closed == 1008
        assert socket.said  # which nobody reads any more
        assert worker._asked.full()

    def test_sense_is_passed_on(self):
        worker = idle()
        talk(worker, nothing, '{"do": "pause"}', '{"do": "step"}')
        assert worker._asked.qsize() == 2
