"""shoal buoy: what runs on one vehicle."""

import os
import re
import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter


def buoy(
    scenario: str,
    /,
    *,
    id_: Annotated[str, Parameter(name="--id")],
    connect: str,
    plain: Annotated[bool, Parameter(negative=())] = False,
    command_key: Path | None = None,
    mesh_config: Path | None = None,
) -> None:
    """Run one buoy of a fleet, or several: decide by what its instruments say and what the others report.

    It ends when the sea that it is tied to does. The key of the fleet is read from $SHOAL_FLEET_KEY.

    Parameters
    ----------
    scenario
        A preset's name or a TOML file, the same on all buoys.
    id_
        Which agents run here, by their numbers: 7, or 7,8,9.
    connect
        Address of the sea, HOST:PORT, as `shoal fleet` gives it to the buoys that it starts.
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
    from shoal.buoy.serve import KEY, serve
    from shoal.buoy.trust import Trust
    from shoal.core.errors import FleetError
    from shoal.core.text import quoted

    if not re.fullmatch(r"[0-9]{1,6}(,[0-9]{1,6})*", id_):
        raise FleetError("--id", f"is {quoted(id_)}", "give numbers of agents, such as 7 or 7,8,9")
    ids = [int(each) for each in id_.split(",")]
    if len(set(ids)) < len(ids):
        raise FleetError("--id", "names a buoy twice", "leave out one of them")
    host, _, port = connect.rpartition(":")
    if not host or not re.fullmatch(r"[0-9]{1,5}", port) or not 0 < int(port) < 65536:
        raise FleetError("--connect", f"is {quoted(connect)}", "give HOST:PORT, such as 127.0.0.1:7447")
    key = os.environ.get(KEY, "")
    if not re.fullmatch(r"([0-9a-fA-F]{2}){8,64}", key):
        problem = "is no key" if key else "holds no key"
        raise FleetError(f"${KEY}", problem, "set it to the key of the fleet, in hex")
    serve(scenario, ids, (host, int(port)), bytes.fromhex(key), Trust(command_key, mesh_config))
