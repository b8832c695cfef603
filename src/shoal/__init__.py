"""Shoal: simulate and compare swarms of buoys that search for and track moving targets at sea.

>>> import shoal
>>> record = shoal.simulate("oceans2020", runs=5, steps=20_000, neighbors=10, target_speed="6 kn")
>>> record.estimate("time_on_target")
>>> shoal.compare(["knn-pso", "encircle"], runs=10, steps=5000)
>>> shoal.sweep("oceans2020", {"neighbors": range(10, 50, 10)}, steps=5000).plot()

simulate, compare, sweep, reproduce, check     run a scenario, or many of them
tune, design                                   look for the best values, for the fleets that are worth their cost
load, presets, to_toml, Scenario               what to run; `scenario.with_(neighbors=10)` is another
Simulation                                     one run, step by step
replay_changes                                 a run that was changed while it was watched, made again
Record, open_record, save_record, load_results what runs leave behind
paired_difference                              of runs with the same seeds, with its interval and p
export                                         its tracks, for maps and other programs
list_strategies, list_metrics, list_presets    what there is
strategy, kernel, uniform, normal              to write a strategy, with the units
Meters, MetersPerSecond, Seconds, Degrees      of its parameters
Measurement, Sum, Metric                       to write a metric
Follows                                        what their defaults follow
Range, Doc                                    of the options of a target or a disturbance
plot                                           every figure, in one line each
Buoy, Reading, Report, briefing                to decide on board, without an engine
ShoalError                                     base of every error raised on purpose

`help(shoal.simulate)` and so on say more.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from shoal.core.version import VERSION as __version__  # noqa: N811 (the name every package has)

if TYPE_CHECKING:
    from shoal.buoy.buoy import Buoy
    from shoal.core.draws import normal, uniform
    from shoal.core.errors import ShoalError
    from shoal.core.messages import Reading, Report
    from shoal.core.units import Degrees, Doc, Follows, Meters, MetersPerSecond, Range, Seconds
    from shoal.metrics.contract import Measurement, Metric, Sum
    from shoal.paper.reproduce import reproduce
    from shoal.record.files import open_record, save_record
    from shoal.record.record import Record
    from shoal.record.voyage.export import export
    from shoal.run.replay_changes import replay_changes
    from shoal.run.simulate import simulate
    from shoal.run.simulation import Simulation
    from shoal.scenario.briefing import briefing
    from shoal.scenario.load import load, presets, to_toml
    from shoal.scenario.schema import Scenario
    from shoal.strategies import kernel, strategy
    from shoal.study import plot
    from shoal.study.check import check
    from shoal.study.compared import compare
    from shoal.study.design import design
    from shoal.study.listing import list_metrics, list_presets, list_strategies
    from shoal.study.results import load_results, paired_difference
    from shoal.study.swept import sweep
    from shoal.study.tune import tune

_HOMES = {
    "shoal.buoy.buoy": ("Buoy",),
    "shoal.core.draws": ("normal", "uniform"),
    "shoal.core.errors": ("ShoalError",),
    "shoal.core.messages": ("Reading", "Report"),
    "shoal.core.units": ("Degrees", "Meters", "MetersPerSecond", "Range", "Doc", "Follows", "Seconds"),
    "shoal.metrics.contract": ("Measurement", "Metric", "Sum"),
    "shoal.paper.reproduce": ("reproduce",),
    "shoal.record.files": ("open_record", "save_record"),
    "shoal.record.record": ("Record",),
    "shoal.record.voyage.export": ("export",),
    "shoal.scenario.briefing": ("briefing",),
    "shoal.scenario.load": ("load", "presets", "to_toml"),
    "shoal.scenario.schema": ("Scenario",),
    "shoal.run.replay_changes": ("replay_changes",),
    "shoal.run.simulate": ("simulate",),
    "shoal.run.simulation": ("Simulation",),
    "shoal.strategies": ("kernel", "strategy"),
    "shoal.study.check": ("check",),
    "shoal.study.compared": ("compare",),
    "shoal.study.design": ("design",),
    "shoal.study.listing": ("list_metrics", "list_presets", "list_strategies"),
    "shoal.study.results": ("load_results", "paired_difference"),
    "shoal.study.swept": ("sweep",),
    "shoal.study.tune": ("tune",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Buoy",
    "Degrees",
    "Doc",
    "Follows",
    "Measurement",
    "Meters",
    "MetersPerSecond",
    "Metric",
    "Range",
    "Reading",
    "Record",
    "Report",
    "Scenario",
    "Seconds",
    "ShoalError",
    "Simulation",
    "Sum",
    "__version__",
    "briefing",
    "check",
    "compare",
    "design",
    "export",
    "kernel",
    "list_metrics",
    "list_presets",
    "list_strategies",
    "load",
    "load_results",
    "normal",
    "open_record",
    "paired_difference",
    "plot",
    "presets",
    "replay_changes",
    "reproduce",
    "save_record",
    "simulate",
    "strategy",
    "sweep",
    "to_toml",
    "tune",
    "uniform",
]


def __dir__() -> list[str]:
    return __all__


if not TYPE_CHECKING:  # hidden from type checkers, which know the names

    def __getattr__(name: str) -> Any:
        """Import on first use: `import shoal` and `shoal --help` load neither compiler nor plots."""
        if name == "plot":
            return import_module("shoal.study.plot")
        if name not in _HOME_OF:
            from shoal.core.errors import no_attribute

            raise no_attribute("shoal", name, __all__)
        value = getattr(import_module(_HOME_OF[name]), name)
        globals()[name] = value
        return value
