"""The state of a stopped simulation as one file, which proves itself."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError, reason_of
from shoal.core.files import atomic_file

Arrays = Mapping[str, npt.NDArray[Any]]


def write_state(file: str | Path, identity: str, arrays: Arrays) -> None:
    """Write arrays and whose they are, atomically; replace a saved state of this name.

    Raises
    ------
    RecordError : it cannot be written, or something else has that name
    """
    checksum = _sum_of(identity, arrays)
    with atomic_file(file, ours=True) as partial, partial.open("wb") as stream:
        np.savez(stream, shoal=np.array(identity), sha256=np.array(checksum), **dict(arrays))  # type: ignore[arg-type]


def read_state(
    file: str | Path, identity: str, like: Arrays, optional: str = "tally."
) -> tuple[dict[str, npt.NDArray[Any]], list[str]]:
    """Return the arrays of a file, which have the shapes and types of those of `like`, and names that only one has.

    optional : with what those names begin that a file may lack, or have more of; it may hold no others

    Raises
    ------
    RecordError : no saved state, a damaged one, or one of something else
    """
    try:
        with Path(file).open("rb") as stream, np.load(stream) as state:
            owner = str(state["shoal"])
            if owner != identity:
                raise RecordError(str(file), f"was saved by {owner}, this is {identity}", "use the same scenario")
            held = {name for name in state.files if name not in ("shoal", "sha256")}
            lone = [name for name in sorted(held ^ like.keys()) if name.startswith(optional)]
            others = [name for name in sorted(held - like.keys()) if not name.startswith(optional)]
            if others:
                raise ValueError(f"it has {others[0]}, which is not part of it")
            saved = {name: state[name] for name in sorted(held | (like.keys() - set(lone)))}
            for name, mine in like.items():
                if name in saved and (saved[name].shape, saved[name].dtype) != (mine.shape, mine.dtype):
                    raise ValueError(f"{name} has another shape or type")
            if str(state["sha256"]) != _sum_of(identity, saved):
                raise ValueError("it is not what was written")
            return {name: each for name, each in saved.items() if name in like}, lone
    except RecordError:
        raise
    except Exception as error:  # whatever a damaged file does to those who read it
        problem = f"is not a saved state: {reason_of(error)}"
        raise RecordError(str(file), problem, "name a file made by Simulation.save") from error


def _sum_of(identity: str, arrays: Arrays) -> str:
    total = hashlib.sha256(identity.encode())
    for name in sorted(arrays):
        total.update(name.encode())
        total.update(np.ascontiguousarray(arrays[name]).tobytes())
    return total.hexdigest()
