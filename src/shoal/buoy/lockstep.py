"""Buoys in lockstep: a step is done when the reports of all who are there have arrived, however long that takes."""

from multiprocessing.connection import Connection

from shoal.buoy.aboard import Aboard
from shoal.buoy.attend import attend
from shoal.buoy.mesh import Mesh
from shoal.buoy.tether import BEGIN, Commands, Note, Tick, from_bytes

_LOOK = 0.05  # seconds between two looks at the tether while reports are awaited


class Lockstep:
    """Answers ticks with commands.

    Parameters
    ----------
    aboard : the buoys; mesh : that carries their reports; connection : to the sea
    """

    def __init__(self, aboard: Aboard, mesh: Mesh, connection: "Connection[bytes, bytes]") -> None:
        self._aboard = aboard
        self._mesh = mesh
        self._connection = connection
        self._answer: Commands | None = None

    def run(self) -> Note:
        """Answer until the sea says something else, and return that.

        Raises
        ------
        EOFError, OSError : the sea is gone
        MessageError : the sea says what is no message
        """
        tick = self._next()
        while isinstance(tick, Tick):
            later = self._answered(tick)
            tick = later or self._next()
        assert isinstance(tick, Note)
        return tick

    def _next(self) -> Tick | Note | Commands:
        return from_bytes(self._connection.recv_bytes())

    def _answered(self, tick: Tick) -> Tick | Note | Commands | None:
        """Answer a tick; return what the sea said meanwhile, if it did not wait for the answer."""
        aboard = self._aboard
        if tick.turn == BEGIN:
            self._send(aboard.begin(tick))
            return None
        asked_again = self._answer is not None and self._answer[:2] == tick[:2]
        if self._answer is not None and self._answer.step == tick.step and not asked_again:
            aboard.undo()
            self._answer = None
        for report in aboard.speak(tick):  # again where it is asked again: what was sent may not have arrived
            self._mesh.publish(report)
        if asked_again and self._answer is not None:
            self._send(self._answer)
            return None
        aboard.hear(self._mesh.take(0.0), tick.step)
        while aboard.missing(tick):
            aboard.hear(self._mesh.take(_LOOK), tick.step)
            if self._connection.poll(0):
                return self._next()
        attend(aboard, self._mesh, self._connection, tick)
        aboard.mark(tick)
        self._send(aboard.act(tick))
        return None

    def _send(self, answer: Commands) -> None:
        self._answer = None if answer.turn == BEGIN else answer
        self._connection.send_bytes(answer.to_bytes())
