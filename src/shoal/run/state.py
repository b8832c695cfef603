"""All that changes in a run, and nothing else: what is saved, restored, carried over and edited is this, whole.

No list of fields is kept anywhere: a field that Bodies, Air, the state of a target or Tally gains is part of it.
"""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from shoal.core.agents import Bodies, part_of
from shoal.metrics.tally import Tally
from shoal.world.disturbances.contract import Nature, Weather
from shoal.world.radio import Air
from shoal.world.targets.catalogue import TARGET_STATE


class State(NamedTuple):
    """What N agents, T targets and nature do, what is on the air, the sums so far. Arrays are shared with the engine.

    targets : (T,) records with the fields of TARGET_STATE
    """

    swarm: Bodies
    air: Air
    targets: npt.NDArray[Any]
    weather: Weather
    tally: Tally


def state_of(swarm: Any, radio: Any, targets: npt.NDArray[Any], nature: Nature, tally: Tally) -> State:
    """The state in what the engine works on."""
    doing = targets[list(TARGET_STATE.names or ())]
    return State(part_of(swarm, Bodies), part_of(radio, Air), doing, part_of(nature, Weather), tally)


def arrays_of(value: Any, name: str = "") -> Iterator[tuple[str, npt.NDArray[Any]]]:
    """Name and array of everything in nested NamedTuples, such as swarm.x; of records, name and array of each field."""
    if isinstance(value, np.ndarray):
        if value.dtype.names is None:
            yield name, value
        else:
            for field in value.dtype.names:
                yield f"{name}.{field}", np.asarray(value[field])
    else:
        for field, each in zip(value._fields, value, strict=True):
            yield from arrays_of(each, f"{name}.{field}" if name else field)


def read_only(value: Any) -> Any:
    """The same arrays in the same nested NamedTuples, but whoever writes to them gets an error."""
    if isinstance(value, np.ndarray):
        view = value.view()
        view.flags.writeable = False
        return view
    return type(value)(*(read_only(each) for each in value)) if isinstance(value, tuple) else value
