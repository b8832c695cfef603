"""What was said, and who of the speakers are the k nearest: for all buoys of a process at once, or for one alone."""

from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.buoy.neighbors import link_nearest
from shoal.buoy.rows import ID, ON_TARGET, TOLD, Floats, report_of, row_of, table
from shoal.core.agents import as_records, width
from shoal.core.messages import Report
from shoal.strategies.one_agent import Inbox

Near = npt.NDArray[np.int64]
_ALL = np.ones((0, 0), bool)


@cache
def _kind(told: tuple[str, ...]) -> Any:
    return np.asarray(as_records(np.zeros((1, width(told))), told)).dtype


class Said:
    """m reports as arrays: one of each speaker, or several of which each listener hears one.

    Parameters
    ----------
    rows : of the reports, in the order of ids: see buoy/rows.py
    told : names of the fields that they tell
    listeners : n, how many may hear them

    Attributes
    ----------
    numbers : (m, 7 + T) of the rows
    inbox : the same for compiled code
    tells : (m + n, fields) what they tell, a part of `inbox`; the rows behind are for what listeners tell themselves
    """

    def __init__(self, rows: Sequence[bytes], told: tuple[str, ...], listeners: int) -> None:
        self.numbers = numbers = table(rows, told)
        self._told = told
        self.tells = np.zeros((len(rows) + listeners, width(told)))
        if told:
            self.tells[: len(rows)] = numbers[:, TOLD:]
        ids, on_target = numbers[:, ID].astype(int), numbers[:, ON_TARGET] > 0.0
        self.inbox = Inbox(ids, numbers[:, :ID].copy(), on_target, self.tells.view(_kind(told))[:, 0])

    @cached_property
    def reports(self) -> list[Report]:
        """The reports."""
        return [report_of(row, self._told) for row in self.numbers.tolist()]

    def nearest(self, ids: Any, readings: Floats, most: Sequence[int], reaches: Any = None) -> Near:
        """Whom each of n listeners hears: the k nearest of the others that it can hear, ties to the lower id.

        Parameters
        ----------
        ids, readings : (n,) who listens, and (n, 8) where
        most : k of each
        reaches : (n, m) which of the reports reached each, one of each speaker at most; None: all

        Returns
        -------
        (n, k, 2) rows of the reports, ascending, and how many of them are nearer; -1: no more
        """
        speakers, numbers = self.inbox.id, self.inbox.numbers
        near = np.full((len(ids), min(max(most, default=0), len(speakers)), 2), -1)
        reached = _ALL if reaches is None else np.ascontiguousarray(reaches)
        with np.errstate(over="ignore"):  # who is infinitely far away is the farthest, in plain Python, too
            link_nearest(near, ids, readings, speakers, numbers, np.array(most, int), reached)
        return near

    def heard(self, near: Near, ranked: bool = False) -> list[Report]:
        """The reports of the neighbors (k, 2) of one listener, with their ranks if so asked."""
        rows = [(row, rank) for row, rank in near.tolist() if row >= 0]
        return [self.reports[row]._replace(rank=rank) if ranked else self.reports[row] for row, rank in rows]

    def speakers(self, near: Near) -> list[int]:
        """The ids of the neighbors (k, 2) of one listener."""
        ids: list[int] = self.inbox.id[near[near[:, 0] >= 0, 0]].tolist()
        return ids

    def contact(self, near: Near) -> bool:
        """Whether any of the neighbors (k, 2) of one listener is on target."""
        return bool(self.inbox.on_target[near[near[:, 0] >= 0, 0]].any())


def nearest_alone(newest: Mapping[int, Report], told: tuple[str, ...], me: Report, most: int) -> tuple[Said, Near]:
    """What one listener hears, as `Said.nearest` has it: quicker for one, which needs no arrays of all the others.

    Parameters
    ----------
    newest : of each speaker; told : as of Said
    me : where the listener is; most : k
    """
    x, y, own = me.x, me.y, me.id
    far = [((x - it.x) * (x - it.x) + (y - it.y) * (y - it.y), id) for id, it in newest.items() if id != own]
    ranks = {id: rank for rank, (_, id) in enumerate(sorted(far)[:most])}
    ids = sorted(ranks)
    near = np.empty((1, len(ids), 2), np.int64)
    near[0, :, 0], near[0, :, 1] = np.arange(len(ids)), [ranks[id] for id in ids]
    return Said([row_of(newest[id]) for id in ids], told, 1), near
