"""Python looks for garbage rarely while numba compiles: of the millions of objects that it makes, most stay."""

import gc
import threading

RARELY = (100_000, 50, 1000)  # thresholds of gc; by default 700 new objects make it look, and often at all there are

_LOCK = threading.Lock()
_before: list[tuple[int, int, int]] = []  # of each who compiles, or waits to


def look_rarely() -> None:
    """From now on, until as many calls of `look_as_before`; who looks more rarely, or never, is left alone."""
    with _LOCK:
        now = gc.get_threshold()
        _before.append(now)
        if now[0] > 0:  # else it never looks
            gc.set_threshold(*map(max, now, RARELY))


def look_as_before() -> None:
    """Whoever is the last to end lets Python look as often as before; who began before anybody heard is passed over."""
    with _LOCK:
        if len(_before) == 1:
            gc.set_threshold(*_before[0])
        del _before[-1:]
