"""Voyages as a log of AIS sentences, each with its time."""

from collections.abc import Iterator

from shoal.record.voyage.ais import names, positions, tagged
from shoal.record.voyage.voyages import Voyages


def nmea_lines(voyages: Voyages) -> Iterator[str]:
    """Yield a log: who is who, then the position reports in the order of time.

    Times are Unix seconds, or milliseconds throughout where some are not whole seconds.

    Raises
    ------
    MissingExtraError : pyais is not installed
    """
    fine = bool((voyages.times % 1_000_000).any())
    times = voyages.times.tolist()
    for sentence in names([craft for _, craft in voyages.known()]):
        yield tagged(sentence, times[0], fine=fine) + "\n"
    for at, time in enumerate(times):
        for sentence in positions(voyages, at):
            yield tagged(sentence, time, fine=fine) + "\n"
