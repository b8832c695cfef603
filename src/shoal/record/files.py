"""A record on disk: a folder with record.json, roster.npz, tallies.npz and one folder of .npy files per recorded run.

It is complete or absent (core/files.py), and says its own checksums: what was damaged later is refused.
"""

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np

from shoal.core.errors import RecordError, reason_of
from shoal.core.files import AtomicFolder
from shoal.metrics.contract import Facts
from shoal.record.arrays import check_frames, check_trajectory, read_roster, read_tallies, sum_of_file
from shoal.record.content import FORMAT, RecordContent, read_content, sum_of_content
from shoal.record.older import completed, roster_from
from shoal.record.record import Record
from shoal.record.roster import Roster
from shoal.record.trajectory import Trajectory, TrajectoryWriter

LOG = "changes.jsonl"  # of a run that was steered, beside its record


class RecordFolder:
    """A record being written; use it as a context and `finish` it, or nothing is left.

    Raises
    ------
    RecordError : the folder exists and is not empty, is being written by another process, or cannot be written
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self._whole = AtomicFolder(folder, last="record.json")
        self._writers: dict[str, TrajectoryWriter] = {}
        self._texts: list[str] = []

    def __enter__(self) -> Self:
        self._whole.__enter__()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._whole.__exit__(kind, error, trace)

    def trajectory(self, run: int, frames: int) -> TrajectoryWriter:
        """Return a writer for the frames of a run."""
        name = f"run-{run:04d}"
        self._writers[name] = TrajectoryWriter(self._whole.partial / name, frames)
        return self._writers[name]

    def add(self, name: str, text: str) -> None:
        """Put a text beside the record."""
        (self._whole.partial / name).write_text(text, encoding="utf-8")
        self._texts.append(name)

    def finish(self, record: Record) -> Record:
        """Write what is left, give everything its place, and return the record as it is on disk."""
        for run, trajectory in record.trajectories.items():
            writer = self.trajectory(run, trajectory.step.size)
            writer.append(trajectory)
            writer.close()
        tallies = {
            f"{run}.{name}": part
            for run, tally in enumerate(record.tallies)
            for name, part in tally._asdict().items()
            if np.isfinite(part).all()  # NaN where it was not counted
        }
        np.savez(self._whole.partial / "tallies.npz", **tallies)  # type: ignore[arg-type]
        np.savez(self._whole.partial / "roster.npz", **record.roster._asdict())
        plain = ("roster.npz", "tallies.npz", *self._texts)
        content: dict[str, Any] = {
            "format": FORMAT,
            "summary": record.summary(),
            "provenance": record.provenance,
            "facts": record.facts._asdict(),
            "scenario": record.scenario.model_dump(mode="json"),
            "sha256": {
                **{name: sum_of_file(self._whole.partial / name) for name in plain},
                **{
                    f"{folder}/{name}.npy": each
                    for folder, writer in sorted(self._writers.items())
                    for name, each in writer.sums().items()
                },
            },
        }
        content = json.loads(json.dumps(content))  # as it will be read
        content["checksum"] = sum_of_content(content)
        (self._whole.partial / "record.json").write_text(json.dumps(content, indent=1), encoding="utf-8")
        self._whole.finish()
        return open_record(self.folder)


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

    Records of all results versions open; provenance["results_version"] says of which the numbers are.

    Raises
    ------
    RecordError : not a record's folder, one of a newer Shoal, or a damaged one; of frames also when they are first used
    """
    folder = Path(folder)
    try:
        if not (folder / "record.json").is_file():
            raise RecordError(str(folder), "is not a record (it has no record.json)", "name a folder made by --out")
        content = read_content(folder / "record.json")
        facts = Facts(**{name: _plain(part) for name, part in content.facts})
        if content.format < 3:
            roster = roster_from(content.scenario)
        else:
            roster = read_roster(folder / "roster.npz", facts.agents, content.checksum_of("roster.npz"))
        tallies = read_tallies(
            folder / "tallies.npz",
            facts,
            targets=len(content.scenario.targets),
            steps=content.scenario.steps,
            runs=content.summary.runs,
            checksum=content.checksum_of("tallies.npz"),
        )
        if LOG in (content.sha256 or {}) and sum_of_file(folder / LOG) != content.checksum_of(LOG):
            raise ValueError(f"{LOG} is not what was written")
        trajectories = KeptTrajectories(folder, content, roster)
        return Record(content.scenario, facts, roster, tallies, content.raw["provenance"], trajectories)
    except RecordError:
        raise
    except Exception as error:  # whatever a damaged file does to those who read it
        raise _damaged(folder, error) from error


class KeptTrajectories(Mapping[int, Trajectory]):
    """The trajectories of a record on disk: their shapes are checked here, each one's numbers when it is first used."""

    def __init__(self, folder: Path, content: RecordContent, roster: Roster) -> None:
        self._folder = folder
        self._content = content
        self._roster = roster
        self._opened: dict[int, Trajectory] = {}
        self._files = {run: self._files_of(run) for run in _runs_in(folder, content)}
        for files in self._files.values():
            check_trajectory(
                files, roster.fleet.size, targets=len(content.scenario.targets), complete=content.format >= 3
            )

    def __getitem__(self, run: int) -> Trajectory:
        if run not in self._opened:
            self._opened[run] = self._open(run)
        return self._opened[run]

    def __iter__(self) -> Iterator[int]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def __contains__(self, run: object) -> bool:
        return run in self._files

    def _files_of(self, run: int) -> dict[str, Path]:
        """Where each array of a run is."""
        name = _name_of(run)
        if self._content.sha256 is None:
            found = [file.name for file in (self._folder / name).iterdir() if file.suffix == ".npy"]
        else:
            found = [file.split("/")[1] for file in self._content.sha256 if file.startswith(f"{name}/")]
        return {file.removesuffix(".npy"): self._folder / name / file for file in sorted(found)}

    def _open(self, run: int) -> Trajectory:
        try:
            for file in self._files[run].values():
                wanted = self._content.checksum_of(f"{_name_of(run)}/{file.name}")
                if wanted is not None and sum_of_file(file) != wanted:
                    raise ValueError(f"{_name_of(run)}/{file.name} is not what was written")
            arrays = {name: np.load(file, mmap_mode="r") for name, file in self._files[run].items()}
            check_frames(arrays, self._content.scenario.steps)
            if self._content.format < 3:
                arrays = completed(arrays, self._content.scenario, self._roster)
            return Trajectory.from_arrays(arrays)
        except Exception as error:  # as in open_record
            raise _damaged(self._folder, error) from error


def _runs_in(folder: Path, content: RecordContent) -> list[int]:
    """Numbers of the runs that kept frames."""
    if content.sha256 is None:
        names = {each.name for each in folder.glob("run-*")}
    else:
        names = {file.split("/")[0] for file in content.sha256 if "/" in file}
    for name in names:
        if not re.fullmatch(r"run-\d{4,9}", name) or int(name[4:]) >= content.summary.runs:
            raise ValueError(f"it has {name}, but {content.summary.runs} runs")
    return sorted(int(name[4:]) for name in names)


def _name_of(run: int) -> str:
    return f"run-{run:04d}"


def _plain(part: Any) -> Any:
    return tuple(part) if isinstance(part, list) else part


def _damaged(folder: Path, error: Exception) -> RecordError:
    return RecordError(
        str(folder), f"is damaged: {reason_of(error)}", "take it from a backup, or run the scenario again"
    )
