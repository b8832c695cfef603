"""Relays: a buoy passes on the reports that it hears, with their author and step as they are, and one hop more.

A relayed report is bytes, little-endian: what it is (1 byte), the hops that it will have come over (1), the id of the
buoy that passes it on (4), the report as its author sent it (core/wire.py), and the CRC-32 of all that (4).
"""

import struct
import zlib
from collections.abc import Collection, Iterable
from typing import NamedTuple

from shoal.buoy.inbox import Inbox
from shoal.core.errors import MessageError

_KIND = 0xF1  # no version of a report
_MARK = bytes([_KIND])
_HEAD = struct.Struct("<BBI")
_CHECK = struct.Struct("<I")
MOST = 255  # hops that the format can say


class Relayed(NamedTuple):
    """A report on its way: over how many hops it came, 1 from its author; who sent it last, -1 its author."""

    hops: int
    by: int
    report: bytes

    def to_bytes(self) -> bytes:
        """As it goes over the air."""
        body = _HEAD.pack(_KIND, self.hops, self.by) + self.report
        return body + _CHECK.pack(zlib.crc32(body))

    @classmethod
    def of(cls, data: bytes) -> "Relayed":
        """What came over the air: a relayed report, or one as its author sent it.

        Raises
        ------
        MessageError : a relayed one that is damaged, or of no hops that can be
        """
        if data[:1] != _MARK:
            return cls(1, -1, data)
        body = data[: -_CHECK.size]
        if len(data) < _HEAD.size + _CHECK.size or data[-_CHECK.size :] != _CHECK.pack(zlib.crc32(body)):
            raise MessageError("relayed report", "is damaged: its checksum does not match", "drop it")
        _, hops, by = _HEAD.unpack_from(body)
        if hops < 2:
            raise MessageError("relayed report", f"came over {hops} hops, but a relay is the second", "drop it")
        return cls(hops, by, body[_HEAD.size :])


class Relay:
    """Passes on what some buoys hear: each report once, or again where it comes over fewer hops than before.

    Parameters
    ----------
    ids : who they are: what they said is not passed on by themselves; the least of them signs
    hops : over how many a report may come
    """

    def __init__(self, ids: Collection[int], hops: int) -> None:
        self._ids = frozenset(ids)
        self._hops = min(hops, MOST)
        self._fewest: dict[int, dict[int, int]] = {}
        self._waiting: list[bytes] = []

    def take(self, messages: Iterable[bytes], inbox: Inbox, now: int) -> None:
        """Put what a mesh brought in an inbox, and pass on what are reports that may go further and did not so far.

        Parameters
        ----------
        messages : what arrived
        inbox : which says what is a report, and counts what is none
        now : number of the step that it arrived in
        """
        reports: list[bytes] = []
        hops: list[int] = []
        for data in messages:
            if data[:1] != _MARK:
                reports.append(data)
                hops.append(1)
                continue
            try:
                came = Relayed.of(data)
            except MessageError:
                inbox.counts["damaged"] += 1
                continue
            reports.append(came.report)
            hops.append(came.hops)
        words = inbox.put(reports, now)
        if self._hops > 1:
            for report, over, word in zip(reports, hops, words, strict=True):
                if word in ("new", "duplicate") and over < self._hops:
                    self._pass_on(report, over, *inbox.source(report))

    def _pass_on(self, report: bytes, hops: int, id: int, step: int) -> None:
        if id in self._ids:
            return
        known = self._fewest.setdefault(step, {})
        if hops < known.get(id, MOST + 1):
            known[id] = hops
            self._waiting.append(Relayed(hops + 1, min(self._ids), report).to_bytes())

    def waiting(self) -> list[bytes]:
        """What is to be published now, each once."""
        waiting, self._waiting = self._waiting, []
        return waiting

    def forget(self, step: int) -> None:
        """Drop what is known of reports said before a step."""
        for then in [then for then in self._fewest if then < step]:
            del self._fewest[then]
