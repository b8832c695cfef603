"""What the engine adds up while it runs, and nothing more: sums per batch of steps, so memory is constant."""

from collections import namedtuple
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from shoal.metrics.catalogue import MEASUREMENTS
from shoal.metrics.contract import Sum

SUMS = {each.name: each for measurement in MEASUREMENTS for each in measurement.sums}

if TYPE_CHECKING:

    class Tally(tuple[npt.NDArray[Any], ...]):
        """As type checkers see it: whatever sum is asked for is an array."""

        _fields: ClassVar[tuple[str, ...]]

        def __getattr__(self, name: str) -> npt.NDArray[Any]: ...
        @classmethod
        def _make(cls, parts: Iterable[npt.NDArray[Any]]) -> Self: ...
        def _replace(self, **parts: npt.NDArray[Any]) -> Self: ...
        def _asdict(self) -> dict[str, npt.NDArray[Any]]: ...

else:
    Tally = namedtuple("Tally", ["batch_steps", *SUMS])
    Tally.__doc__ = "\n".join(
        [
            "Sums over the steps of each of B batches of consecutive steps, for batch means.",
            "",
            "batch_steps : (batch,) steps planned",
            *(
                f"{each.name} : ({', '.join(map(str, each.shape))}) [{each.unit}] {each.sentence}"
                for each in SUMS.values()
            ),
        ]
    )


def new_tally(steps: int, batches: int, fleets: int, agents: int, targets: int) -> Tally:
    """Return an empty tally of a run."""
    edges = -(-np.arange(batches + 1) * steps // batches)  # step s belongs to batch s * batches // steps
    sizes = {"batch": batches, "run": 1, "fleet": fleets, "agent": agents, "target": targets}
    return Tally._make([np.diff(edges).astype(float), *(_empty(each, sizes) for each in SUMS.values())])


def batch_of(tally: Tally, batch: int) -> Tally:
    """The sums of one batch, as a tally of its own (B = 1); what is kept for the run is in it, too."""
    return Tally._make(
        part[batch : batch + 1] if of_batches(name) else part for name, part in zip(Tally._fields, tally, strict=True)
    )


def never_counted(like: npt.NDArray[Any], name: str) -> float:
    """What a column of a tally holds that was counted in a part of a run only: NaN, but of whole numbers."""
    return float("nan") if like.dtype.kind == "f" else SUMS[name].start


def of_batches(name: str) -> bool:
    """Whether a column has a row per batch of steps, rather than one for the run."""
    return name not in SUMS or SUMS[name].shape[0] == "batch"


def _empty(each: Sum, sizes: dict[str, int]) -> npt.NDArray[Any]:
    shape = [sizes[part] if isinstance(part, str) else part for part in each.shape]
    return np.full(shape, each.start, np.int64 if each.integer else np.float64)
