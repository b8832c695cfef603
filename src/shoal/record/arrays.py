"""The arrays of a record: read only where they are what the record says they are."""

import hashlib
import math
import re
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np
import numpy.typing as npt

from shoal.metrics.contract import Facts
from shoal.metrics.tally import Tally, new_tally
from shoal.record.roster import Roster
from shoal.record.trajectory import OF_AGENTS, OF_TARGETS

_MOST_BATCHES = 1000
_LARGEST = 1e30  # of what a swarm can be, in m, m/s or the units of its memory
_AT_ONCE = 1_000_000  # values looked at together
_KINDS = (  # others are float64
    dict.fromkeys(("step", "neighbors"), np.int64)
    | dict.fromkeys(("on_target", "engaged", "alive", "target_present"), np.bool_)
    | {"links": np.uint8}
)
_SINCE_FORMAT_3 = ("command_x", "command_y", "engaged", "neighbors")
_LONGEST_NAME = 1000  # letters


def sum_of_file(file: Path) -> str:
    """SHA-256 of a file."""
    with file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


# --- roster ---


def read_roster(file: Path, agents: int, checksum: str | None) -> Roster:
    """Return what was chosen of N agents.

    Raises
    ------
    ValueError, OSError, BadZipFile and others of zipfile : damaged
    """
    if sum_of_file(file) != checksum:
        raise ValueError("roster.npz is not what was written")
    with zipfile.ZipFile(file) as archive:
        parts = {name: _read_chosen(archive, name, agents) for name in Roster._fields}
    return Roster(**parts)


def _read_chosen(archive: zipfile.ZipFile, name: str, agents: int) -> npt.NDArray[Any]:
    like = {"max_speed": "f8", "sensor_radius": "f8", "strategy": "U"}.get(name, "i8")
    with archive.open(f"{name}.npy") as stream:
        shape, kind = _header(stream)
        if shape != (agents,) or not (kind == like or (like == kind.kind and kind.itemsize <= 4 * _LONGEST_NAME)):
            raise ValueError(f"roster.npz: {name} is {shape} of {kind}")
        values = np.frombuffer(stream.read(agents * kind.itemsize), kind).copy()
    if values.size != agents or (like != "U" and not (np.isfinite(values) & (values >= 0)).all()):
        raise ValueError(f"roster.npz: {name} is cut short, or holds what no agent has")
    return values


# --- tallies ---


def read_tallies(
    file: Path, facts: Facts, *, targets: int, steps: int, runs: int, checksum: str | None
) -> tuple[Tally, ...]:
    """Return the tally of every run; nothing is read before its shape is known to be right.

    A sum that the file is older than is NaN; one of a package that is not installed is left where it is.

    Parameters
    ----------
    checksum : SHA-256 of the file, if it is known

    Raises
    ------
    ValueError, OSError, BadZipFile and others of zipfile : damaged
    """
    if checksum is not None and sum_of_file(file) != checksum:
        raise ValueError("tallies.npz is not what was written")
    with zipfile.ZipFile(file) as archive:
        names = set(archive.namelist())
        for run in range(runs):
            if f"{run}.batch_steps.npy" not in names:
                raise ValueError(f"tallies.npz has no run {run}, but there are {runs}")
        if any(not re.fullmatch(r"\d{1,9}\.\w+\.npy", name) or int(name.split(".")[0]) >= runs for name in names):
            raise ValueError(f"tallies.npz has more than the {runs} runs that record.json says")
        with archive.open("0.batch_steps.npy") as stream:
            shape, _ = _header(stream)
        if len(shape) != 1 or not 1 <= shape[0] <= min(steps, _MOST_BATCHES):
            raise ValueError(f"tallies.npz: {shape} batches of {steps} steps")
        empty = new_tally(steps, shape[0], len(facts.fleets), facts.agents, targets)
        return tuple(_read_tally(archive, names, run, empty) for run in range(runs))


def _read_tally(archive: zipfile.ZipFile, names: set[str], run: int, empty: Tally) -> Tally:
    parts = {}
    for name, like in zip(Tally._fields, empty, strict=True):
        file = f"{run}.{name}.npy"
        if file not in names:
            parts[name] = np.full(like.shape, np.nan)
            continue
        with archive.open(file) as stream:
            parts[name] = _read_like(stream, like, f"tallies.npz: {run}.{name}")
    tally = Tally._make(parts.values())
    if not np.array_equal(tally.batch_steps, empty.batch_steps) or not np.array_equal(tally.steps, empty.batch_steps):
        raise ValueError(f"tallies.npz: run {run} has not the steps of its scenario")
    return tally


def _read_like(stream: IO[bytes], like: npt.NDArray[Any], name: str) -> npt.NDArray[Any]:
    shape, kind = _header(stream)
    if (shape, kind) != (like.shape, like.dtype):
        raise ValueError(f"{name} is {shape} of {kind}, not {like.shape} of {like.dtype}")
    content = stream.read(like.nbytes + 1)
    if len(content) != like.nbytes:
        raise ValueError(f"{name} is cut short or too long")
    values = np.frombuffer(content, kind).reshape(shape).copy()
    if not np.isfinite(values).all() or (values < 0).any():
        raise ValueError(f"{name} holds a number that is not a sum")
    return values


# --- trajectories ---


def check_trajectory(files: Mapping[str, Path], agents: int, *, targets: int, complete: bool) -> None:
    """Refuse arrays of one run that are not frames of this many agents and targets, by their heads and sizes alone.

    complete : of the format of today, with all arrays

    Raises
    ------
    ValueError, OSError, KeyError : damaged
    """
    frames = _frames_of(files["step"])
    shapes: dict[str, tuple[int, ...]] = {"step": (frames,)}
    shapes |= {name: (frames, agents) for name in OF_AGENTS if complete or name not in _SINCE_FORMAT_3}
    shapes |= dict.fromkeys(OF_TARGETS, (frames, targets))
    shapes |= {name: (frames, agents) for name in files if name.startswith("memory.")}
    if complete:
        shapes["links"] = (frames, agents, _link_bytes(files["links"], agents))
    for name, shape in shapes.items():
        _check_file(files[name], shape, np.dtype(_KINDS.get(name, np.float64)))


def check_frames(arrays: Mapping[str, npt.NDArray[Any]], steps: int) -> None:
    """Refuse frames that are not in order, or that hold what is not a number.

    Raises
    ------
    ValueError : damaged
    """
    step = arrays["step"]
    if step.size and (step[0] < 0 or step[-1] > steps or (np.diff(step) <= 0).any()):
        raise ValueError("steps of the frames are not in order")
    for name, values in arrays.items():
        rows = max(1, _AT_ONCE // max(1, math.prod(values.shape[1:])))
        for start in range(0, len(values), rows):
            part = values[start : start + rows]
            if part.dtype == np.bool_:
                fine = (part.view(np.uint8) <= 1).all()
            else:
                fine = (np.abs(part) < _LARGEST).all()  # NaN is not
            if not fine:
                raise ValueError(f"{name} of the frames holds what is not a number")


def _link_bytes(file: Path, agents: int) -> int:
    """Bytes of an agent's links: as many as hold all agents, or none."""
    with file.open("rb") as stream:
        shape, _ = _header(stream)
    return 0 if shape[-1:] == (0,) else -(-agents // 8)


def _frames_of(file: Path) -> int:
    with file.open("rb") as stream:
        shape, _ = _header(stream)
    return int(shape[0]) if len(shape) == 1 else -1


def _check_file(file: Path, shape: tuple[int, ...], kind: np.dtype[Any]) -> None:
    name = f"{file.parent.name}/{file.name}"
    if not file.is_file():
        raise ValueError(f"{name} is not a file")
    with file.open("rb") as stream:
        found = _header(stream)
        begin = stream.tell()
    if found != (shape, kind):
        raise ValueError(f"{name} is {found[0]} of {found[1]}, not {shape} of {kind}")
    size = int(np.prod(shape, dtype=object)) * kind.itemsize
    if file.stat().st_size != begin + size:
        raise ValueError(f"{name} is cut short or too long")


def _header(stream: IO[bytes]) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Shape and type of an .npy file, as np.save writes them."""
    if np.lib.format.read_magic(stream) != (1, 0):
        raise ValueError("an array is in another version of the .npy format")
    shape, fortran, kind = np.lib.format.read_array_header_1_0(stream)
    if fortran or any(side < 0 for side in shape):
        raise ValueError(f"an array of shape {shape} is not in rows")
    return shape, kind
