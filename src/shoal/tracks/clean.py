"""The rule that cleans every track: one bad fix costs one fix."""

from bisect import bisect_right
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.tracks.ground import along_the_ground, points, steps
from shoal.tracks.table import Fixes
from shoal.tracks.times import iso

FEWEST = 2  # fixes: one alone has no path
COARSE = 0.25  # share of fixes at the time of another, at another place
SHOWN = 3  # times or lines, in a note
LONG = 1000  # fixes: from here on a file of jumps is refused without looking for a path in it
BLOCK = 512  # fixes looked through at once


def clean(path: Path, fixes: Fixes, max_speed: float) -> tuple[Fixes, list[str]]:
    """Return the fixes of the longest path that never exceeds `max_speed` [m/s], and what was dropped.

    Raises
    ------
    TrackError : times are too coarse or go backwards for no good reason, or fewer than two fixes are left
    """
    fixes, notes = _in_order(path, fixes)
    fixes, twins = _without_twins(fixes)
    _check_times(path, fixes)
    _check_count(path, fixes, "record at least two times of the target")
    kept = longest_path(path, fixes, max_speed)
    times = fixes.unix[kept]
    repeated = ~kept & np.isin(fixes.unix, times)
    jumps = fixes.where(~kept & ~repeated)
    fixes = fixes.where(kept)
    _check_count(
        path,
        fixes,
        f"every step is faster than max_speed = {max_speed:g} m/s: raise max_speed, "
        "or check the units of time and the order of lat and lon",
    )
    return fixes, [*notes, *_note_repeated(twins + int(repeated.sum())), *_note_jumps(jumps, max_speed)]


def longest_path(path: Path, fixes: Fixes, max_speed: float) -> NDArray[np.bool_]:
    """Return which fixes form the longest chain in which each is within reach of the one before.

    Reach is transitive (from a to b and from b to c is from a to c), so a chain is as good as its last
    fix, and the longest that ends at fix i is one longer than the longest that ends anywhere within reach of i:

    level_i = 1 + max level_j     over j < i with |p_i - p_j| <= max_speed (t_i - t_j), t_j < t_i

    Nearly always the end of the longest chain so far is such a j; only fixes that it does not reach cost a search.
    """
    where, unix = points(fixes), fixes.unix
    n = len(unix)
    level, before = np.ones(n, np.intp), np.full(n, -1, np.intp)
    highest = np.ones(n, np.intp)  # of the levels up to here
    tip = 0
    meters, seconds = steps(fixes)
    direct = (meters <= max_speed * seconds) & (seconds > 0.0)
    fast = meters > max_speed * seconds
    if n > LONG and np.mean(fast) > 0.5:
        raise TrackError(
            str(path),
            f"{np.mean(fast):.0%} of its steps are faster than max_speed = {max_speed:g} m/s",
            "raise max_speed, check the units of time and the order of lat and lon, or name one of several vehicles",
        )

    def reached(earlier: slice, i: int) -> NDArray[np.intp]:
        """Which of some earlier fixes have i within reach."""
        chords = np.sqrt(np.sum((where[earlier] - where[i]) ** 2, axis=-1))
        waits = unix[i] - unix[earlier]
        return np.flatnonzero((along_the_ground(chords) <= max_speed * waits) & (waits > 0.0))

    for i in range(1, n):
        if direct[tip] if tip == i - 1 else reached(slice(tip, tip + 1), i).size:
            level[i], before[i] = level[tip] + 1, tip
        else:
            end = i
            while end > 0 and highest[end - 1] >= level[i]:
                some = slice(max(0, end - BLOCK), end)
                near = reached(some, i)
                if near.size:
                    best = near[np.argmax(level[some][near])]
                    if level[some][best] >= level[i]:
                        level[i], before[i] = level[some][best] + 1, some.start + best
                end = some.start
        highest[i] = max(highest[i - 1], level[i])
        tip = i if level[i] > level[tip] else tip
    kept = np.zeros(n, np.bool_)
    while tip >= 0:
        kept[tip] = True
        tip = int(before[tip])
    return kept


def _in_order(path: Path, fixes: Fixes) -> tuple[Fixes, list[str]]:
    """The fixes sorted by time, where sorting makes the path no longer: then it was the order that was wrong."""
    backwards = np.flatnonzero(np.diff(fixes.unix) < 0.0)
    if not backwards.size:
        return fixes, []
    in_order = fixes.where(np.argsort(fixes.unix, kind="stable"))
    as_written, by_time = (float(steps(each)[0].sum()) for each in (fixes, in_order))
    if by_time <= as_written * (1.0 + 1e-9) + 0.01:
        return in_order, [f"Fixes that stood after a later one were sorted by time: {backwards.size}."]
    first = backwards[0]
    stray = fixes.where(~_longest_rise(fixes.unix))
    lines = ", ".join(fixes.place(int(line)).rpartition(":")[2].strip("[]") for line in stray.line[:SHOWN])
    more = f" and {len(stray.line) - SHOWN} more" if len(stray.line) > SHOWN else ""
    few = len(stray.line) <= COARSE * len(fixes.line)
    raise TrackError(
        fixes.place(int(fixes.line[first + 1])),
        f"time goes backwards, from {iso(fixes.unix[first])} to {iso(fixes.unix[first + 1])}, and sorted by time "
        f"the path would be {by_time / 1e3:.1f} km instead of {as_written / 1e3:.1f} km",
        f"remove the {len(stray.line)} fixes whose times are wrong, at {lines}{more}; do not sort"
        if few
        else "check its clock (summer time?), or keep one vehicle if there are several",
    )


def _longest_rise(unix: NDArray[np.float64]) -> NDArray[np.bool_]:
    """The most fixes whose times never go backwards (patience sorting)."""
    ends: list[float] = []
    piles = []
    for time in unix.tolist():
        pile = bisect_right(ends, time)
        ends[pile : pile + 1] = [time]
        piles.append(pile)
    kept = np.zeros(len(unix), np.bool_)
    wanted = len(ends) - 1
    for i in range(len(unix) - 1, -1, -1):
        if piles[i] == wanted:
            kept[i] = True
            wanted -= 1
    return kept


def _without_twins(fixes: Fixes) -> tuple[Fixes, int]:
    """Without fixes that repeat time and place of the one before."""
    same = [np.diff(values) == 0.0 for values in (fixes.unix, fixes.lat, fixes.lon)]
    fresh = np.append(True, ~np.logical_and.reduce(same))
    return fixes.where(fresh), int(np.sum(~fresh))


def _check_times(path: Path, fixes: Fixes) -> None:
    repeated = int(np.sum(np.diff(fixes.unix) == 0.0))
    if repeated > COARSE * len(fixes.unix):
        raise TrackError(
            str(path),
            f"{repeated} of {len(fixes.unix)} fixes lie elsewhere at the time of the one before: "
            "the times have lost digits, or several vehicles are mixed",
            "export times with all their digits (not from a spreadsheet, not as 32-bit numbers), or one vehicle only",
        )


def _check_count(path: Path, fixes: Fixes, fix: str) -> None:
    if len(fixes.unix) < FEWEST:
        why = "".join(f" ({note.rstrip('.')})" for note in fixes.notes if note.startswith("Fixes dropped"))
        raise TrackError(str(path), f"{len(fixes.unix)} usable fix, but a track needs {FEWEST} or more{why}", fix)


def _note_repeated(count: int) -> list[str]:
    return [f"Fixes dropped for repeating the time of the one before: {count}."] if count else []


def _note_jumps(dropped: Fixes, max_speed: float) -> list[str]:
    count = len(dropped.unix)
    if not count:
        return []
    times = ", ".join(iso(unix) for unix in dropped.unix[:SHOWN])
    more = f" and {count - SHOWN} more" if count > SHOWN else ""
    return [f"Fixes dropped because only a speed above {max_speed:g} m/s could reach them: {count}, at {times}{more}."]
