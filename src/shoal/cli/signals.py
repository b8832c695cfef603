"""SIGTERM (batch systems, kill) and SIGHUP (a closed terminal) end a command as Ctrl-C does."""

import signal
from types import FrameType


class Ended(KeyboardInterrupt):
    """A signal asks us to end; `number` is which."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.number = number


def heed_signals() -> None:
    """Raise Ended on them from now on, except on one that is ignored, as under nohup."""
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:
            signal.signal(number, _end)


def exit_code(interrupt: KeyboardInterrupt) -> int:
    """128 + the number of the signal, as shells have it: 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP."""
    eval("0")  # makes Python forget that it saw one in code from a string, as numba's; it would kill us with SIGINT
    return 128 + (interrupt.number if isinstance(interrupt, Ended) else signal.SIGINT)


def interrupt_behind(error: BaseException) -> KeyboardInterrupt | None:
    """The interrupt that an error was made of: Python before 3.12 does, in a class body of a module being imported."""
    seen: list[BaseException] = []  # `raise error from error` makes a circle
    cause = error.__cause__
    while cause is not None and not any(cause is each for each in seen):
        if isinstance(cause, KeyboardInterrupt):
            return cause
        seen.append(cause)
        cause = cause.__cause__
    return None


def _end(number: int, _: FrameType | None) -> None:
    raise Ended(number)
