"""What runs on one computer: some buoys, a mesh, and a tether to the sea that they are in."""

import time
from collections.abc import Sequence
from multiprocessing import AuthenticationError
from multiprocessing.connection import Client, Connection
from pathlib import Path
from typing import Any

from shoal.buoy.aboard import Aboard
from shoal.buoy.lockstep import Lockstep
from shoal.buoy.mesh import Peers
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.paced import Paced
from shoal.buoy.tether import Note, from_bytes
from shoal.buoy.trust import NOBODY, Trust, read_key
from shoal.buoy.zenoh_mesh import ZenohMesh, protocol_of
from shoal.core.errors import FleetError, MessageError
from shoal.scenario.load import Source, load

KEY = "SHOAL_FLEET_KEY"  # of the environment: what proves to the sea that a buoy is one of its own
_MEETING = 240.0  # seconds in which all nodes of a mesh find each other: many processes start slowly


def serve(scenario: Source, ids: Sequence[int], address: tuple[str, int], key: bytes, trust: Trust = NOBODY) -> None:
    """Run some buoys of a fleet until the sea that they are tied to says that it is over, or is gone.

    Parameters
    ----------
    scenario : of the whole swarm, the same as the sea's
    ids : which agents run here
    address : host and port of the sea
    key : what proves that they belong to it
    trust : whose orders they obey, and whom they hear

    Raises
    ------
    ScenarioError, StrategyError : as Buoy
    FleetError : there is no sea, it takes no such buoys, or the others are not found
    MissingExtraError : zenoh is not installed
    """
    scenario = load(scenario)
    command_key = read_key(trust.command_key) if trust.command_key else None
    protocol_of(trust.mesh_config)  # what is wrong with it is said now; and it is loaded before others wait for it
    where = f"{address[0]}:{address[1]}"
    try:
        connection = Client(address, authkey=key)
    except AuthenticationError:
        raise FleetError(where, "does not take this key", f"give the key of this fleet in ${KEY}") from None
    except (OSError, EOFError) as error:
        problem = f"cannot be reached: {getattr(error, 'strerror', None) or 'it does not answer as a sea does'}"
        raise FleetError(where, problem, "start the fleet first, and name its address") from None
    with connection:
        try:
            _say(connection, "hello", ids=list(ids), scenario=scenario.hash, seed=scenario.seed)
            welcome = _note(connection, where, "welcome")
            mesh = ZenohMesh(
                welcome["fleet"],
                str(min(ids)),
                connect=welcome["connect"],
                listen=welcome["listen"],
                blocks=welcome["period"] is None,  # by the clock nobody is waited for
                config=trust.mesh_config,
            )
            try:
                _say(connection, "listens", place=mesh.place)
                aboard = Aboard(scenario, ids, run=welcome["run"], max_age=welcome["max_age"])
                aboard.warm()
                if command_key:
                    aboard.orderbook = Orderbook(scenario, welcome["fleet"], command_key, time.time())
                _meet(mesh, welcome["nodes"], connection)
                _say(connection, "ready")
                _work(aboard, mesh, connection, welcome, scenario.agents)
            finally:
                mesh.close()
        except (EOFError, ConnectionError, BrokenPipeError):
            return  # the sea is gone, and the buoys in it
        except MessageError as error:
            raise FleetError(where, "is no sea of a fleet: " + error.args[1], "name the address of one") from None


def _work(
    aboard: Aboard, mesh: Peers, connection: "Connection[bytes, bytes]", welcome: dict[str, Any], agents: int
) -> None:
    driver: Lockstep | Paced
    if welcome["period"] is None:
        driver = Lockstep(aboard, mesh, connection)
    else:
        driver = Paced(aboard, mesh, connection, welcome["period"], agents)
    begun, spent = time.monotonic(), time.process_time()
    driver.run()
    facts = driver.facts() if isinstance(driver, Paced) else {}
    _say(
        connection,
        "bye",
        ids=list(aboard.ids),
        spent=time.process_time() - spent,
        seconds=time.monotonic() - begun,
        memory=_memory(),
        counts=dict(aboard.inbox.counts),
        foreign=aboard.inbox.foreign,
        orders=dict(aboard.orderbook.counts) if aboard.orderbook else {"unread": aboard.unread},
        **facts,
    )


def _meet(mesh: Peers, nodes: int, connection: "Connection[bytes, bytes]") -> None:
    """Join the mesh, and wait until all its nodes are there.

    Raises
    ------
    FleetError : they do not come
    EOFError, OSError : the sea is gone
    """
    begun = time.monotonic()
    mesh.join()
    while (there := mesh.alive()) < nodes:
        if time.monotonic() - begun > _MEETING:
            raise FleetError("mesh", f"has {there} of {nodes} nodes after {_MEETING:g} s", "see why the others end")
        if connection.poll(0.02):
            connection.recv_bytes()  # it says nothing now: it is gone


def _say(connection: "Connection[bytes, bytes]", word: str, **facts: Any) -> None:
    connection.send_bytes(Note(word, facts).to_bytes())


def _note(connection: "Connection[bytes, bytes]", where: str, word: str) -> dict[str, Any]:
    said = from_bytes(connection.recv_bytes())
    if isinstance(said, Note) and said.word == "refused":
        raise FleetError(where, str(said.facts.get("problem")), str(said.facts.get("fix")))
    if not isinstance(said, Note) or said.word != word:
        raise MessageError("tether", f"said something else than {word}", "connect buoys and seas only")
    return said.facts


def _memory() -> int:
    """The most memory that this process had [B], 0 where the system does not say."""
    try:
        lines = Path("/proc/self/status").read_text(encoding="ascii", errors="replace").splitlines()
    except OSError:
        return 0
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM:")), 0)
