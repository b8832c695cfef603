"""Parts of a variable of a NetCDF file, read without the rest."""

import itertools
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from shoal.sea.components import text

AT_ONCE = 4_000_000  # values read in one go
MOST_SPEED = 100.0  # [m/s] what is faster is a mark for missing, such as 1e20, -9999 or 9.97e36
MISSING = "_FillValue", "missing_value"


def read(variable: Any, at: Mapping[str, Any]) -> NDArray[np.float64]:
    """Return part of a variable, unpacked, NaN where missing; its dimensions in the order of the file.

    Parameters
    ----------
    at : for each dimension an index, which drops it, or indices that rise or fall by one, but for a seam
    """
    chosen = [at[name] for name in variable.dimensions]
    runs = [[each] if np.ndim(each) == 0 else list(_runs(each)) for each in chosen]
    kept = [i for i, each in enumerate(chosen) if np.ndim(each)]
    joined: dict[tuple[int, ...], Any] = {}
    for index in itertools.product(*(range(len(each)) for each in runs)):
        parts = [run[i] for run, i in zip(runs, index, strict=True)]
        values = _unpacked(variable, tuple(_forward(each) for each in parts))
        flips = tuple(slice(None, None, -1 if isinstance(parts[i], slice) and parts[i].step == -1 else 1) for i in kept)
        joined[index] = values[flips]
    for axis in reversed(kept):  # seams are joined one dimension after the other
        by_rest: dict[tuple[int, ...], list[Any]] = {}
        for index, values in joined.items():
            by_rest.setdefault((*index[:axis], 0, *index[axis + 1 :]), []).append(values)
        joined = {index: np.concatenate(parts, axis=kept.index(axis)) for index, parts in by_rest.items()}
    (result,) = joined.values()
    return np.asarray(result, np.float64)


def read_speeds(
    variable: Any, at: Mapping[str, Any], order: tuple[str, ...], scale: float
) -> tuple[NDArray[np.float32], int]:
    """Return speeds [m/s] over (time, row, column), some times at once, and how many were marks for missing.

    Parameters
    ----------
    at : as `read`
    order : dimensions of time, rows and columns; that of time may be "", if there is none
    scale : [m/s] per unit
    """
    time, row, column = order
    shape = (len(at[time]) if time else 1, len(at[row]), len(at[column]))
    axes = [name for name in variable.dimensions if np.ndim(at[name])]
    turned = [axes.index(name) for name in order if name]
    result = np.empty(shape, np.float32)
    marks = 0
    step = max(1, AT_ONCE // max(1, shape[1] * shape[2]))
    for start in range(0, shape[0], step):
        times = slice(start, start + step)
        part = {**at, time: at[time][times]} if time else at
        values = np.transpose(read(variable, part), turned).reshape(-1, *shape[1:]) * scale
        with np.errstate(invalid="ignore"):
            absurd = ~(np.abs(values) <= MOST_SPEED) & ~np.isnan(values)
        marks += int(absurd.sum())
        values[absurd] = np.nan
        result[times] = values
    return result, marks


def _runs(index: NDArray[np.intp]) -> Iterator[slice]:
    """Consecutive stretches of indices, as slices of step 1 or -1."""
    index = np.asarray(index)
    ends = [0, *(np.flatnonzero(np.diff(index) != _direction(index)) + 1).tolist(), len(index)]
    for start, end in itertools.pairwise(ends):
        part = index[start:end]
        step = _direction(part)
        yield slice(int(part[0]), int(part[-1]), step)


def _direction(index: NDArray[np.intp]) -> int:
    """Whether most indices rise or fall."""
    return -1 if len(index) > 1 and np.median(np.sign(np.diff(index))) < 0 else 1


def _forward(part: Any) -> Any:
    """A slice from its first to its last index, upward; an index as it is."""
    if not isinstance(part, slice):
        return int(part)
    return slice(min(part.start, part.stop), max(part.start, part.stop) + 1)


def _unpacked(variable: Any, key: tuple[Any, ...]) -> NDArray[np.float64]:
    """Values of a hyperslab, NaN where missing; the lowest integers are marks where the file names none."""
    undeclared = variable.dtype.kind == "i" and not any(hasattr(variable, name) for name in MISSING)
    if not undeclared:
        values = np.ma.asarray(variable[key])
        return np.asarray(np.ma.filled(values.astype(np.float64), np.nan))
    variable.set_auto_maskandscale(False)
    try:
        raw = np.asarray(variable[key])
    finally:
        variable.set_auto_maskandscale(True)
    scale, offset = (
        float(text(variable, name) or default) for name, default in (("scale_factor", 1), ("add_offset", 0))
    )
    return np.where(raw <= np.iinfo(raw.dtype).min + 1, np.nan, raw * scale + offset)
