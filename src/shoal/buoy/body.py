"""The body of a buoy: what says where it is, and goes where it is told. Which one, `--body` says."""

from collections.abc import Callable, Mapping
from typing import Protocol

from shoal.buoy.detector import Detector
from shoal.buoy.errors import BodyError
from shoal.core.errors import did_you_mean
from shoal.core.messages import Reading
from shoal.core.text import quoted
from shoal.scenario.load import Source, load


class Body(Protocol):
    """What a loop needs of a vehicle. All in the arena's frame, [m] and [m/s]."""

    def read(self) -> Reading:
        """Where it is, how it moves, and whether its sensor has a target.

        Raises
        ------
        UnreadyError : it does not know now
        """

    def go(self, vx: float, vy: float) -> None:
        """Go with this velocity [m/s] until told otherwise, or told nothing for too long.

        Raises
        ------
        UnreadyError : it does not obey now
        """

    def stop(self) -> None:
        """Stop, until the next `go`."""

    def close(self) -> None:
        """Stop for good, and let go of the vehicle."""


Opener = Callable[[str], Body]


def open_body(
    text: str,
    scenario: Source,
    id: int,
    *,
    detector: Detector | None = None,
    arm: bool = False,
    key: bytes | None = None,
    others: Mapping[str, Opener] | None = None,
    tell: Callable[[str], None] | None = None,
) -> Body:
    """Return the body that a text names: "mavlink:udp:127.0.0.1:14550", "simulated", or one of `others`.

    Parameters
    ----------
    text : a kind and what it needs, with a colon between; of mavlink: an address of connection.py, and #3 for system 3;
        of simulated: where it begins, X,Y, or nothing
    scenario : where the arena lies, and how fast this agent may go
    id : number of the agent, 0 to N - 1
    detector : what says whether a target is there; default: none ever is
    arm : arm the vehicle, which lets its motors turn; else a person does
    key : 32 bytes that sign all messages; default: anybody who reaches the vehicle may steer it
    others : {kind: function of what follows the colon} of more bodies, such as the stand-in sea's
    tell : called with a sentence when it waits for something

    Raises
    ------
    BodyError : no such kind; no such vehicle; it does not do as it is asked
    ScenarioError : no such agent, or the scenario does not say where it is
    MissingExtraError : a library is needed and absent
    """
    kind, _, rest = text.partition(":")
    openers = dict(others or {})
    if kind in openers:
        return openers[kind](rest)
    if kind == "simulated":
        if arm or key is not None:
            option = "--arm" if arm else "--body-key"
            raise BodyError(option, "is for a vehicle, and the body is simulated", "leave it out")
        from shoal.buoy.simulated_body import open_simulated_body

        return open_simulated_body(rest, load(scenario), id, detector=detector)
    if kind != "mavlink":
        known = ["mavlink", "simulated", *openers]
        fix = f"{did_you_mean(kind, known)}there are: {', '.join(known)}; write mavlink:udp:127.0.0.1:14550"
        raise BodyError("--body", f"{quoted(text)} is no kind of body", fix)
    from shoal.buoy.mavlink_body import open_mavlink_body

    return open_mavlink_body(rest, load(scenario), id, detector=detector, arm=arm, key=key, tell=tell)
