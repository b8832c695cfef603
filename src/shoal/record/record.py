"""Record: what runs leave behind, with units and provenance."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from shoal.core.errors import RecordError, UnknownNameError, no_attribute
from shoal.core.sheet import Sheet
from shoal.core.text import plain
from shoal.metrics.contract import Facts, Metric
from shoal.metrics.coverage import reachable
from shoal.metrics.each_target import each_target, loss_lengths
from shoal.metrics.effort import fleet_power
from shoal.metrics.energy import fleet_energy
from shoal.metrics.found import times_to_find
from shoal.metrics.heading_bearing import fleet_stationary, phi_histogram
from shoal.metrics.robustness import Robustness, robustness
from shoal.metrics.shares import mean_max_speed
from shoal.metrics.summary import METRICS, Bounds, batch_values, bounds_of, evaluate
from shoal.metrics.tally import Tally
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.record.roster import Roster
from shoal.record.search import FoundShares, SearchTime, found_by, time_to_find
from shoal.record.statistics import FEWEST, Estimate, all_alike, estimate
from shoal.record.trajectory import Trajectory
from shoal.record.words import interval_text, mean_text, steered_text
from shoal.scenario.choices import headline
from shoal.scenario.schema import Scenario

if TYPE_CHECKING:
    import pandas
    import xarray

_OF_FLEETS = ("xi", "xi_raw", "stationary", "speed", "power", "energy", "charge")


@dataclass(frozen=True, repr=False)
class Record:
    """The result of R runs of one scenario.

    Attributes
    ----------
    scenario : what was run; of a record that was opened a RecordedScenario, which loaded nothing that it names
    facts : fleets and scales that metrics need
    roster : what the engine was given of each agent: fleet, top speed, sensor, k, strategy, when it joins
    tallies : the sums of each run
    provenance : seed, steps, scenario_hash, versions, platform, time, notes
    trajectories : {run: frames}, for the runs that kept any
    """

    scenario: Scenario
    facts: Facts
    roster: Roster
    tallies: tuple[Tally, ...]
    provenance: dict[str, Any]
    trajectories: Mapping[int, Trajectory] = field(default_factory=dict)

    @property
    def steered(self) -> tuple[tuple[int, str], ...]:
        """What was changed while the run was watched: step and words of each change; nothing of a run that was not.

        Then the scenario and the roster are what the run began with, and the numbers are over all of its steps.
        """
        return tuple((each["step"], each["words"]) for each in self.provenance.get("steered", ()))

    def estimate(self, metric: str) -> Estimate:
        """Mean and 95 % confidence interval of a metric, see shoal.list_metrics(): over runs, or batches of one run.

        Raises
        ------
        UnknownNameError : no metric of this name; it is a KeyError, too
        """
        if metric not in METRICS:
            raise UnknownNameError.of("metric", metric, METRICS)
        values = [METRICS[metric].formula(tally, self.facts) for tally in self.tallies]
        return estimate(values, self._batches(metric), self.bounds(metric))

    def bounds(self, metric: str) -> Bounds:
        """Between which values a metric lies in this scenario, whatever happens.

        Raises
        ------
        KeyError : no metric of this name
        """
        area, step = self.scenario.area, self.facts.time_step
        return bounds_of(
            metric,
            agents=self.facts.agents,
            reach=reachable(area.width, area.height, area.agent_margin),
            duration=self.scenario.steps * step,
            flicker=1800.0 / step,
        )

    def of_batches(self, metric: str, run: int) -> npt.NDArray[np.float64]:
        """A metric over each batch of consecutive steps of a run, (B,); none of a metric that happens once."""
        return evaluate(metric, self.tallies[run], self.facts)[1]

    @property
    def metrics(self) -> Mapping[str, Metric]:
        """What can be estimated, by name: its unit and what it means."""
        return METRICS

    def too_short(self) -> list[str]:
        """Metrics that vary within a single run, which is too short to tell how much: they have no interval."""
        found = []
        for metric in METRICS:
            batches = self._batches(metric)
            varies = batches is not None and batches.size > 0 and (batches.size < FEWEST or not all_alike(batches))
            if varies and self.estimate(metric).ci95 is None:
                found.append(metric)
        return found

    def listed(self) -> list[str]:
        """Metrics that say something of this scenario: what it has no target, battery or radio for is left out.

        Of a scenario that names its metrics, these.
        """
        several = len(self.scenario.targets) > 1
        return [
            name
            for name, each in METRICS.items()
            if (several or not each.several_targets)
            and not (each.asked and np.isnan(self.estimate(name).mean))
            and (name in self.scenario.metrics or not self.scenario.metrics)
        ]

    def found_by(self, times: npt.ArrayLike, target: int | None = None) -> FoundShares:
        """Chance that a target is found by a time [s], with 95 % intervals: the share of runs in which it was.

        >>> shoal.simulate("oceans2020", runs=50, steps=300).found_by([5, 10, 30]).share

        Parameters
        ----------
        times : [s] for which the target was there
        target : number of the target; default: all of them are found

        Raises
        ------
        RecordError : no such target
        """
        return found_by(self._times_to_find(target), times, self.scenario.steps * self.facts.time_step)

    def time_to_find(self, target: int | None = None) -> SearchTime:
        """Median time until a target is found [s], with a 95 % interval and the number of runs in which it never was.

        Parameters
        ----------
        target : number of the target; default: all of them are found

        Raises
        ------
        RecordError : no such target
        """
        return time_to_find(self._times_to_find(target))

    def _times_to_find(self, target: int | None) -> npt.NDArray[np.float64]:
        """Of each run, inf where it was not found, (R,)."""
        times = np.array([times_to_find(tally, self.facts) for tally in self.tallies])
        if target is None:
            return np.asarray(times.max(axis=1))
        if not isinstance(target, (int, np.integer)) or not 0 <= target < times.shape[1]:
            raise RecordError("target", f"is {target!r}", f"name one from 0 to {times.shape[1] - 1}")
        return np.asarray(times[:, target])

    def _batches(self, metric: str) -> npt.NDArray[np.float64] | None:
        """Values in the batches of a single run, of a metric that has any."""
        row = METRICS[metric]
        if len(self.tallies) > 1 or row.once:
            return None
        return batch_values(lambda tally: row.formula(tally, self.facts), self.tallies[0])

    def phi_histogram(self) -> npt.NDArray[np.float64]:
        """Mean agents per step in each bin of phi from -1 to +1, by fleet: (F, 11). All bins sum to N. Eq. 8."""
        return np.mean([phi_histogram(tally) for tally in self.tallies], axis=0)  # type: ignore[no-any-return]

    def fleet_estimate(self, metric: str) -> dict[str, Estimate]:
        """`xi_raw` [m/s], `xi` (over the swarm's mean top speed), `stationary`, `speed` [m/s], `power` of each fleet.

        Of fleets with batteries `energy` [Wh] and `charge`, too.

        Raises
        ------
        UnknownNameError : another metric; it is a KeyError, too
        """
        if metric not in _OF_FLEETS:
            raise UnknownNameError.of("metric of fleets", metric, _OF_FLEETS)
        formulas: dict[str, Callable[[Tally], npt.NDArray[np.float64]]] = {
            "xi_raw": lambda tally: fleet_fluctuation(tally, self.facts),
            "xi": lambda tally: fleet_fluctuation(tally, self.facts) / mean_max_speed(tally, self.facts),
            "speed": lambda tally: fleet_power(tally, self.facts)[0],
            "power": lambda tally: fleet_power(tally, self.facts)[1],
            "stationary": lambda tally: fleet_stationary(tally, self.facts),
            "energy": lambda tally: fleet_energy(tally, self.facts)[0],
            "charge": lambda tally: fleet_energy(tally, self.facts)[1],
        }
        formula = formulas[metric]
        runs = np.array([formula(tally) for tally in self.tallies])
        found = {}
        for fleet, name in enumerate(self.facts.fleets):
            single = len(runs) == 1 and not METRICS[metric].once
            alone = batch_values(partial(_of_fleet, formula, fleet), self.tallies[0]) if single else None
            found[name] = estimate(runs[:, fleet], alone, bounds_of(metric, agents=self.facts.counts[fleet]))
        return found

    def target_estimates(self) -> list[dict[str, Estimate]]:
        """`time_on_target`, `first_detection` [s], `losses` [1/h] and `reacquisition` [s] of each target, over runs."""
        runs = [each_target(tally, self.facts) for tally in self.tallies]
        targets = range(self.tallies[0].target_steps.shape[1])
        return [
            {name: estimate([run[name][j] for run in runs], bounds=self.bounds(name)) for name in runs[0]}
            for j in targets
        ]

    def loss_lengths(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
        """How long targets stayed lost, of all runs: edges of the bins [s] (B + 1,), and ended losses in each (B,)."""
        edges, counts = zip(*(loss_lengths(tally, self.facts) for tally in self.tallies), strict=True)
        longest = max(edges, key=len)
        return longest, np.sum([np.pad(each, (0, longest.size - 1 - each.size)) for each in counts], axis=0)

    def changes(self) -> list[int]:
        """The steps within the run at which agents are lost or join."""
        steps = {loss.step for loss in self.scenario.losses} | {join.step for join in self.scenario.joins}
        return sorted(step for step in steps if step < self.scenario.steps)

    def robustness(self) -> list[dict[str, Estimate]]:
        """Time on target `before`, `during` and `after` each of `changes`, and the `recovery` time [s], over runs.

        `recovery` is the mean over the runs that recover; a run that does not is NaN among its `runs`.
        """
        changes = self.changes()
        limits = dict.fromkeys(Robustness._fields, Bounds(0.0, 1.0)) | {"recovery": self.bounds("reacquisition")}
        runs = [robustness(tally, changes, self.facts.time_step) for tally in self.tallies]
        return [
            {name: _over_some([getattr(run[c], name) for run in runs], bounds) for name, bounds in limits.items()}
            for c in range(len(changes))
        ]

    def summary(self) -> dict[str, Any]:
        """Everything in plain numbers, as `shoal run --json` prints it."""
        histogram = self.phi_histogram()
        edges, counts = self.loss_lengths()
        return {
            **{name: _plain(self.estimate(name)) for name in METRICS},
            "phi_histogram": _numbers(histogram.sum(axis=0)),
            "targets": [{name: _plain(each) for name, each in target.items()} for target in self.target_estimates()],
            "loss_lengths": {"edges": _numbers(edges), "counts": counts.tolist()},
            "changes": [
                {"step": step, **{name: _plain(each) for name, each in change.items()}}
                for step, change in zip(self.changes(), self.robustness(), strict=True)
            ],
            "fleets": {
                name: {
                    "count": self.facts.counts[f],
                    "max_speed": self.facts.max_speeds[f],
                    "phi_histogram": _numbers(histogram[f]),
                    **{metric: _plain(self.fleet_estimate(metric)[name]) for metric in _OF_FLEETS},
                }
                for f, name in enumerate(self.facts.fleets)
            },
            "units": {name: metric.unit for name, metric in METRICS.items()},
            "runs": len(self.tallies),
            **self.provenance,
        }

    def to_pandas(
        self, what: Literal["metrics", "fleets", "targets", "frames", "target_frames"] = "metrics"
    ) -> "pandas.DataFrame":
        """Return a tidy table (extra: sweep).

        Parameters
        ----------
        what : metrics - a row per run and metric: run, metric, value, unit
            fleets, targets - the same of each fleet, of each target (numbered from 0)
            frames - a row per run, kept step and agent: run, step, time [s], agent, fleet, x, y [m], vx, vy [m/s],
            on_target (what it reports), engaged (what is so), alive, neighbors (k), memory_NAME
            target_frames - the same of targets: target, x, y [m], present

        Raises
        ------
        UnknownNameError : another table
        MissingExtraError : pandas is not installed
        """
        from shoal.record.dataframe import to_pandas

        return to_pandas(self, what)

    def to_xarray(self) -> "xarray.Dataset":
        """Return metrics and trajectories as one dataset, with units and CF attributes (extra: xarray).

        Its `to_dataframe` refuses to be the product of all dimensions: use `to_pandas`, or choose variables.

        Raises
        ------
        MissingExtraError : xarray is not installed
        """
        from shoal.record.export import to_xarray

        return to_xarray(self)

    def __repr__(self) -> str:
        """One line: what was run, and time on target."""
        return f"<Record {self._head()}; time on target {plain(mean_text(self.estimate('time_on_target')))}>"

    def _repr_html_(self) -> str:
        """The table of the run for a notebook: every metric with its interval."""
        known = {name: self.estimate(name) for name in self.listed()}
        return Sheet(
            head=self._head(),
            titles=("metric", "mean", "95 % interval", "unit", ""),
            rows=[
                (name, mean_text(value), interval_text(value), METRICS[name].unit, METRICS[name].sentence)
                for name, value in known.items()
            ],
            note=f"{headline(self.scenario, self.roster.by_fleet('neighbors'))}; "
            f"intervals {'over runs' if len(self.tallies) > 1 else 'by batch means'}",
            words=("metric", "unit", ""),
        ).html()

    def _head(self) -> str:
        runs, about = len(self.tallies), self.provenance
        return (
            f"{plain(self.scenario.name)}: {runs} run{'s' * (runs != 1)} of {self.scenario.steps:,} steps, "
            f"seed {about['seed']}, scenario {about['scenario_hash']}"
            + (f"; {steered_text(self.steered)}" if self.steered else "")
        )

    if not TYPE_CHECKING:  # hidden from type checkers, which know the names

        def __getattr__(self, name: str) -> Any:
            methods = [each for each in dir(type(self)) if not each.startswith("_")]
            raise no_attribute("a Record", name, dict.fromkeys([*type(self).__dataclass_fields__, *methods]))


def _over_some(values: list[float], bounds: Bounds) -> Estimate:
    """An estimate over the runs that have a value; all are listed."""
    have = [value for value in values if np.isfinite(value)]
    return estimate(have or [np.nan], bounds=bounds)._replace(runs=tuple(values))


def _of_fleet(formula: Callable[[Tally], npt.NDArray[np.float64]], fleet: int, tally: Tally) -> float:
    return float(formula(tally)[fleet])


def _plain(value: Estimate) -> dict[str, Any]:
    """An estimate as JSON."""
    interval = _numbers(value.ci95) if value.ci95 else None
    return {"mean": _numbers([value.mean])[0], "ci95": interval, "runs": _numbers(value.runs)}


def _numbers(values: npt.ArrayLike) -> list[float | None]:
    """Numbers as JSON has them: one that does not exist is null."""
    return [float(value) if np.isfinite(value) else None for value in np.asarray(values, float)]
