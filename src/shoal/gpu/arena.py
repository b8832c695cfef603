"""Everything that a batch of runs works on, in one block of the card's memory, and back."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.compiler.packed import packed

_LINE = 128  # bytes that a card reads at once: what begins on such a line is never in two


class Arena:
    """Room on the card for nested NamedTuples of arrays; arrays that are one here are one there.

    Parameters
    ----------
    values : groups of NamedTuples, as (runs) rows of (stage, memories, parameters)

    Attributes
    ----------
    addresses : (groups, 3) where each of them is, on the card
    """

    def __init__(self, values: Sequence[tuple[Any, ...]]) -> None:
        from numba import cuda

        api: Any = cuda
        self._arrays: dict[int, tuple[int, Any]] = {}  # by where they are here: the offset there, the array
        self._size = 0
        for group in values:
            for array in arrays_in(group):
                self._place(array)
        headers = [[self._take(packed(value, _nowhere).nbytes) for value in group] for group in values]
        self._host = np.zeros(self._size, np.uint8)
        self._card = api.device_array(self._size, np.uint8)
        base = _address(self._card)
        for group, places in zip(values, headers, strict=True):
            for value, place in zip(group, places, strict=True):
                form = packed(value, lambda array: base + self._arrays[_key(array)][0])
                self._host[place : place + form.nbytes] = form
        self.addresses = base + np.array(headers, np.int64)
        self.send()

    def _take(self, size: int) -> int:
        start = self._size
        self._size += -(-max(size, 1) // _LINE) * _LINE
        return start

    def _place(self, array: Any) -> None:
        key = _key(array)
        if key not in self._arrays or self._arrays[key][1].nbytes < array.nbytes:
            self._arrays[key] = (self._take(array.nbytes), array)

    def send(self) -> None:
        """Copy all arrays to the card."""
        for start, array in self._arrays.values():
            self._part(start, array)[...] = array
        self._card.copy_to_device(self._host)

    def fetch(self) -> None:
        """Copy all arrays back from the card."""
        self._card.copy_to_host(self._host)
        for start, array in self._arrays.values():
            array[...] = self._part(start, array)

    def _part(self, start: int, array: Any) -> npt.NDArray[Any]:
        here: npt.NDArray[Any] = self._host[start : start + array.nbytes]
        whole: npt.NDArray[Any] = here.view(array.dtype).reshape(array.shape)
        return whole


def arrays_in(value: Any) -> Iterator[Any]:
    """All arrays in nested tuples."""
    if isinstance(value, np.ndarray):
        yield np.asarray(value)
    elif isinstance(value, tuple):
        for each in value:
            yield from arrays_in(each)


def _nowhere(array: Any) -> int:
    return 0


def _address(card: Any) -> int:
    """Where the first byte is on the card; a simulated one has the memory of the processor."""
    form = getattr(card, "__cuda_array_interface__", None) or card.__array_interface__
    return int(form["data"][0])


def _key(array: Any) -> int:
    return int(array.ctypes.data)
