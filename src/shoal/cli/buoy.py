"""shoal buoy: what runs on one vehicle."""

import os
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger
from shoal.cli.output import tell

if TYPE_CHECKING:
    from shoal.buoy.trust import Trust

OF_A_BODY = ("listen", "sensor", "arm", "body-key", "wait", "out")


def buoy(
    scenario: str,
    /,
    *,
    id_: Annotated[str, Parameter(name="--id")],
    connect: str | None = None,
    body: str | None = None,
    listen: str | None = None,
    sensor: str | None = None,
    arm: Annotated[bool, Parameter(negative=())] = False,
    body_key: Path | None = None,
    wait: MaybeInteger = None,
    out: Path | None = None,
    plain: Annotated[bool, Parameter(negative=())] = False,
    command_key: Path | None = None,
    mesh_config: Path | None = None,
) -> None:
    """Run one buoy: on a vehicle of its own (`--body`), or in the stand-in sea of `shoal fleet`, there several, too.

    On a vehicle it ends when the scenario is over, or by Ctrl-C, which stops the vehicle.
    In a stand-in sea it ends when that does; the key of the fleet is read from $SHOAL_FLEET_KEY.

    Parameters
    ----------
    scenario
        A preset's name or a TOML file, the same on all buoys.
    id_
        Which agent it is, by its number: 7; in a stand-in sea also several: 7,8,9.
    connect
        Addresses of the other buoys, HOST:PORT,HOST:PORT,...: one list for all will do, which has its own, too;
        without --body that of the sea, as `shoal fleet` gives it to the buoys that it starts.
    body
        The vehicle that it steers, such as mavlink:udp:127.0.0.1:14550; or simulated, or simulated:X,Y: a point that
        goes as it is told, to try all this on a desk.
    listen
        HOST:PORT at which the other buoys reach it; default a free port that only this machine reaches.
    sensor
        What sees targets: none (the default), udp:HOST:PORT for a sensor process, or track for the recorded targets.
    arm
        Arm the vehicle, so that its motors turn, and disarm it at the end; default a person does both.
    body_key
        File with the pass phrase by which its MAVLink messages are signed.
    wait
        So many buoys must be there to begin; default all of the scenario. Who comes later joins in.
    out
        Folder for its log, a CSV file with a row for each step.
    plain
        Decide without a compiler: it starts at once, with a third of the memory.
    command_key
        File of the key that orders must be sealed with (see `shoal command`); without it none is obeyed.
    mesh_config
        File of zenoh's own configuration (JSON5), such as certificates.
    """
    if plain:
        sys.modules["numba"] = None  # type: ignore[assignment]  # Python's way to say: not there
    else:
        from shoal.cli.startup import load_compiler

        load_compiler()
    from shoal.buoy.trust import Trust
    from shoal.core.errors import FleetError
    from shoal.core.text import quoted

    trust = Trust(command_key, mesh_config)
    if not re.fullmatch(r"[0-9]{1,6}(,[0-9]{1,6})*", id_):
        raise FleetError("--id", f"is {quoted(id_)}", "give numbers of agents, such as 7 or 7,8,9")
    ids = [int(each) for each in id_.split(",")]
    if len(set(ids)) < len(ids):
        raise FleetError("--id", "names a buoy twice", "leave out one of them")
    if body is None:
        given = dict(zip(OF_A_BODY, (listen, sensor, arm or None, body_key, wait, out), strict=True))
        for name, value in given.items():
            if value is not None:
                raise FleetError(f"--{name}", "is for a buoy with a --body", "add --body, or leave it out")
        if connect is None:
            fix = "add --body mavlink:udp:127.0.0.1:14550 for a vehicle, or --connect HOST:PORT of a stand-in sea"
            raise FleetError("--connect", "is not given, and no --body", fix)
        _in_a_stand_in(scenario, ids, connect, trust)
        return
    if len(ids) > 1:
        raise FleetError("--id", "names several buoys, and a body is that of one", "start one `shoal buoy` for each")
    from shoal.buoy.sail import Gear, sail

    others = [":".join(map(str, _address("--connect", each))) for each in connect.split(",")] if connect else []
    here = "127.0.0.1:0" if listen is None else ":".join(map(str, _address("--listen", listen)))
    key = None if body_key is None else _key_in(body_key)
    sail(scenario, ids[0], Gear(body, sensor or "none", arm, key, here, others, wait, out, trust), tell)


def _in_a_stand_in(scenario: str, ids: list[int], connect: str, trust: "Trust") -> None:
    from shoal.buoy.serve import KEY, serve
    from shoal.core.errors import FleetError

    address = _address("--connect", connect)
    key = os.environ.get(KEY, "")
    if not re.fullmatch(r"([0-9a-fA-F]{2}){8,64}", key):
        problem = "is no key" if key else "holds no key"
        raise FleetError(f"${KEY}", problem, "set it to the key of the fleet, in hex")
    serve(scenario, ids, address, bytes.fromhex(key), trust)


def _address(option: str, text: str) -> tuple[str, int]:
    from shoal.core.errors import FleetError
    from shoal.core.text import quoted

    host, _, port = text.strip().rpartition(":")
    if not re.fullmatch(r"[0-9A-Za-z.\-]+|\[[0-9A-Fa-f:]+\]", host) or not (
        re.fullmatch(r"[0-9]{1,5}", port) and 0 < int(port) < 65536
    ):
        raise FleetError(option, f"is {quoted(text)}", "give HOST:PORT, such as 127.0.0.1:7447")
    return host, int(port)


def _key_in(file: Path) -> bytes:
    from shoal.buoy.mavlink import key_of
    from shoal.core.errors import FleetError, reason_of

    try:
        phrase = file.read_text(encoding="utf-8").strip("\r\n")
    except (OSError, ValueError) as error:
        raise FleetError(str(file), f"cannot be read: {reason_of(error)}", "name a file with a pass phrase") from None
    if not phrase:
        raise FleetError(str(file), "holds no pass phrase", "write the one in it that the vehicle was given")
    return key_of(phrase)
