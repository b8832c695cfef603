"""Orders on their way: from the mesh to the buoys here, on to others, and what came of them to the sea's log."""

import time
from multiprocessing.connection import Connection

from shoal.buoy.aboard import Aboard
from shoal.buoy.mesh import Mesh
from shoal.buoy.tether import Note, Tick

ORDERED = "ordered"  # the note that tells the sea


def attend(aboard: Aboard, mesh: Mesh, connection: "Connection[bytes, bytes]", tick: Tick) -> None:
    """Take orders that arrived, to be obeyed from the next step on, and pass them on.

    Raises
    ------
    OSError : the sea is gone
    """
    for data in aboard.attend(mesh.orders(0.0), tick, time.time()):
        mesh.order(data)
    book = aboard.orderbook
    if book is not None:
        for command in book.obeyed:
            connection.send_bytes(Note(ORDERED, {"command": command.model_dump(mode="json")}).to_bytes())
        for sentence in book.refused:
            connection.send_bytes(Note(ORDERED, {"refused": sentence}).to_bytes())
        book.obeyed.clear()
        book.refused.clear()
