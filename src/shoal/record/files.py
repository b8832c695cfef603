"""A record on disk: a folder with record.json, tallies.npz and one folder of .npy files per recorded run.

Everything is written into FOLDER.partial, which takes its name only when complete: a full disk or an interrupt
leaves nothing that looks like a record.
"""

import json
import shutil
from pathlib import Path
from types import TracebackType
from typing import Self
from zipfile import BadZipFile

import numpy as np

from shoal.core.errors import RecordError
from shoal.metrics.summary import Facts
from shoal.metrics.tally import Tally
from shoal.record.record import Record
from shoal.record.trajectory import Trajectory, TrajectoryWriter


class RecordFolder:
    """A record being written; use it as a context and `finish` it, or nothing is left.

    Raises
    ------
    RecordError : the folder exists and is not empty, or cannot be written
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self._partial = self.folder.with_name(self.folder.name + ".partial")
        self._done = False

    def __enter__(self) -> Self:
        if self.folder.exists() and (not self.folder.is_dir() or any(self.folder.iterdir())):
            raise RecordError(str(self.folder), "exists already", "name another folder, or remove this one first")
        try:
            shutil.rmtree(self._partial, ignore_errors=True)
            self._partial.mkdir(parents=True)
        except OSError as error:
            raise self.unwritable(error) from error
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self._done:
            shutil.rmtree(self._partial, ignore_errors=True)
        if isinstance(error, OSError):
            raise self.unwritable(error) from error

    def trajectory(self, run: int, frames: int) -> TrajectoryWriter:
        """Return a writer for the frames of a run."""
        return TrajectoryWriter(self._partial / _run_name(run), frames)

    def finish(self, record: Record) -> Record:
        """Write what is left, give the folder its name, and return the record as it is on disk."""
        for run, trajectory in record.trajectories.items():
            writer = self.trajectory(run, trajectory.step.size)
            writer.append(trajectory)
            writer.close()
        tallies = {
            f"{run}.{name}": part
            for run, tally in enumerate(record.tallies)
            for name, part in zip(Tally._fields, tally, strict=True)
        }
        np.savez(self._partial / "tallies.npz", **tallies)  # type: ignore[arg-type]
        content = {
            "format": 1,
            "summary": record.summary(),
            "provenance": record.provenance,
            "facts": record.facts._asdict(),
            "scenario": record.scenario,
        }
        (self._partial / "record.json").write_text(json.dumps(content, indent=1), encoding="utf-8")
        if self.folder.exists():
            self.folder.rmdir()
        self._partial.rename(self.folder)
        self._done = True
        return open_record(self.folder)

    def unwritable(self, error: OSError) -> RecordError:
        """The one error for every reason that the disk gives."""
        return RecordError(
            str(self.folder),
            f"cannot be written: {error.strerror or error}",
            "free space, or name a folder you may write",
        )


def save_record(record: Record, folder: str | Path) -> None:
    """Write a record to a new folder.

    Raises
    ------
    RecordError : the folder exists and is not empty, or cannot be written; nothing is left half-written
    """
    with RecordFolder(folder) as writer:
        writer.finish(record)


def open_record(folder: str | Path) -> Record:
    """Read a record; trajectories stay on disk until they are used.

    Raises
    ------
    RecordError : not a record's folder, or a damaged one
    """
    folder = Path(folder)
    if not (folder / "record.json").is_file():
        raise RecordError(str(folder), "is no record (it has no record.json)", "name a folder made by --out")
    try:
        content = json.loads((folder / "record.json").read_text(encoding="utf-8"))
        facts = Facts._make(tuple(part) if isinstance(part, list) else part for part in content["facts"].values())
        with (folder / "tallies.npz").open("rb") as stream, np.load(stream) as arrays:
            tallies = tuple(
                Tally(*(arrays[f"{run}.{name}"] for name in Tally._fields)) for run in range(content["summary"]["runs"])
            )
        trajectories = {int(each.name[4:]): Trajectory.open(each) for each in sorted(folder.glob("run-*"))}
        return Record(content["scenario"], facts, tallies, content["provenance"], trajectories)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, EOFError, BadZipFile) as error:
        raise RecordError(str(folder), f"is damaged: {error}", "run the scenario again into a new folder") from error


def _run_name(run: int) -> str:
    return f"run-{run:04d}"
