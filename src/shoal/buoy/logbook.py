"""What one buoy keeps of its voyage: a CSV file, a row per step, that also is a track for maps and for Shoal."""

import csv
import time
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from shoal.core.errors import RecordError, reason_of
from shoal.core.geodesy import Frame
from shoal.core.messages import Reading

FIELDS = ("buoy", "step", "time", "lon", "lat", "x", "y", "vx", "vy", "on_target", "want_x", "want_y", "heard", "note")


class Logbook:
    """Writes a row as soon as it is known, so that nothing is lost with the computer.

    Each start makes a new file, DIR/buoy-7-20261127T060000.123Z.csv: nothing is written over. One without a row is gone
    at the end, as is DIR if it was made for it.

    Parameters
    ----------
    folder : DIR, which is made; None: nothing is kept
    id : number of the buoy
    frame : of the arena
    clock : UTC, in seconds since 1970

    Attributes
    ----------
    file : where it writes; None: nowhere

    Raises
    ------
    RecordError : it cannot be written
    """

    def __init__(
        self, folder: str | Path | None, id: int, frame: Frame, clock: Callable[[], float] = time.time
    ) -> None:
        self.file: Path | None = None
        self._id, self._frame, self._clock = id, frame, clock
        self._full = self._kept = False
        self._made: Path | None = None  # the folder, if it was not there
        self._stream: Any = None
        if folder is None:
            return
        now = self._now().replace("-", "").replace(":", "")
        self.file = Path(folder) / f"buoy-{id}-{now}.csv"
        try:
            self._made = None if Path(folder).exists() else Path(folder)
            Path(folder).mkdir(parents=True, exist_ok=True)
            self._stream = self.file.open("x", encoding="utf-8", newline="", buffering=1)
        except (OSError, ValueError) as error:
            problem = f"cannot be written: {reason_of(error)}"
            raise RecordError(str(self.file), problem, "name another folder with --out") from error
        self._rows = csv.writer(self._stream)
        self._write(FIELDS)
        self._kept = False

    def keep(self, step: int, reading: Reading, want: tuple[float, float], heard: int, note: str = "") -> None:
        """Keep what it measured, what it wanted [m/s], how many others it heard, and what befell it."""
        if self._stream is None:
            return
        lon, lat = self._frame.geographic(reading.x, reading.y)
        place = [f"{lon:.7f}", f"{lat:.7f}", *(f"{each:.3f}" for each in reading[:4])]
        wants = [f"{each:.3f}" for each in want]
        self._write([self._id, step, self._now(), *place, int(reading.on_target), *wants, heard, note])

    def lack(self, step: int, note: str) -> None:
        """Keep why nothing was measured in a step."""
        if self._stream is not None:
            self._write([self._id, step, self._now(), *[""] * 10, note])

    def _write(self, row: Any) -> None:
        """Write a row; on a full disk it is lost, and the buoy goes on."""
        try:
            self._rows.writerow(row)
            self._kept = True
        except OSError:
            self._full = True

    @property
    def full(self) -> bool:
        """Whether a row could not be written."""
        return self._full

    def close(self) -> None:
        """End it, and leave nothing behind if nothing was kept."""
        if self._stream is None:
            return
        try:
            self._stream.close()
        except OSError:
            self._full = True
        if self.file is not None and not (self._kept or self._full):
            with suppress(OSError):
                self.file.unlink(missing_ok=True)
                if self._made is not None:
                    self._made.rmdir()  # refuses where another buoy's log is in it

    def _now(self) -> str:
        return datetime.fromtimestamp(self._clock(), UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
