"""A run as chart plotters see it: the AIS reports of its buoys and targets, at the pace of their clocks."""

import math
import time
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta

import numpy as np

from shoal.core.errors import ScenarioError
from shoal.core.geodesy import Frame
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory
from shoal.record.voyage.ais import names, positions
from shoal.record.voyage.anchor import Anchor
from shoal.record.voyage.voyages import Craft, Places, frames_of, voyages_of
from shoal.run.facts import facts_of, facts_told
from shoal.run.simulation import Simulation
from shoal.viewer.broadcast import Broadcast
from shoal.viewer.bulletin import Bulletin

END = "\r\n"  # of a line, as NMEA 0183 has it

Moment = tuple[float, bytes]  # seconds since step 0, and the sentences of who is there


def greeting(crafts: list[Craft]) -> bytes:
    """Return the sentences that say who is who.

    Raises
    ------
    MissingExtraError : pyais is not installed
    """
    return _message(names(crafts))


def recorded_moments(record: Record, run: int, every: float, anchor: Anchor) -> Iterator[Moment]:
    """Yield moments of the frames that a record keeps of a run, `every` seconds apart or more.

    Raises
    ------
    RecordError : it keeps none
    """
    frames = frames_of(record, run)
    seconds = np.asarray(frames.step) * record.facts.time_step
    voyages = voyages_of(frames, record.facts, anchor, "")
    due = -math.inf
    for at, now in enumerate(seconds.tolist()):
        if now >= due:
            due = now + every * (1.0 - 1e-9)
            yield now, _message(positions(voyages, at))


def live_moments(simulation: Simulation, every: float, anchor: Anchor) -> Iterator[Moment]:
    """Yield moments of a simulation as it goes, `every` seconds apart or more, from where it is to its end."""
    facts = facts_of(simulation.scenario)
    steps = max(1, math.ceil(every / facts.time_step * (1.0 - 1e-9)))
    seen: list[Trajectory] = []
    while simulation.number < simulation.scenario.steps:
        seen = [*seen[-1:], simulation.look()]
        voyages = voyages_of(Trajectory.join(seen), facts, anchor, "")
        yield simulation.number * facts.time_step, _message(positions(voyages, len(seen) - 1))
        simulation.advance(min(steps, simulation.scenario.steps - simulation.number))


def follow(bulletins: Iterator[Bulletin | None], broadcast: Broadcast, every: float, frame: Frame) -> int:
    """Send what a fleet says as it comes, `every` seconds of its run apart or more; return how many moments that were.

    Parameters
    ----------
    bulletins : with None where nothing new came for a while
    frame : local meters around the center of the scenario
    """
    seen: list[Places] = []
    due, count = -math.inf, 0
    for bulletin in bulletins:
        broadcast.wait(time.monotonic())
        if bulletin is None or not bulletin.frame:
            continue
        facts, places = facts_told(bulletin.scene), bulletin.places
        now = bulletin.step * facts.time_step
        if now < due:
            continue
        due = now + every * (1.0 - 1e-9)
        seen = [*seen[-1:], places]
        both = Places(*(np.concatenate(parts) for parts in zip(*seen, strict=True)))
        start = datetime.now(UTC) - timedelta(seconds=now)
        voyages = voyages_of(both, facts, Anchor(frame, start), "")
        broadcast.send(_message(positions(voyages, len(seen) - 1)))
        count += 1
    return count


def play(moments: Iterator[Moment], broadcast: Broadcast, speed: float) -> int:
    """Send moments when they are due, `speed` times as fast as they were; return how many. It begins at once.

    A simulation that is slower than that goes as fast as it can.
    """
    begun, first, count = time.monotonic(), None, 0
    for seconds, message in moments:
        first = seconds if first is None else first
        broadcast.wait(begun + (seconds - first) / speed)
        broadcast.send(message)
        count += 1
    return count


def check_pace(speed: float, every: float) -> None:
    """Refuse a pace at which nothing would go on.

    Raises
    ------
    ScenarioError : it is 0 or less
    """
    for name, value in (("--speed", speed), ("--every", every)):
        if not value > 0.0:
            raise ScenarioError(name, f"is {value:g}", "give a number above 0")


def _message(sentences: Iterator[str]) -> bytes:
    return "".join(sentence + END for sentence in sentences).encode("ascii")
