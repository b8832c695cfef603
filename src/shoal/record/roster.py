"""Who takes part in a run: what the engine was given of each agent, written once when the run is built."""

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt


class Roster(NamedTuple):
    """What is chosen of N agents, (N,) each.

    fleet : index of its fleet; max_speed [m/s], sensor_radius [m]
    neighbors : the k that it begins with; of a strategy that hears all, N - 1
    strategy : name of its strategy; joins : the step from which on it is there
    """

    fleet: npt.NDArray[np.int64]
    max_speed: npt.NDArray[np.float64]
    sensor_radius: npt.NDArray[np.float64]
    neighbors: npt.NDArray[np.int64]
    strategy: npt.NDArray[np.str_]
    joins: npt.NDArray[np.int64]

    def by_fleet(self, name: str) -> list[Any]:
        """A field of the first agent of each fleet, for what all of a fleet have in common."""
        _, first = np.unique(self.fleet, return_index=True)
        values: list[Any] = getattr(self, name)[first].tolist()
        return values
