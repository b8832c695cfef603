"""The orders that reach some buoys: which are authentic, new and in time. Without clock and mesh, as the buoys."""

import hashlib
from collections import Counter
from typing import Any, Protocol

from shoal.buoy.named import buoys_of
from shoal.core.errors import MessageError
from shoal.core.orders import Answer, Order, opened, passed_on
from shoal.scenario.commands import Command
from shoal.scenario.load import to_toml
from shoal.scenario.schema import Scenario

AHEAD = 60.0  # seconds by which an order may come from the future: clocks differ
_MOST = 4096  # messages that are remembered, so that each is passed on once


class Obedient(Protocol):
    """Whoever is under these orders."""

    @property
    def present(self) -> tuple[int, ...]:
        """Who is there."""

    def refusal(self, command: Command, id: int) -> str | None:
        """Why a buoy cannot obey a command; None if it can."""

    def order(self, command: Command) -> None:
        """Let buoys obey from the command's step on."""


class Orderbook:
    """What came, what of it was passed on and what was obeyed.

    An order counts once, and only if it is sealed with the key, is for this fleet, is not void, and has a higher number
    than all before it. The first number is the time of the start, so that a buoy that starts anew obeys nothing old.

    Parameters
    ----------
    scenario : of the fleet, as the sender of orders is told it
    fleet : name of the mesh
    key : what orders are sealed with
    started : when the buoys started [s since 1970]

    Attributes
    ----------
    counts : how many messages were obeyed, asked, answers, and how many duplicate, forged, strange, replayed or void
    obeyed : commands that were obeyed, with those who do so, as they are told to the log
    refused : sentences about those that were not
    """

    def __init__(self, scenario: Scenario, fleet: str, key: bytes, started: float) -> None:
        self.counts: Counter[str] = Counter()
        self.obeyed: list[Command] = []
        self.refused: list[str] = []
        self._scenario, self._fleet, self._key = scenario, fleet, key
        self._last = int(started * 1e9)
        self._passed: dict[int, int] = {}  # how often an order had been passed on when it came here first
        self._seen: dict[bytes, None] = {}

    def take(self, data: bytes, crew: Obedient, step: int, now: float) -> list[bytes]:
        """Take a message; return what is to be published: it, passed on, and an answer.

        Parameters
        ----------
        data : what arrived
        crew : the buoys here
        step : from which on an order is obeyed
        now : [s since 1970]
        """
        try:
            said, passed = opened(data, self._key)
        except MessageError:
            self.counts["forged"] += 1
            return []
        if said.fleet != self._fleet:
            self.counts["strange"] += 1
            return []
        if isinstance(said, Answer):
            return self._carry(said, data, passed)
        if said.number in self._passed:
            self.counts["duplicate"] += 1
        elif said.number <= self._last:
            self.counts["replayed"] += 1
        elif not said.number / 1e9 - AHEAD <= now <= said.until:
            self.counts["void"] += 1
        else:
            self._last = said.number
            self._passed[said.number] = passed + 1
            _forget(self._passed)
            answer = self._asked(said, crew, step) if said.what == "ask" else self._ordered(said, crew, step)
            own = [answer.to_bytes(self._key, passed + 1)] if answer.obeyed or answer.refused else []
            return [passed_on(data, passed + 1), *own]
        return []

    def _carry(self, answer: Answer, data: bytes, passed: int) -> list[bytes]:
        """Pass an answer on toward whoever gave the order: if it comes from farther away than we are."""
        here = self._passed.get(answer.number)
        mark = hashlib.sha256(data[2:]).digest()
        if here is None or passed <= here or mark in self._seen:
            return []
        self._seen[mark] = None
        _forget(self._seen)
        self.counts["answers"] += 1
        return [passed_on(data, here)]

    def _asked(self, order: Order, crew: Obedient, step: int) -> Answer:
        self.counts["asked"] += 1
        return Answer(self._fleet, order.number, step, crew.present, scenario=to_toml(self._scenario))

    def _ordered(self, order: Order, crew: Obedient, step: int) -> Answer:
        meant = [id for id in crew.present if not order.agents or id in order.agents]
        refused: dict[str, tuple[int, ...]] = {}
        obeyed: list[int] = []
        try:
            word = {"set": dict(order.set)} if order.what == "set" else {"order": order.what}
            command = Command.model_validate({"step": step, **word, "agents": meant or [0]})
        except ValueError as error:
            refused[" ".join(str(error).split())[:200]] = tuple(meant)
            meant = []
        for id in meant:
            if (why := crew.refusal(command, id)) is None:
                obeyed.append(id)
            else:
                refused[why] = (*refused.get(why, ()), id)
        if obeyed:
            command = command.model_copy(update={"agents": obeyed})
            crew.order(command)
            self.obeyed.append(command)
        if obeyed or refused:
            self.counts["obeyed" if obeyed else "refused"] += 1
        self.refused += [f"{order.what} was refused by {buoys_of(ids)}: {why}" for why, ids in refused.items()]
        return Answer(self._fleet, order.number, step, tuple(obeyed), refused)


def _forget(known: dict[Any, Any]) -> None:
    """Drop what is known for longest, if too much is."""
    while len(known) > _MOST:
        del known[next(iter(known))]
