"""The processes that buoys run in: started, tied to the sea, asked, watched and ended."""

import os
import queue
import secrets
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from multiprocessing import AuthenticationError
from multiprocessing.connection import Connection, Listener, wait
from pathlib import Path
from tempfile import TemporaryDirectory
from types import TracebackType
from typing import Any, Self

from shoal.buoy.attend import ORDERED
from shoal.buoy.mesh import Mesh
from shoal.buoy.named import buoys_of
from shoal.buoy.serve import KEY
from shoal.buoy.tether import Commands, Note, Tick, from_bytes
from shoal.buoy.trust import NOBODY, Trust
from shoal.buoy.zenoh_mesh import ZenohMesh, protocol_of
from shoal.core.errors import FleetError, MessageError
from shoal.scenario.load import to_toml
from shoal.scenario.schema import Scenario

HOST = "127.0.0.1"
STARTING = 300.0  # seconds that a process has to start, compiling included
HELLO = 5.0  # seconds in which whoever comes says who it is
ASK_AGAIN = 2.0  # seconds without an answer after which a step is asked for again
PATIENCE = 30.0  # and after which a process that does not answer is ended


class Tied:
    """One process of buoys: which, and the connection to it."""

    def __init__(self, ids: tuple[int, ...], connection: "Connection[bytes, bytes]") -> None:
        self.ids = ids
        self.connection = connection

    def say(self, message: bytes) -> bool:
        """Send it something; False if it is gone."""
        try:
            self.connection.send_bytes(message)
        except OSError:
            return False
        return True


class Processes:
    """All buoys of a fleet in processes of this machine; use it as a context, at whose end all processes have ended.

    Parameters
    ----------
    scenario : of the fleet
    shares : which buoys are in one process each
    max_age : steps that a report may be old to be heard
    period : of a step on the clock [s]; None: lockstep
    plain : whether buoys decide without a compiler
    meanwhile : what else is done while they start
    trust : whose orders they obey, and whom they hear

    Attributes
    ----------
    tied : the processes that are there
    mesh : that of the buoys, at which nobody listens here
    heed : called with what buoys say of orders

    Raises
    ------
    MissingExtraError : zenoh is not installed
    FleetError : a process cannot start
    """

    def __init__(
        self,
        scenario: Scenario,
        shares: Sequence[Sequence[int]],
        *,
        max_age: int = 0,
        period: float | None = None,
        plain: bool = False,
        meanwhile: Callable[[], object] | None = None,
        trust: Trust = NOBODY,
    ) -> None:
        self.tied: list[Tied] = []
        self._meanwhile = meanwhile
        self.gone: list[Tied] = []
        self._scenario = scenario
        self._shares = [tuple(each) for each in shares]
        self._plain = plain
        self._started: dict[tuple[int, ...], subprocess.Popen[bytes]] = {}
        self._arrived: queue.Queue[Any] = queue.Queue()
        self._trust = trust
        self.heed: Callable[[dict[str, Any]], None] = lambda facts: None
        self._together = False
        anywhere = f"{protocol_of(trust.mesh_config)}/{HOST}:0"
        name = f"shoal/{secrets.token_hex(4)}"
        mesh = ZenohMesh(name, "sea", listen=anywhere, config=trust.mesh_config, hears=False)
        mesh.join()
        self.mesh: Mesh = mesh
        self._places = [mesh.place]  # where all listen so far: whoever comes connects to them
        self._folder = TemporaryDirectory(prefix="shoal-fleet-")
        self._key = secrets.token_hex(32)
        self._listener = Listener((HOST, 0), authkey=bytes.fromhex(self._key), backlog=max(16, len(self._shares)))
        self._welcome = {
            "fleet": name,
            "listen": anywhere,
            "nodes": len(self._shares) + 1,
            "run": 0,
            "max_age": max_age,
            "period": period,
        }

    def __enter__(self) -> Self:
        try:
            file = Path(self._folder.name) / "fleet.toml"
            file.write_text(to_toml(self._scenario), encoding="utf-8")
            threading.Thread(target=self._accept, daemon=True).start()
            for ids in self._shares:
                self._started[ids] = self._start(file, ids)
            if self._meanwhile:
                self._meanwhile()
            self._gather()
        except BaseException:
            self.__exit__(None, None, None)
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            self._end()
        except KeyboardInterrupt:  # a second one: nothing may be left running
            self._end()
            raise

    def _end(self) -> None:
        for process in self._started.values():
            process.kill()  # whoever was asked to end has; nobody keeps anything
        for process in self._started.values():
            process.wait()
        for tied in [*self.tied, *self.gone]:
            tied.connection.close()
        self._listener.close()
        self.mesh.close()
        self._folder.cleanup()

    @property
    def pids(self) -> dict[tuple[int, ...], int]:
        """The number that the system gave the process of some buoys."""
        return {ids: process.pid for ids, process in self._started.items()}

    @property
    def address(self) -> str:
        """Where one of the buoys listens."""
        return self._places[1]

    def ask(self, tick: Tick) -> tuple[list[Commands], list[int]]:
        """Let all buoys begin a step in lockstep: what they want, and who was lost meanwhile."""
        awaited = {tied: tick.of(tied.ids) for tied in self.tied}
        answers: list[Commands] = []
        lost = [id for tied, part in awaited.items() if not tied.say(part.to_bytes()) for id in self._lose(tied)]
        begun = asked = time.monotonic()
        while awaited and not lost:
            ready = wait([tied.connection for tied in awaited], timeout=ASK_AGAIN)
            for tied in [tied for tied in awaited if tied.connection in ready]:
                said = self.receive(tied)
                if said is None:
                    lost += self._lose(tied)
                elif isinstance(said, Commands) and said[:2] == tick[:2]:
                    answers.append(said)
                    del awaited[tied]
            now = time.monotonic()
            if now - begun > PATIENCE:
                lost += [id for tied in awaited for id in self.kill(tied)]
            elif now - asked > ASK_AGAIN:
                asked = now
                for tied in self.tied:  # all: whose report is missing has perhaps answered
                    tied.say(tick.of(tied.ids).to_bytes())
        return answers, lost

    def receive(self, tied: Tied) -> Commands | Note | Tick | None:
        """What a process says; None if it is gone, or says what is no message."""
        try:
            said = from_bytes(tied.connection.recv_bytes())
        except (EOFError, OSError, MessageError):
            return None
        if isinstance(said, Note) and said.word == ORDERED:
            self.heed(said.facts)
        return said

    def lose(self, tied: Tied) -> list[int]:
        """Take a process that is gone off the list; return its buoys."""
        return self._lose(tied)

    def kill(self, tied: Tied) -> list[int]:
        """End a process at once, without asking it; return its buoys."""
        process = self._started.get(tied.ids)
        if process is not None:
            process.kill()
            process.wait()
        return self._lose(tied)

    def of(self, id: int) -> Tied | None:
        """The process of a buoy, if it is there."""
        return next((tied for tied in self.tied if id in tied.ids), None)

    def finish(self) -> list[dict[str, Any]]:
        """Let all processes end; return what each measured."""
        over = Note("over", {}).to_bytes()
        waiting = [tied for tied in self.tied if tied.say(over)]
        until = time.monotonic() + 5.0
        facts = []
        while waiting and time.monotonic() < until:
            ready = wait([tied.connection for tied in waiting], timeout=0.5)
            for tied in [tied for tied in waiting if tied.connection in ready]:
                said = self.receive(tied)
                if said is None or (isinstance(said, Note) and said.word == "bye"):
                    waiting.remove(tied)
                    facts += [said.facts] if isinstance(said, Note) else []
        return facts

    def last_words(self) -> list[str]:
        """What processes said that ended by an error of their own, a sentence each.

        Raises
        ------
        FleetError : nobody is left, and all ended so: what the first said
        """
        found = []
        for tied in self.gone:
            said, fix = self.words(tied.ids)
            if said and self._started[tied.ids].wait() > 0:
                if not self.tied:
                    raise FleetError(f"buoy {tied.ids[0]}", said, fix or "correct it")
                found.append(f"{buoys_of(tied.ids)} ended: {said}")
        return found

    def _lose(self, tied: Tied) -> list[int]:
        if tied in self.tied:
            self.tied.remove(tied)
            self.gone.append(tied)
            if not self.tied:
                self.last_words()
        return list(tied.ids)

    def _start(self, file: Path, ids: tuple[int, ...]) -> "subprocess.Popen[bytes]":
        host, port = self._listener.address[:2]
        command = [sys.executable, "-m", "shoal", "buoy", str(file), "--id", ",".join(map(str, ids))]
        command += ["--connect", f"{host}:{port}", *(["--plain"] if self._plain else [])]
        for option, place in (("--command-key", self._trust.command_key), ("--mesh-config", self._trust.mesh_config)):
            command += [option, str(place)] if place else []
        root = str(Path(__file__).resolve().parents[2])
        paths = [root, *filter(None, [os.environ.get("PYTHONPATH")])]
        about = {**os.environ, KEY: self._key, "PYTHONPATH": os.pathsep.join(paths), "OPENBLAS_NUM_THREADS": "1"}
        errors = (Path(self._folder.name) / f"errors-{ids[0]}").open("wb")
        with errors:
            return subprocess.Popen(
                command,
                env=about,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                start_new_session=True,  # Ctrl-C is for us: we end them
            )

    def _accept(self) -> None:
        while True:
            try:
                self._arrived.put(self._listener.accept())
                if self._together:
                    self._refuse_all()
            except (AuthenticationError, EOFError, ConnectionError):
                continue  # a stranger
            except OSError:
                return  # closed

    def _gather(self) -> None:
        """Wait until every process is tied, knows its mesh and is ready.

        Raises
        ------
        FleetError : one ended instead, or takes too long
        """
        until = time.monotonic() + STARTING
        while len(self.tied) < len(self._shares):
            self._check_start(until)
            with suppress(queue.Empty):
                self._greet(self._arrived.get(timeout=0.1), until)
        self._together = True
        self._refuse_all()
        waiting = list(self.tied)
        while waiting:
            self._check_start(until)
            ready = wait([tied.connection for tied in waiting], timeout=0.1)
            for tied in [tied for tied in waiting if tied.connection in ready]:
                said = self.receive(tied)
                if isinstance(said, Note) and said.word == "ready":
                    waiting.remove(tied)
                elif said is None:
                    raise self._failed(tied.ids)

    def _greet(self, connection: "Connection[bytes, bytes]", until: float) -> None:
        """Let a process listen at the mesh, connected to all who do so already."""
        try:
            hello = from_bytes(connection.recv_bytes())
            if not isinstance(hello, Note) or hello.word != "hello":
                raise MessageError("tether", "begins without hello", "connect buoys only")
            ids = tuple(map(int, hello.facts["ids"]))
            same = hello.facts["scenario"] == self._scenario.hash and hello.facts["seed"] == self._scenario.seed
            if ids not in self._shares or any(tied.ids == ids for tied in self.tied) or not same:
                _refuse(connection, "has no such buoys left" if same else "is of another scenario or seed")
                return
            connection.send_bytes(Note("welcome", {**self._welcome, "connect": self._places}).to_bytes())
            while not connection.poll(0.1):
                self._check_start(until)
            listens = from_bytes(connection.recv_bytes())
            if not isinstance(listens, Note) or listens.word != "listens":
                raise MessageError("tether", "says something else than where it listens", "connect buoys only")
            self._places.append(str(listens.facts["place"]))
            self.tied.append(Tied(ids, connection))
        except (MessageError, EOFError, OSError, KeyError, TypeError, ValueError):
            connection.close()

    def _refuse_all(self) -> None:
        """Send away who comes when all are there."""
        with suppress(queue.Empty):
            while True:
                with self._arrived.get_nowait() as connection, suppress(EOFError, OSError):
                    if connection.poll(HELLO):
                        connection.recv_bytes()  # what is closed unread takes the refusal with it
                    _refuse(connection, "has all its buoys")

    def _check_start(self, until: float) -> None:
        for ids, process in self._started.items():
            if process.poll() is not None:
                raise self._failed(ids)
        if time.monotonic() > until:
            raise FleetError("fleet", f"is not together after {STARTING:g} s", "use fewer processes, or --plain")

    def _failed(self, ids: tuple[int, ...]) -> FleetError:
        """The error of a process that ended, in its own words if it said any."""
        code = self._started[ids].wait()
        said, fix = self.words(ids)
        problem = f"ended before the fleet was together: {said or f'with code {code}, and no word'}"
        return FleetError(f"buoy {ids[0]}", problem, fix or "see what ended it")

    def words(self, ids: tuple[int, ...]) -> tuple[str, str]:
        """What a process said last on stderr, and how it is to be mended; empty if it said nothing."""
        text = (Path(self._folder.name) / f"errors-{ids[0]}").read_text(encoding="utf-8", errors="replace")
        lines = [line.strip().removeprefix("shoal: ") for line in text.splitlines() if line.strip()]
        for number in range(len(lines) - 1, 0, -1):
            if lines[number].startswith("fix: "):
                return lines[number - 1], lines[number].removeprefix("fix: ")
        return (lines[-1] if lines else ""), ""


def _refuse(connection: "Connection[bytes, bytes]", problem: str) -> None:
    facts = {"problem": problem, "fix": "give all buoys the scenario and ids of the fleet, each id once"}
    connection.send_bytes(Note("refused", facts).to_bytes())
