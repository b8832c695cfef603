"""Times as people write them, to unix seconds."""

import math
import re
from collections.abc import Callable, Sequence
from datetime import UTC, datetime, timedelta
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from shoal.core.errors import TrackError
from shoal.tracks.numbers import MISSING, number

FIRST_UNIX, LAST_UNIX = -62135596800.0, 253402300799.0  # [s] the years 1 to 9999
UNIX_UNITS = ((1e17, "nanoseconds", 1e-9), (1e14, "microseconds", 1e-6), (1e11, "milliseconds", 1e-3))
NAIVE = "Times without a time zone were taken as UTC."
MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")

CLOCK = (
    r"(?P<hour>\d{1,2}):?(?P<minute>\d\d)(?::?(?P<second>\d\d)(?:[.,](?P<fraction>\d+))?)?\s*(?P<half>[AaPp]\.?[Mm]\.?)?"
    r"\s*(?P<offset>[+-]\d\d:?\d\d)?\s*\(?(?P<utc>UTC|GMT|utc|gmt|Z|z)?\)?"
)
SPLIT = re.compile(
    r"(?:[A-Za-z]{3,9},?\s+)?(?P<a>\d{1,4}|[A-Za-z]{3,9})(?P<sign>[-/. ])(?P<b>\d{1,2}|[A-Za-z]{3,9}),?[-/. ]"
    rf"(?P<c>\d{{1,4}})(?:\s*[T ,_;]\s*{CLOCK})?",
    re.ASCII,
)
REGULAR = re.compile(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d:\d\d(\.\d{1,6})?Z?", re.ASCII)
COMPACT = re.compile(rf"(?P<a>(?:19|20)\d\d)(?P<b>[01]\d)(?P<c>[0-3]\d)\s*[T _-]?\s*{CLOCK}", re.ASCII)


class Stamp(NamedTuple):
    """A date and a time of day whose day and month may be either."""

    a: str
    b: str
    c: str
    sign: str
    seconds: float  # [s] since midnight UTC, by the clock and its offset
    naive: bool


def unix_times(
    texts: Sequence[str], where: Callable[[int], str], *, day_first: bool | None, layout: bool | None = None
) -> tuple[NDArray[np.float64], list[str]]:
    """Return unix times [s], NaN where empty, and what was assumed.

    Parameters
    ----------
    texts : as the file has them
    where : names the file and the line of texts[i]
    day_first : of dates such as 10/03/2024; None: inferred from the data
    layout : the same, as the file's layout suggests it; the data and `day_first` go before

    Raises
    ------
    TrackError : a time cannot be read, or its day and month cannot be told apart
    """
    texts = [text.strip() for text in texts]
    regular = _regular(texts)
    if regular is not None:
        return regular, [] if texts[0].endswith("Z") else [NAIVE]
    numbers = np.array([_plain(text) for text in texts])
    unix, notes = _scaled(numbers, where, texts)
    naive = False
    stamps: dict[int, Stamp] = {}
    for i in np.flatnonzero(np.isnan(unix)):
        text = texts[i]
        if text.lower() in MISSING:
            continue
        try:
            moment = datetime.fromisoformat(text)
        except ValueError:
            stamps[int(i)] = _stamp(text, where(int(i)))
            naive = naive or stamps[int(i)].naive
        else:
            naive = naive or moment.tzinfo is None
            unix[i] = (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()
    if stamps:
        notes += _fill(unix, stamps, texts, where, day_first, layout)
    return np.round(unix, 6), ([NAIVE] if naive else []) + notes


def iso(unix: float) -> str:
    """Return a unix time [s] in ISO 8601, UTC."""
    moment = datetime(1970, 1, 1, tzinfo=UTC) + timedelta(seconds=float(unix))
    return moment.isoformat().replace("+00:00", "Z")


def _regular(texts: Sequence[str]) -> NDArray[np.float64] | None:
    """Unix times [s] where all are written in one way, as in 2022-01-03T00:05:07Z; a million take a second."""
    zulu = bool(texts) and texts[0].endswith("Z")
    if not texts or not all(map(REGULAR.fullmatch, texts)) or any(text.endswith("Z") != zulu for text in texts):
        return None
    try:
        moments = np.array([text[:-1] for text in texts] if zulu else texts, dtype="datetime64[us]")
    except ValueError:
        return None
    return None if np.isnat(moments).any() else np.round(moments.astype(np.int64) / 1e6, 6)


def _plain(text: str) -> float:
    """The number that a text is; NaN for a date, also for one of 14 digits."""
    if ":" in text:
        return math.nan
    return math.nan if len(text) == 14 and COMPACT.fullmatch(text) else number(text)


def _scaled(
    numbers: NDArray[np.float64], where: Callable[[int], str], texts: Sequence[str]
) -> tuple[NDArray[np.float64], list[str]]:
    """Plain numbers as unix seconds, whatever the unit that their size tells."""
    known = np.abs(numbers[np.isfinite(numbers)])
    if not known.size:
        return np.where(np.isfinite(numbers), numbers, np.nan), []
    middle = float(np.median(known))
    unit, scale = next(((unit, scale) for least, unit, scale in UNIX_UNITS if middle >= least), ("seconds", 1.0))
    unix = numbers * scale
    outside = np.flatnonzero(~np.isnan(unix) & ~((unix >= FIRST_UNIX) & (unix <= LAST_UNIX)))
    if outside.size:
        raise TrackError(
            where(int(outside[0])),
            f"time {texts[outside[0]]} is not a Unix time in the years 1 to 9999",
            "write ISO 8601, such as 2022-01-03T00:05:07Z, or unix seconds",
        )
    return unix, [f"Times that are plain numbers were taken as unix {unit}."]


def _stamp(text: str, where: str) -> Stamp:
    found = COMPACT.fullmatch(text) or SPLIT.fullmatch(text)
    if found is None:
        raise _unreadable(text, where)
    part = found.groupdict()
    hour, minute, second = (int(part[name] or 0) for name in ("hour", "minute", "second"))
    half = (part["half"] or "").lower()
    if hour > (12 if half else 24) or minute > 59 or second > 60 or (half and not hour):
        raise _unreadable(text, where)
    hour = hour % 12 + 12 * half.startswith("p") if half else hour
    offset = part["offset"] or "+0000"
    ahead = int(offset[:3]) * 60 + int(offset[0] + offset[-2:])
    seconds = hour * 3600 + minute * 60 + second + float(f"0.{part['fraction'] or 0}") - ahead * 60
    naive = not (part["offset"] or part["utc"])
    return Stamp(part["a"], part["b"], part["c"], part.get("sign", ""), seconds, naive)


def _unreadable(text: str, where: str) -> TrackError:
    shown = text if len(text) <= 40 else text[:40] + "..."
    return TrackError(
        where,
        f"time {shown!r} cannot be read",
        "write ISO 8601, such as 2022-01-03T00:05:07Z, or unix seconds",
    )


def _fill(
    unix: NDArray[np.float64],
    stamps: dict[int, Stamp],
    texts: Sequence[str],
    where: Callable[[int], str],
    day_first: bool | None,
    layout: bool | None,
) -> list[str]:
    """Put the stamps among the times; the order of day and month is one for all."""
    doubtful = [i for i, stamp in stamps.items() if _is_doubtful(stamp)]
    first = _day_first(stamps, doubtful, texts, where, day_first, layout)
    for i, stamp in stamps.items():
        unix[i] = _unix(stamp, first, texts[i], where(i))
    if not doubtful:
        return []
    order = "day/month/year" if first else "month/day/year"
    return [f"Dates such as {texts[doubtful[0]].split()[0]} were read as {order}."]


def _is_doubtful(stamp: Stamp) -> bool:
    return len(stamp.a) < 3 and stamp.b.isdigit() and len(stamp.a) > 0 and stamp.a.isdigit()


def _day_first(
    stamps: dict[int, Stamp],
    doubtful: list[int],
    texts: Sequence[str],
    where: Callable[[int], str],
    asked: bool | None,
    layout: bool | None,
) -> bool:
    """Whether the day stands before the month: as asked for, or as only one order makes sense."""
    days = [i for i in doubtful if int(stamps[i].a) > 12]
    months = [i for i in doubtful if int(stamps[i].b) > 12]
    if days and months:
        raise TrackError(
            where(max(days[0], months[0])),
            f"date {texts[max(days[0], months[0])]!r} has another order of day and month than the lines before",
            "write ISO 8601, such as 2022-01-03T00:05:07Z",
        )
    if asked is not None or not doubtful:
        return bool(asked)
    if days or months:
        return bool(days)
    if stamps[doubtful[0]].sign == ".":
        return True
    orders = {first: [_unix(stamps[i], first, texts[i], where(i)) for i in doubtful] for first in (True, False)}
    if orders[True] == orders[False]:
        return True
    rising = {first: bool(np.all(np.diff(times) >= 0.0)) for first, times in orders.items()}
    if rising[True] != rising[False]:
        return rising[True]
    if layout is not None:
        return layout
    raise TrackError(
        where(doubtful[0]),
        f"date {texts[doubtful[0]].split()[0]} may be day/month or month/day, and no other line tells",
        "say which: --set targets.0.day_first=true (or false)",
    )


def _unix(stamp: Stamp, day_first: bool, text: str, where: str) -> float:
    """Unix time [s] of a stamp."""
    if len(stamp.a) > 2 and stamp.a.isdigit():
        year, month, day = stamp.a, stamp.b, stamp.c
    elif not stamp.a.isdigit():
        month, day, year = stamp.a, stamp.b, stamp.c
    elif day_first or not stamp.b.isdigit():
        day, month, year = stamp.a, stamp.b, stamp.c
    else:
        month, day, year = stamp.a, stamp.b, stamp.c
    if not month.isdigit():
        month = str(MONTHS.index(month[:3].lower()) + 1) if month[:3].lower() in MONTHS else "0"
    full_year = int(year) + (0 if len(year) > 2 else 2000 if int(year) < 70 else 1900)
    try:
        midnight = datetime(full_year, int(month), int(day), tzinfo=UTC)
    except ValueError:
        raise _unreadable(text, where) from None
    return midnight.timestamp() + stamp.seconds
