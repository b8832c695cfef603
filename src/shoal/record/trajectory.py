"""Where everybody was: frames of one run, in memory or streamed to disk as plain .npy files."""

import hashlib
import io
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import numpy.typing as npt

from shoal.core.errors import UnknownNameError, no_attribute
from shoal.core.sheet import Sheet
from shoal.core.text import plain

OF_AGENTS = ("x", "y", "vx", "vy", "command_x", "command_y", "on_target", "engaged", "alive", "neighbors")
OF_TARGETS = ("target_x", "target_y", "target_present")
_PLAIN = ("step", *OF_AGENTS, "links", *OF_TARGETS)


@dataclass(frozen=True, repr=False)
class Trajectory:
    """K frames of one run, each what the engine knew at the start of a step. N agents, T targets.

    Attributes
    ----------
    step : (K,) number of the step
    x, y : (K, N) [m]; vx, vy : (K, N) [m/s] really made in the step before
    command_x, command_y : (K, N) [m/s] wanted in the step before, within the agent's limits, before the wall
    on_target : (K, N) what an agent believes and reports; engaged : (K, N) it is on a present target
    alive : (K, N) it is there; neighbors : (K, N) the k in force
    links : (K, N, W) whom agents really hear in the step, as bits: see `shoal.record.frames.who_hears_whom`
    target_x, target_y : (K, T) [m]; target_present : (K, T)
    memory : {field: (K, N)} what agents remembered, in the units of the strategy's memory
    """

    step: npt.NDArray[np.int64]
    x: npt.NDArray[np.float64]
    y: npt.NDArray[np.float64]
    vx: npt.NDArray[np.float64]
    vy: npt.NDArray[np.float64]
    command_x: npt.NDArray[np.float64]
    command_y: npt.NDArray[np.float64]
    on_target: npt.NDArray[np.bool_]
    engaged: npt.NDArray[np.bool_]
    alive: npt.NDArray[np.bool_]
    neighbors: npt.NDArray[np.int64]
    links: npt.NDArray[np.uint8]
    target_x: npt.NDArray[np.float64]
    target_y: npt.NDArray[np.float64]
    target_present: npt.NDArray[np.bool_]
    memory: dict[str, npt.NDArray[np.float64]]

    def __post_init__(self) -> None:
        object.__setattr__(self, "memory", _Memory(self.memory))

    def __repr__(self) -> str:
        """One line: how many frames of what."""
        return f"<Trajectory {self._head()}>"

    def _repr_html_(self) -> str:
        """The arrays and their shapes for a notebook."""
        rows = [(name, " x ".join(map(str, each.shape)), str(each.dtype)) for name, each in self.arrays().items()]
        return Sheet(f"Trajectory {self._head()}", ("array", "shape", "type"), rows, words=("array",)).html()

    def _head(self) -> str:
        (frames, agents), targets = self.x.shape, self.target_x.shape[1]
        steps = f" of steps {self.step[0]:,} to {self.step[-1]:,}" if frames else ""
        memory = f"; memory: {plain(', '.join(self.memory))}" if self.memory else ""
        return f"of {frames:,} frames{steps}: {agents} agents, {targets} target{'s' * (targets != 1)}{memory}"

    if not TYPE_CHECKING:  # hidden from type checkers, which know the names

        def __getattr__(self, name: str) -> Any:
            raise no_attribute("a Trajectory", name, (*_PLAIN, "memory", "arrays"))

    def arrays(self) -> dict[str, npt.NDArray[Any]]:
        """All arrays by name; memory fields as memory.NAME."""
        plain = {name: getattr(self, name) for name in _PLAIN}
        return plain | {f"memory.{name}": values for name, values in self.memory.items()}

    @classmethod
    def from_arrays(cls, arrays: dict[str, npt.NDArray[Any]]) -> "Trajectory":
        """Inverse of `arrays`."""
        memory = {name.removeprefix("memory."): each for name, each in arrays.items() if name.startswith("memory.")}
        return cls(**{name: arrays[name] for name in _PLAIN}, memory=memory)

    @classmethod
    def from_frames(cls, frames: Any, fields: Iterable[str]) -> "Trajectory":
        """The frames that the engine filled (engine/stage.py); `fields` are the strategy's memory."""
        plain = {name: getattr(frames, name) for name in _PLAIN}
        return cls(**plain, memory={name: np.ascontiguousarray(frames.memory[..., m]) for m, name in enumerate(fields)})

    @classmethod
    def join(cls, parts: list["Trajectory"]) -> "Trajectory":
        """Consecutive parts as one."""
        arrays = [part.arrays() for part in parts]
        return cls.from_arrays({name: np.concatenate([each[name] for each in arrays]) for name in arrays[0]})


class _Memory(dict[str, npt.NDArray[np.float64]]):
    """Fields by name; a missing one is answered with those that exist."""

    def __missing__(self, name: str) -> npt.NDArray[np.float64]:
        raise UnknownNameError.of("memory", name, self)


class TrajectoryWriter:
    """Appends frames to one .npy file per array; memory does not grow with the number of frames.

    The files announce `frames` frames from the start, so they are complete .npy files once that many are written.
    """

    def __init__(self, folder: Path, frames: int) -> None:
        self._folder = folder
        self._frames = frames
        self._files: dict[str, BinaryIO] = {}
        self._sums: dict[str, Any] = {}
        folder.mkdir(parents=True)

    def append(self, part: Trajectory) -> None:
        """Write the frames of one chunk."""
        for name, values in part.arrays().items():
            if name not in self._files:
                self._files[name] = (self._folder / f"{name}.npy").open("wb")
                self._sums[name] = hashlib.sha256()
                self._write(name, _head(values.dtype, (self._frames, *values.shape[1:])))
            self._write(name, np.ascontiguousarray(values).tobytes())

    def close(self) -> None:
        """Flush and close the files."""
        for file in self._files.values():
            file.close()

    def cut(self, frames: int) -> None:
        """Let the closed files hold fewer frames than were announced: these, of those that were written."""
        for name in self._files:
            with (self._folder / f"{name}.npy").open("r+b") as file:
                np.lib.format.read_magic(file)
                shape, _, dtype = np.lib.format.read_array_header_1_0(file)
                file.truncate(file.tell() + frames * int(np.prod(shape[1:])) * dtype.itemsize)
                file.seek(0)
                file.write(_head(dtype, (frames, *shape[1:])))
                file.seek(0)
                self._sums[name] = hashlib.file_digest(file, "sha256")

    def sums(self) -> dict[str, str]:
        """SHA-256 of every file, by the name of its array."""
        return {name: each.hexdigest() for name, each in self._sums.items()}

    def _write(self, name: str, content: bytes) -> None:
        self._files[name].write(content)
        self._sums[name].update(content)


def _head(dtype: np.dtype[Any], shape: tuple[int, ...]) -> bytes:
    """The header of an .npy file; it has the same length whatever the number of frames."""
    head = io.BytesIO()
    described = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(head, described)
    return head.getvalue()
