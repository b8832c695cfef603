"""Whose reports a buoy has where its swarm keeps them (network.max_age): the rule of world/reception.py for one."""

import numpy as np
import numpy.typing as npt

from shoal.buoy.inbox import Inbox


class Hearing:
    """What reached one buoy of what its process has in its inbox.

    Parameters
    ----------
    max_age : steps that a report may be older than the newest that can have arrived
    """

    def __init__(self, max_age: int) -> None:
        self._max_age = max_age
        self._reached: dict[int, npt.NDArray[np.bool_]] = {}

    def reach(self, step: int, speakers: npt.NDArray[np.bool_]) -> None:
        """Note that what these (N,) said at a step reaches the buoy, as soon as the mesh brings it."""
        self._reached = {then: who for then, who in self._reached.items() if then >= step - self._max_age}
        before = self._reached.get(step)
        self._reached[step] = speakers if before is None else before | speakers

    def held(self, inbox: Inbox, step: int) -> dict[int, tuple[int, bytes]]:
        """The newest that it has of each speaker, said at a step or at most `max_age` before it: when, and its row."""
        found: dict[int, tuple[int, bytes]] = {}
        for then in range(max(0, step - self._max_age), step + 1):
            if then in self._reached:
                reached = self._reached[then]
                found |= {id: (then, row) for id, row in inbox.of(then).items() if reached[id]}
        return found

    def copy(self) -> "Hearing":
        """The same, to go back to."""
        twin = Hearing(self._max_age)
        twin._reached = dict(self._reached)
        return twin
