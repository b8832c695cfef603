"""Orders in a soak: authentic ones, and all that an adversary makes of them; who obeys is known beforehand."""

from typing import NamedTuple

import numpy as np

from shoal.buoy.orderbook import Orderbook
from shoal.core.orders import Order, opened
from shoal.run.fleet.invariants import BrokenInvariantError, demand
from shoal.run.fleet.vessel import Vessel
from shoal.scenario.schema import Scenario

OFTEN = 0.5  # chance of a step in which something is said about orders
LOST = 0.2  # chance that a message about them does not reach a process
VALID = 60.0  # [s]: of the rule, not of its code
WORDS = ("hold", "recall", "resume")
_KEY, _OTHER, _FLEET = b"k" * 32, b"K" * 32, "soak"


class Letter(NamedTuple):
    """A message about orders: its bytes, and the order if it is to be obeyed."""

    data: bytes
    order: Order | None


class OrderStorm:
    """Whoever gives orders to a fleet in virtual time, whoever forges them, and what buoys must make of it.

    Parameters
    ----------
    seed : decides everything; scenario : of the fleet; processes : P, how many there are
    """

    def __init__(self, seed: int, scenario: Scenario, processes: int) -> None:
        self._chance = np.random.default_rng([seed, 0x0DE5])
        self._scenario, self._processes = scenario, processes
        self._letters: dict[int, list[Letter]] = {}
        self._last: dict[int, int] = {}
        self._coming: dict[int, list[tuple[int, int, str]]] = {}
        self._under: dict[int, str] = {}
        self._sent: list[Order] = []
        self.obeyed = 0

    def _clock(self, now: float) -> float:
        return 1e6 + now * self._scenario.time_step

    def start(self, process: int, vessel: Vessel, now: int, anew: bool) -> None:
        """A process starts, or starts again; `anew`: with nothing of what it was."""
        started = self._clock(now)
        vessel.aboard.orderbook = Orderbook(self._scenario, _FLEET, _KEY, started)
        self._last[process] = int(started * 1e9)
        self._letters[process], self._coming[process] = [], []
        if anew:
            self._under |= dict.fromkeys(vessel.ids, "resume")

    def blow(self, now: int) -> None:
        """Let something be said, or not."""
        if self._chance.random() < OFTEN:
            letter = self._letter(now)
            self._send(letter, self._chance.permutation(self._processes)[: 1 + int(self._chance.integers(2))].tolist())

    def deliver(self, process: int, vessel: Vessel, now: int) -> None:
        """Let a process that is in a step take what reached it, and pass it on."""
        tick, aboard = vessel.tick, vessel.aboard
        if tick is None:
            return
        letters, self._letters[process] = self._letters[process], []
        for letter in letters:
            order, said = letter.order, aboard.attend([letter.data], tick, self._clock(now))
            if order and self._last[process] < order.number and self._clock(now) <= order.until:
                self._last[process] = order.number
                meant = [id for id in tick.readings["id"].tolist() if not order.agents or id in order.agents]
                self._coming[process] += [(tick.step + 1, id, order.what) for id in meant]
                self.obeyed += len(meant)
                demand("an order is passed on", [opened(data, _KEY)[0] for data in said][:1], [order])
            for data in said:
                self._send(Letter(data, order if data[:1] == b"O" else None), list(range(self._processes)))

    def check(self, process: int, vessel: Vessel, step: int) -> dict[int, str]:
        """After a decision every buoy is under the order that it must be under; return those.

        Raises
        ------
        BrokenInvariantError : it is under another
        """
        due = [each for each in self._coming[process] if each[0] <= step]
        self._coming[process] = [each for each in self._coming[process] if each[0] > step]
        self._under |= {id: what for _, id, what in due}
        for id, buoy in vessel.aboard.buoys.items():
            if buoy.under != self._under[id]:
                problem = f"buoy {id} in step {step} is under {buoy.under!r}, not {self._under[id]!r}"
                raise BrokenInvariantError("nobody obeys an unauthentic command, everybody an authentic one", problem)
        return {id: self._under[id] for id in vessel.ids if self._under[id] != "resume"}

    def _send(self, letter: Letter, processes: list[int]) -> None:
        for process in processes:
            if self._chance.random() >= LOST:
                self._letters.setdefault(process, []).append(letter)

    def _letter(self, now: int) -> Letter:
        """An order of somebody who has the key; or one that must not be obeyed."""
        chance, clock = self._chance, self._clock(now)
        kind = int(chance.integers(9))
        agents = tuple(chance.permutation(self._scenario.agents)[: int(chance.integers(0, 6))].tolist())
        number = int(clock * 1e9) + 1 + int(chance.integers(1000))
        order = Order(_FLEET, number, clock + VALID, WORDS[int(chance.integers(len(WORDS)))], {}, agents)
        if kind < 4:
            self._sent.append(order)
            return Letter(order.to_bytes(_KEY), order)
        if kind == 4 and self._sent:  # recorded, and sent again: still an order to whoever has not had a newer one
            old = self._sent[int(chance.integers(len(self._sent)))]
            return Letter(old.to_bytes(_KEY, int(chance.integers(256))), old)
        if kind == 5:
            return Letter(order.to_bytes(_OTHER), None)
        if kind == 6:
            return Letter(order._replace(fleet="another").to_bytes(_KEY), None)
        if kind == 7:
            future = order._replace(number=int((clock + 2 * VALID) * 1e9), until=clock + 3 * VALID)
            void = order._replace(until=clock - 1e-3)
            return Letter((future if chance.random() < 0.5 else void).to_bytes(_KEY), None)
        data = bytearray(order.to_bytes(_KEY))
        place = int(chance.integers(len(data) - 1))
        data[place + (place > 0)] ^= 1 << int(chance.integers(8))
        return Letter(bytes(data), None)
