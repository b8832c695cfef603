"""python -m shoal, and the shoal command: Ctrl-C is one line from the first moment on, not a traceback."""

import gc
import os
import signal
import sys
from typing import Any

NEEDED = ("cyclopts", "rich")  # a library without a command line does without them
COLLECT_AFTER = 100_000  # new objects: Python looks for garbage after 700, a sixth of a start in which there is none


def main() -> None:
    """Run the command line and exit; docs/reference/cli.md has the codes."""
    gc.set_threshold(COLLECT_AFTER)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # matrices are small, and runs have threads of their own
    heeded = signal.getsignal(signal.SIGINT) is signal.default_int_handler  # not under nohup
    if heeded:
        signal.signal(signal.SIGINT, _leave)  # while what is imported below takes half a second
    try:
        from shoal.cli.main import run_command
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] not in NEEDED:
            raise
        sys.stderr.write(f"shoal: {error.name}: is not installed, and the command line needs it\n")
        sys.stderr.write(f"  fix: pip install {' '.join(NEEDED)}\n")
        sys.exit(2)
    from shoal.cli.signals import heed_signals

    heed_signals()
    if heeded:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    code = run_command(sys.argv[1:])
    if heeded:
        signal.signal(signal.SIGINT, _leave)
    sys.exit(code)


def _leave(*_: Any) -> None:
    os.write(2, b"shoal: interrupted\n")
    os._exit(130)


if __name__ == "__main__":
    main()
