"""What was said, and who of the speakers are the k nearest: for all buoys of a process at once, or for one alone."""

import struct
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.agents import as_records, width
from shoal.core.messages import Report
from shoal.strategies.one_agent import Inbox

_ROW = struct.Struct("7d").pack
Near = npt.NDArray[np.int64]


@cache
def _kind(told: tuple[str, ...]) -> Any:
    return np.asarray(as_records(np.zeros((1, width(told))), told)).dtype


class Said:
    """m reports, as they came and as arrays: one of each speaker, or several of which each listener hears one.

    Parameters
    ----------
    reports : in the order of ids
    told : names of the fields that they tell
    listeners : n, how many may hear them

    Attributes
    ----------
    reports : as given
    inbox : the same for compiled code
    tells : (m + n, fields) what they tell, a part of `inbox`; the rows behind are for what listeners tell themselves
    """

    def __init__(self, reports: Sequence[Report], told: tuple[str, ...], listeners: int) -> None:
        self.reports = reports
        count = len(reports)
        self.tells = np.zeros((count + listeners, width(told)))
        if told and count:
            self.tells[:count] = [each.told for each in reports]
        rows = [_ROW(it.id, it.x, it.y, it.vx, it.vy, it.time, it.on_target) for it in reports]
        numbers = np.frombuffer(b"".join(rows)).reshape(count, 7)  # quicker than of tuples
        told_of = self.tells.view(_kind(told))[:, 0]
        self.inbox = Inbox(numbers[:, 0].astype(int), numbers[:, 1:6].copy(), numbers[:, 6] > 0.0, told_of)

    def nearest(self, ids: Any, x: Any, y: Any, most: Sequence[int], reaches: Any = None) -> Near:
        """Whom each of n listeners hears: the k nearest of the others that it can hear, ties to the lower id.

        Parameters
        ----------
        ids, x, y : (n,) who listens, and where [m]
        most : k of each
        reaches : (n, m) which of the reports reached each, one of each speaker at most; None: all

        Returns
        -------
        (n, k, 2) rows of the reports, ascending, and how many of them are nearer; -1: no more
        """
        speakers, numbers = self.inbox.id, self.inbox.numbers
        with np.errstate(over="ignore"):  # who is infinitely far away is the farthest
            dx = x[:, None] - numbers[:, 0]
            dy = y[:, None] - numbers[:, 1]
            square = dx * dx + dy * dy
        square[ids[:, None] == speakers] = np.nan  # sorted behind all others
        if reaches is not None:
            square[~reaches] = np.nan
        counts = list(map(min, (square == square).sum(axis=1).tolist(), most))
        order = square.argsort(axis=1, kind="stable")[:, : max(counts, default=0)]
        for row, count in zip(order, counts, strict=True):
            row[count:] = speakers.size  # nobody's, behind all others
        near = np.empty((*order.shape, 2), np.int64)
        near[:, :, 1] = ranks = order.argsort(axis=1)
        near[:, :, 0] = rows = order[np.arange(len(order))[:, None], ranks]
        if min(counts, default=0) < order.shape[1]:
            near[rows == speakers.size] = -1
        return near

    def heard(self, near: Near, ranked: bool = False) -> list[Report]:
        """The reports of the neighbors (k, 2) of one listener, with their ranks if so asked."""
        rows = [(row, rank) for row, rank in near.tolist() if row >= 0]
        return [self.reports[row]._replace(rank=rank) if ranked else self.reports[row] for row, rank in rows]

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
    return Said([newest[id] for id in ids], told, 1), near
