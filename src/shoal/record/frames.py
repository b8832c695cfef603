"""What the frames of a record show, beyond what they hold: who is on a target, and whom each agent hears."""

import numpy as np
import numpy.typing as npt

from shoal.record.record import Record
from shoal.scenario.choices import degree_of_fleet


def watching(record: Record, run: int) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.bool_]]:
    """How many agents are on a target that is there, and whether one is, at every frame: (K,), (K,).

    An agent that reports a target out of its sensor's reach, a false alarm, is not on target.
    """
    frames, scenario = record.trajectories[run], record.scenario
    sensors = np.repeat([fleet["sensor_radius"] for fleet in scenario["fleets"]], record.facts.counts)
    near = np.zeros(frames.on_target.shape, bool)
    for number, target in enumerate(scenario["targets"]):
        dx = frames.x - frames.target_x[:, number, None]
        dy = frames.y - frames.target_y[:, number, None]
        there = np.asarray(frames.target_present[:, number])
        near |= (dx * dx + dy * dy <= (sensors + target["radius"]) ** 2) & there[:, None]
    engaged: npt.NDArray[np.int64] = (near & frames.on_target & frames.alive).sum(axis=1)
    present: npt.NDArray[np.bool_] = np.any(frames.target_present, axis=1)
    return engaged, present


def degrees_of(record: Record) -> npt.NDArray[np.int64]:
    """K of each agent before it adapts, (N,)."""
    everybody = record.facts.agents - 1
    degrees = [degree_of_fleet(record.scenario, fleet) for fleet in record.scenario["fleets"]]
    return np.repeat([everybody if each == "all" else int(each) for each in degrees], record.facts.counts)
