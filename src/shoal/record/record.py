"""Record: what runs leave behind, with units and provenance."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from shoal.metrics.summary import (
    METRICS,
    Facts,
    evaluate,
    fleet_fluctuation,
    fleet_power,
    fleet_stationary,
    mean_max_speed,
    phi_histogram,
)
from shoal.metrics.tally import Tally, batch_of
from shoal.record.statistics import Estimate, estimate
from shoal.record.trajectory import Trajectory


@dataclass(frozen=True)
class Record:
    """The result of R runs of one scenario.

    Attributes
    ----------
    scenario : the scenario in full, as its file would say it
    facts : fleets and scales that metrics need
    tallies : the sums of each run
    provenance : seed, steps, scenario_hash, versions, platform, time, notes
    trajectories : {run: frames}, for the runs that kept any
    """

    scenario: dict[str, Any]
    facts: Facts
    tallies: tuple[Tally, ...]
    provenance: dict[str, Any]
    trajectories: dict[int, Trajectory] = field(default_factory=dict)

    def estimate(self, metric: str) -> Estimate:
        """Mean and 95 % confidence interval of a metric, see shoal.metrics(): over runs, or batches of a single run.

        Raises
        ------
        KeyError : no metric of this name
        """
        values, batches = zip(*(evaluate(metric, tally, self.facts) for tally in self.tallies), strict=True)
        return estimate(values, batches[0])

    def phi_histogram(self) -> npt.NDArray[np.float64]:
        """Mean agents per step in each bin of phi from -1 to +1, by fleet: (F, 11). All bins sum to N. Eq. 8."""
        return np.mean([phi_histogram(tally) for tally in self.tallies], axis=0)  # type: ignore[no-any-return]

    def fleet_estimate(self, metric: str) -> dict[str, Estimate]:
        """`xi_raw` [m/s], `xi` (over the swarm's mean top speed), `stationary`, `speed` [m/s] or `power` of each fleet.

        Raises
        ------
        KeyError : another metric
        """
        formulas: dict[str, Callable[[Tally], npt.NDArray[np.float64]]] = {
            "xi_raw": lambda tally: fleet_fluctuation(tally, self.facts),
            "xi": lambda tally: fleet_fluctuation(tally, self.facts) / mean_max_speed(tally, self.facts),
            "speed": lambda tally: fleet_power(tally, self.facts)[0],
            "power": lambda tally: fleet_power(tally, self.facts)[1],
            "stationary": lambda tally: fleet_stationary(tally, self.facts),
        }
        formula = formulas[metric]
        first = self.tallies[0]
        runs = np.array([formula(tally) for tally in self.tallies])
        batches = np.array([formula(batch_of(first, b)) for b in range(first.steps.size)])
        return {name: estimate(runs[:, f], batches[:, f]) for f, name in enumerate(self.facts.fleets)}

    def summary(self) -> dict[str, Any]:
        """Everything in plain numbers, as `shoal run --json` prints it."""
        histogram = self.phi_histogram()
        return {
            **{name: _plain(self.estimate(name)) for name in METRICS},
            "phi_histogram": _numbers(histogram.sum(axis=0)),
            "fleets": {
                name: {
                    "count": self.facts.counts[f],
                    "max_speed": self.facts.max_speeds[f],
                    "phi_histogram": _numbers(histogram[f]),
                    **{
                        metric: _plain(self.fleet_estimate(metric)[name])
                        for metric in ("xi", "xi_raw", "stationary", "speed", "power")
                    },
                }
                for f, name in enumerate(self.facts.fleets)
            },
            "units": {name: metric.unit for name, metric in METRICS.items()},
            "runs": len(self.tallies),
            **self.provenance,
        }

    def to_xarray(self) -> Any:
        """Return an xarray.Dataset of metrics and trajectories with units and CF attributes (extra: xarray)."""
        from shoal.record.export import to_xarray

        return to_xarray(self)


def _plain(value: Estimate) -> dict[str, Any]:
    """An estimate as JSON."""
    interval = _numbers(value.ci95) if value.ci95 else None
    return {"mean": _numbers([value.mean])[0], "ci95": interval, "runs": _numbers(value.runs)}


def _numbers(values: npt.ArrayLike) -> list[float | None]:
    """Numbers as JSON has them: one that does not exist is null."""
    return [float(value) if np.isfinite(value) else None for value in np.asarray(values, float)]
