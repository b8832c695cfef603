"""Whoever gives orders: finds the fleet, asks who is there, gives the order, and waits for the answers."""

import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, Protocol

from shoal.core.errors import FleetError, MessageError, ShoalError
from shoal.core.orders import Answer, Order, opened
from shoal.scenario.instructions import changed
from shoal.scenario.load import scenario_from
from shoal.scenario.schema import Scenario

VALID = 60.0  # seconds in which an order reaches everybody, or nobody any more
_LOOK = 0.1
_AGAIN = 1.0  # seconds after which who is there is asked again: the first time, links may not have been there


class Line(Protocol):
    """A guest's place on a mesh; see ZenohMesh."""

    def order(self, data: bytes) -> None:
        """Send an order to all who are there."""

    def orders(self, timeout: float) -> list[bytes]:
        """Return what arrived; if nothing did, wait for it as long as `timeout` [s]."""

    def fleets(self) -> set[str]:
        """Return the names of the fleets that are there."""


class Answers(NamedTuple):
    """Who obeys from which step on, who refused and why, and who did not answer."""

    obeyed: dict[int, int]
    refused: dict[int, str]
    silent: list[int]


class Orderer:
    """Gives orders to the fleet that is found on a line.

    Parameters
    ----------
    line : to the mesh; where : what errors call it
    key : that orders are sealed with
    wait : how long answers are waited for [s]
    clock : says the time [s since 1970]

    Raises
    ------
    FleetError : there is no fleet, there are several, or no buoy answers
    """

    def __init__(self, line: Line, where: str, key: bytes, wait: float, clock: Callable[[], float] = time.time) -> None:
        self._line, self._where, self._key, self._wait, self._clock = line, where, key, wait, clock
        self._number = 0
        self._fleet = self._found()
        self.scenario, self.agents = self._asked()

    def order(self, what: str, set: Mapping[str, Any] | None = None, agents: Sequence[int] = ()) -> Answers:
        """Give an order to some buoys, or all of them.

        Parameters
        ----------
        what : "hold", "recall", "resume" or "set"
        set : fields and their new values
        agents : numbers of buoys; default: all

        Raises
        ------
        ScenarioError : it sets a field that cannot change on the way, or a value that it cannot have
        FleetError : there is no such buoy
        """
        strangers = [id for id in agents if id >= self.agents]
        if strangers:
            raise FleetError("--buoy", f"is {strangers[0]}", f"this fleet has buoys 0 to {self.agents - 1}")
        if set and self.scenario is not None:
            changed(self.scenario, set)
        order = self._given(what, set or {}, tuple(agents))
        awaited = {*(agents or range(self.agents))}
        obeyed, refused = dict[int, int](), dict[int, str]()
        for answer in self._answers(order):
            obeyed |= dict.fromkeys(awaited.intersection(answer.obeyed), answer.step)
            refused |= {id: why for why, ids in answer.refused.items() for id in awaited.intersection(ids)}
            if awaited <= obeyed.keys() | refused.keys():
                break
        return Answers(obeyed, refused, sorted(awaited - obeyed.keys() - refused.keys()))

    def _found(self) -> str:
        until = self._clock() + self._wait
        while not (fleets := self._line.fleets()):
            if self._clock() > until:
                fix = "give the address that `shoal fleet --command-key FILE` prints, and the mesh's own --mesh-config"
                raise FleetError(self._where, f"no fleet is there after {self._wait:g} s", fix)
            time.sleep(_LOOK)
        if len(fleets) > 1:
            raise FleetError(self._where, "has buoys of several fleets", "give the address of a buoy of one of them")
        return fleets.pop()

    def _asked(self) -> tuple[Scenario | None, int]:
        """The scenario that the buoys go by, or None where it cannot be read here; and how many there are."""
        until = self._clock() + self._wait
        while (left := until - self._clock()) > 0.0:
            for answer in self._answers(self._given("ask"), min(left, _AGAIN)):
                if answer.scenario:
                    return _read(answer)
        problem = f"no buoy of {self._fleet} answered within {self._wait:g} s"
        fix = (
            "give the key that the fleet was started with (--command-key); look whether clocks agree; or --wait longer"
        )
        raise FleetError(self._where, problem, fix)

    def _given(self, what: str, set: Mapping[str, Any] | None = None, agents: tuple[int, ...] = ()) -> Order:
        now = self._clock()
        self._number = max(self._number + 1, int(now * 1e9))
        order = Order(self._fleet, self._number, now + VALID, what, set or {}, agents)
        self._line.order(order.to_bytes(self._key))
        return order

    def _answers(self, order: Order, wait: float | None = None) -> Any:
        """The answers to an order, as they come, until the time is over."""
        until = self._clock() + (self._wait if wait is None else wait)
        while (left := until - self._clock()) > 0.0:
            for data in self._line.orders(min(left, _LOOK)):
                try:
                    said, _ = opened(data, self._key)
                except MessageError:
                    continue
                if isinstance(said, Answer) and (said.fleet, said.number) == (order.fleet, order.number):
                    yield said


def _read(answer: Answer) -> tuple[Scenario | None, int]:
    import tomllib

    table = tomllib.loads(answer.scenario)
    agents = sum(each["count"] for each in (*table["fleets"], *table.get("joins", ())))
    files = [each["strategy"] for each in (table, *table["fleets"]) if "file" in each.get("strategy", {})]
    if files:  # a program, of the buoys' computer and not of this one
        return None, agents
    try:
        return scenario_from(table, where="the fleet's scenario"), agents
    except ShoalError:
        return None, agents
