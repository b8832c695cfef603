"""Everything that a batch of runs works on, in one block of the card's memory, and back."""

from collections.abc import Sequence
from ctypes import memmove
from typing import Any

import numpy as np

from shoal.compiler.packed import Form

_LINE = 128  # bytes that a card reads at once: what begins on such a line is never in two


class Arena:
    """Room on the card for nested NamedTuples of arrays; arrays that are one here are one there.

    Parameters
    ----------
    values : groups of NamedTuples, such as stage, memories and parameters of each run, all groups of the same types

    Attributes
    ----------
    columns : addresses on the card, an array for each NamedTuple of a group
    """

    def __init__(self, values: Sequence[tuple[Any, ...]]) -> None:
        from numba import cuda

        api: Any = cuda
        self._size = 0
        self._arrays = list(values)  # they live as long as their addresses are known here
        spans: dict[int, tuple[int, int]] = {}  # address here: offset there, bytes
        forms = [Form(value) for value in values[0]]
        parts = [[form.parts(value) for form, value in zip(forms, group, strict=True)] for group in values]
        for group in parts:
            for part in group:
                for array, here in zip(part.arrays, part.addresses, strict=True):
                    if here not in spans or spans[here][1] < array.nbytes:
                        spans[here] = self._take(array.nbytes), array.nbytes
        headers = np.array([[self._take(form.size) for form in forms] for _ in values])
        self._spans = [(here, there, size) for here, (there, size) in spans.items() if size]
        self._host = np.zeros(self._size, np.uint8)
        self._card = api.device_array(self._size, np.uint8)
        base = _address(self._card)
        for group, places in zip(parts, headers, strict=True):
            for form, part, place in zip(forms, group, places, strict=True):
                there = [base + spans[here][0] for here in part.addresses]
                self._host[place : place + form.size] = form.packed(part, there)
        self.addresses = base + headers
        self.columns = [api.to_device(np.ascontiguousarray(column)) for column in self.addresses.T]
        self.send()

    def _take(self, size: int) -> int:
        start = self._size
        self._size += -(-max(size, 1) // _LINE) * _LINE
        return start

    def send(self) -> None:
        """Copy all arrays to the card."""
        base = self._host.ctypes.data
        for here, there, size in self._spans:
            memmove(base + there, here, size)
        self._card.copy_to_device(self._host)

    def fetch(self) -> None:
        """Copy all arrays back from the card."""
        self._card.copy_to_host(self._host)
        base = self._host.ctypes.data
        for here, there, size in self._spans:
            memmove(here, base + there, size)


def _address(card: Any) -> int:
    """Where the first byte is on the card; a simulated one has the memory of the processor."""
    form = getattr(card, "__cuda_array_interface__", None) or card.__array_interface__
    return int(form["data"][0])
