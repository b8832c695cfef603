"""Which buoys are killed on purpose, and when: BUOY@STEP."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from shoal.buoy.named import buoys_of
from shoal.buoy.tether import Commands, Tick
from shoal.core.errors import FleetError
from shoal.core.text import quoted
from shoal.run.fleet.lockstep import Crowd
from shoal.run.fleet.processes import Processes


def kills_of(texts: Iterable[str], agents: int) -> dict[int, list[int]]:
    """Return who is killed at each step.

    Raises
    ------
    FleetError : a text is not BUOY@STEP, or names a buoy that there is not
    """
    found: dict[int, list[int]] = {}
    for text in texts:
        match = re.fullmatch(r"([0-9]{1,6})@([0-9]{1,15})", text)
        if not match or int(match[1]) >= agents or int(match[2]) < 1:
            fix = f"write BUOY@STEP, such as 7@500: a buoy from 0 to {agents - 1}, a step from 1 on"
            raise FleetError("--kill", f"is {quoted(text)}", fix)
        found.setdefault(int(match[2]), []).append(int(match[1]))
    return found


def company(kills: dict[int, list[int]], shares: Sequence[Sequence[int]]) -> list[str]:
    """Say of each kill that takes other buoys with it which, in a sentence.

    Parameters
    ----------
    kills : who is killed at each step
    shares : which buoys are in one process each
    """
    agents = sum(map(len, shares))
    return [
        f"--kill {id}@{step} ends {buoys_of(share)}, which are in one process; --processes {agents} gives each its own"
        for step, ids in kills.items()
        for id in ids
        for share in shares
        if id in share and len(share) > 1
    ]


@dataclass
class Killing:
    """A crowd of which some are killed: their processes are, with all buoys in them; in memory, they alone."""

    crowd: Crowd
    kills: dict[int, list[int]]

    def ask(self, tick: Tick) -> tuple[list[Commands], list[int]]:
        """As the crowd does; who is to be killed at this step is, before it begins."""
        lost = self.kill(tick)
        return ([], lost) if lost else self.crowd.ask(tick)

    def kill(self, tick: Tick) -> list[int]:
        """Kill who is to be killed at a step; return who was."""
        chosen: Sequence[int] = self.kills.pop(tick.step, ())
        if not isinstance(self.crowd, Processes):
            return list(chosen)
        tied = {each for each in map(self.crowd.of, chosen) if each is not None}
        return [id for each in tied for id in self.crowd.kill(each)]
