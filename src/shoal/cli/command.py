"""shoal command: an order to buoys at sea."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from shoal.buoy.named import buoys_of
from shoal.cli.console import results_console
from shoal.cli.numbers import MaybeNumber

NOT_ALL = 3  # exit code where not all obey


def command(
    address: str,
    order: str,
    assignments: list[str] | None = None,
    /,
    *,
    buoy: Annotated[list[int] | None, Parameter(negative=(), consume_multiple=False)] = None,
    key: Path,
    wait: MaybeNumber = None,
    mesh_config: Path | None = None,
) -> int:
    """Give buoys of a fleet an order over the mesh, and print who obeys; exit code 3 if not all do.

    Parameters
    ----------
    address
        Of any buoy of the fleet, as `shoal fleet --command-key FILE` prints it, such as tcp/127.0.0.1:7447.
    order
        hold: want no velocity; recall: go back to where it set out; resume: decide by the strategy again; set.
    assignments
        Of set: fields that may change on the way and their new values, such as strategy.delta=0.02 or neighbors=10.
    buoy
        Number of a buoy that it is for; may be repeated; default all.
    key
        File of the key that the fleet was started with (--command-key).
    wait
        Seconds that answers are waited for; default 10.
    mesh_config
        File of zenoh's own configuration (JSON5), such as certificates.
    """
    from shoal.buoy.orderer import Orderer
    from shoal.buoy.trust import read_key
    from shoal.buoy.zenoh_mesh import ANY, ZenohMesh, protocol_of
    from shoal.core.errors import FleetError
    from shoal.core.text import quoted
    from shoal.scenario.edit import parse_assignment

    orders = ("hold", "recall", "resume", "set")
    if order not in orders:
        raise FleetError("order", f"is {quoted(order)}", f"give one of: {', '.join(orders)}")
    if (order == "set") != bool(assignments):
        problem = "needs a field and its new value" if order == "set" else "takes no fields"
        raise FleetError(order, problem, f"write {'set strategy.delta=0.02' if order == 'set' else order}")
    if any(id < 0 for id in buoy or ()):
        raise FleetError("--buoy", f"is {min(buoy or ())}", "give numbers of buoys, 0 and up")
    seconds = 10.0 if wait is None else wait
    if not 0.0 < seconds <= 3600.0:
        raise FleetError("--wait", f"is {seconds:g}", "give more than 0 and at most 3600 seconds")
    changes = dict(parse_assignment(each) for each in assignments or ())
    secret = read_key(key)
    protocol = protocol_of(mesh_config)
    place = address if "/" in address else f"{protocol}/{address}"
    mesh = ZenohMesh(ANY, None, connect=[place], listen=f"{protocol}/127.0.0.1:0", config=mesh_config)
    try:
        answers = Orderer(mesh, place, secret, seconds).order(order, changes, sorted(set(buoy or ())))
    finally:
        mesh.close()
    console = results_console()
    for step in sorted(set(answers.obeyed.values())):
        console.print(
            f"obeyed from step {step:,} on: {buoys_of(id for id, at in answers.obeyed.items() if at == step)}"
        )
    for why in dict.fromkeys(answers.refused.values()):
        console.print(f"refused by {buoys_of(id for id, said in answers.refused.items() if said == why)}: {why}")
    if answers.silent:
        console.print(f"did not answer within {seconds:g} s: {buoys_of(answers.silent)}")
    return NOT_ALL if answers.refused or answers.silent else 0
