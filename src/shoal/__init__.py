"""Shoal: design, test and deploy swarms that search for and track moving targets at sea.

>>> import shoal
>>> record = shoal.simulate(shoal.load("oceans2020"), runs=5)
>>> record.estimate("time_on_target")
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from shoal.version import VERSION as __version__  # noqa: N811 (the name every package has)

if TYPE_CHECKING:
    from shoal import plot
    from shoal.buoy.buoy import Buoy
    from shoal.compiler.kernel import kernel
    from shoal.core.draws import normal, uniform
    from shoal.core.errors import ShoalError
    from shoal.core.messages import Reading, Report
    from shoal.core.units import Degrees, Meters, MetersPerSecond, Seconds
    from shoal.experiments.results import load_results
    from shoal.record.files import open_record, save_record
    from shoal.record.record import Record
    from shoal.run.simulate import simulate
    from shoal.run.simulation import Simulation
    from shoal.scenario.briefing import briefing
    from shoal.scenario.load import load, presets, to_toml
    from shoal.scenario.schema import Scenario
    from shoal.strategies import strategy

_HOMES = {
    "shoal.buoy.buoy": ("Buoy",),
    "shoal.core.draws": ("normal", "uniform"),
    "shoal.core.errors": ("ShoalError",),
    "shoal.core.messages": ("Reading", "Report"),
    "shoal.compiler.kernel": ("kernel",),
    "shoal.core.units": ("Degrees", "Meters", "MetersPerSecond", "Seconds"),
    "shoal.experiments.results": ("load_results",),
    "shoal.record.files": ("open_record", "save_record"),
    "shoal.record.record": ("Record",),
    "shoal.scenario.briefing": ("briefing",),
    "shoal.scenario.load": ("load", "presets", "to_toml"),
    "shoal.scenario.schema": ("Scenario",),
    "shoal.run.simulate": ("simulate",),
    "shoal.run.simulation": ("Simulation",),
    "shoal.strategies": ("strategy",),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = [
    "Buoy",
    "Degrees",
    "Meters",
    "MetersPerSecond",
    "Reading",
    "Record",
    "Report",
    "Scenario",
    "Seconds",
    "ShoalError",
    "Simulation",
    "__version__",
    "briefing",
    "kernel",
    "load",
    "load_results",
    "normal",
    "open_record",
    "plot",
    "presets",
    "save_record",
    "simulate",
    "strategy",
    "to_toml",
    "uniform",
]


def __getattr__(name: str) -> Any:
    """Import on first use: `import shoal` and `shoal --help` load neither compiler nor plots."""
    if name == "plot":
        return import_module("shoal.plot")
    if name not in _HOME_OF:
        raise AttributeError(f"module 'shoal' has no attribute {name!r}; it has: {', '.join(__all__)}")
    value = getattr(import_module(_HOME_OF[name]), name)
    globals()[name] = value
    return value
