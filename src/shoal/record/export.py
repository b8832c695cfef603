"""A record as a labelled dataset, and as NetCDF or zarr for other programs: CF conventions, units on everything.

Trajectories follow the discrete sampling geometry "trajectory" of CF-1.11, chapter 9: (trajectory, obs), where a
trajectory is one agent of one run; targets have a dimension of their own. Written with longitude and latitude, each
trajectory is a track that a target can follow.
"""

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from shoal.core.errors import MissingExtraError, RecordError
from shoal.core.files import AtomicFolder, atomic_file
from shoal.core.geodesy import FLATTENING, RADIUS, Frame
from shoal.metrics.heading_bearing import CENTERS, fleet_stationary, phi_histogram
from shoal.metrics.summary import METRICS, evaluate
from shoal.metrics.velocity_fluctuation import fleet_fluctuation
from shoal.record.trajectory import Trajectory

if TYPE_CHECKING:
    import xarray

    from shoal.record.record import Record

Variable = tuple[tuple[str, ...], Any, dict[str, Any]]  # dimensions, values, attributes: as xarray takes them

CONVENTIONS = "CF-1.11"
EPOCH = "seconds since 1970-01-01 00:00:00"  # CF asks for a date; that of a simulation means nothing
NOT_RECORDED = -1  # in the flags on_target and target_is_present
COUNTS = ("agents", "unit/step")  # units of ours that UDUNITS does not know: pure numbers


def to_xarray(record: "Record") -> "xarray.Dataset":
    """Return metrics and trajectories of a record as one dataset.

    Dimensions are run, fleet, phi_bin and batch (consecutive steps of a run); with trajectories also trajectory,
    target and obs. Where recorded runs kept different steps, obs holds the steps of all, with gaps.

    Raises
    ------
    MissingExtraError : xarray is not installed
    """
    _library("xarray")
    from shoal.record.dataset import RecordDataset

    variables = _metric_variables(record)
    coordinates = _metric_coordinates(record)
    if record.trajectories:
        variables |= _trajectory_variables(record)
        coordinates |= _trajectory_coordinates(record)
    dataset: xarray.Dataset = RecordDataset(variables, coordinates, _global_attributes(record))
    for name in {"phi_bin", "time"} & set(coordinates):
        dataset[name].encoding["_FillValue"] = None  # never missing, and CF wants it said by silence
    return dataset


def to_netcdf(record: "Record", path: str | Path) -> None:
    """Write a record to a new NetCDF-4 file, atomically.

    Raises
    ------
    MissingExtraError : xarray or netCDF4 is not installed
    RecordError : the file exists or cannot be written
    """
    _library("netCDF4")
    with atomic_file(path, new=True) as partial, _failures_told(path):
        to_xarray(record).to_netcdf(partial, format="NETCDF4", engine="netcdf4")


def to_zarr(record: "Record", path: str | Path) -> None:
    """Write a record to a new zarr store (format 2, which every reader knows), atomically.

    Raises
    ------
    MissingExtraError : xarray or zarr is not installed
    RecordError : the folder exists or cannot be written
    """
    _library("zarr")
    with AtomicFolder(path, last=".zmetadata") as folder, _failures_told(path):
        to_xarray(record).to_zarr(folder.partial, mode="w-", zarr_format=2, consolidated=True)
        folder.finish()


def _library(name: str) -> Any:
    try:
        return import_module(name)
    except ImportError as error:
        raise MissingExtraError.of(name, "xarray", "labelled arrays and NetCDF/zarr export") from error


# --- metrics ---


def _metric_variables(record: "Record") -> dict[str, Variable]:
    tallies, facts = record.tallies, record.facts
    values = {name: [evaluate(name, tally, facts) for tally in tallies] for name in METRICS}
    variables: dict[str, Variable] = {
        name: (("run",), [total for total, _ in values[name]], _says(metric.unit, metric.sentence))
        for name, metric in METRICS.items()
    }
    variables["time_on_target_batch"] = (
        ("run", "batch"),
        [batches for _, batches in values["time_on_target"]],
        _says("1", f"{METRICS['time_on_target'].sentence}, in each batch of consecutive steps"),
    )
    variables["phi_histogram"] = (
        ("run", "fleet", "phi_bin"),
        [phi_histogram(tally) for tally in tallies],
        _says("1", "mean number of agents per step in each bin of phi (Eq. 8); bins and fleets sum to N"),
    )
    variables["fleet_xi_raw"] = (
        ("run", "fleet"),
        [fleet_fluctuation(tally, facts) for tally in tallies],
        _says("m/s", "velocity fluctuation of a fleet around the mean velocity of the swarm"),
    )
    variables["fleet_stationary"] = (
        ("run", "fleet"),
        [fleet_stationary(tally, facts) for tally in tallies],
        _says("1", METRICS["stationary"].sentence),
    )
    variables["fleet_count"] = (("fleet",), np.array(facts.counts), _says("1", "number of agents of a fleet"))
    variables["fleet_max_speed"] = (("fleet",), list(facts.max_speeds), _says("m/s", "top speed of a fleet's agents"))
    return variables


def _metric_coordinates(record: "Record") -> dict[str, Variable]:
    return {
        "run": (("run",), np.arange(len(record.tallies)), {"long_name": "number of the run"}),
        "fleet": (("fleet",), list(record.facts.fleets), {"long_name": "name of the fleet"}),
        "phi_bin": (("phi_bin",), CENTERS, _says("1", "center of the bin of phi, cos(heading - bearing to target)")),
        "batch": (
            ("batch",),
            np.arange(record.tallies[0].steps.size),
            {"long_name": "number of the batch of consecutive steps"},
        ),
    }


def _says(unit: str, sentence: str) -> dict[str, Any]:
    return {"units": "1" if unit in COUNTS else unit, "long_name": sentence}


# --- trajectories ---


def _trajectory_variables(record: "Record") -> dict[str, Variable]:
    stack = _Stack(record.trajectories)
    over, targets_over = ("trajectory", "obs"), ("target", "obs")
    origin = _origin(record)
    on_map = {"grid_mapping": "crs"} if origin else {}
    variables: dict[str, Variable] = {
        "x": (over, stack.floats("x"), on_map | _position("x", "agent") | _axis("x")),
        "y": (over, stack.floats("y"), on_map | _position("y", "agent") | _axis("y")),
        "vx": (over, stack.floats("vx"), on_map | _says("m/s", "velocity of the agent along x")),
        "vy": (over, stack.floats("vy"), on_map | _says("m/s", "velocity of the agent along y")),
        "on_target": (over, stack.flags("on_target"), on_map | _flag("off_target on_target", "agent reports a target")),
        "is_engaged": (  # engaged is a metric
            over,
            stack.flags("engaged"),
            on_map | _flag("off_target on_target", "agent is on a target"),
        ),
        "target_x": (targets_over, stack.floats("target_x"), on_map | _position("x", "target")),
        "target_y": (targets_over, stack.floats("target_y"), on_map | _position("y", "target")),
        "target_is_present": (  # target_present is a metric
            targets_over,
            stack.flags("target_present"),
            on_map | _flag("absent present", "target is present"),
        ),
    }
    units = _memory_units(record)
    for field in stack.first.memory:
        unit = {"units": units[field]} if units.get(field) else {}
        says = {"long_name": f"{field}, remembered by the agent"}
        variables[f"memory_{field}"] = (over, stack.floats(field, lambda frames: frames.memory), on_map | unit | says)
    return variables | ({"crs": _grid_mapping(*origin)} if origin else {})


def _trajectory_coordinates(record: "Record") -> dict[str, Variable]:
    stack, facts = _Stack(record.trajectories), record.facts
    runs = np.array(list(record.trajectories))
    fleets = np.repeat(facts.fleets, facts.counts)
    agents = _instances("trajectory", runs, "agent", facts.agents)
    agents["trajectory_fleet"] = (("trajectory",), np.tile(fleets, runs.size), {"long_name": "fleet of the agent"})
    agents["trajectory_id"][2]["cf_role"] = "trajectory_id"
    targets = _instances("target", runs, "target", stack.first.target_x.shape[1])
    time = {
        "standard_name": "time",
        "units": EPOCH,
        "calendar": "standard",
        "units_metadata": "leap_seconds: none",
        "axis": "T",
        "long_name": "simulated time since the start of the run",
        "comment": "the date is nominal",
    }
    return {
        "time": (("obs",), stack.steps * facts.time_step, time),
        "step": (("obs",), stack.steps, _says("1", "number of the time-step, of which this is the start")),
        **agents,
        **targets,
        **_geographic(record, stack),
    }


class _Stack:
    """Trajectories of several runs behind each other, (runs x instances, obs), on the steps of all."""

    def __init__(self, trajectories: Mapping[int, Trajectory]) -> None:
        self._runs = list(trajectories.values())
        self.first = self._runs[0]
        self.steps = np.unique(np.concatenate([frames.step for frames in self._runs]))

    def floats(self, name: str, of: Callable[[Trajectory], dict[str, Any]] = vars) -> npt.NDArray[np.float64]:
        """Values of an array of the trajectories, NaN where a run kept no frame."""
        return self._stacked([of(frames)[name] for frames in self._runs], np.float64, np.nan)

    def flags(self, name: str) -> npt.NDArray[np.int8]:
        """The same of an array of truths, as 0, 1 or NOT_RECORDED."""
        return self._stacked([getattr(frames, name) for frames in self._runs], np.int8, NOT_RECORDED)

    def _stacked(self, values: Sequence[npt.NDArray[Any]], kind: type, missing: float) -> npt.NDArray[Any]:
        instances = values[0].shape[1]
        stacked = np.full((len(values) * instances, self.steps.size), missing, kind)
        for at, (frames, part) in enumerate(zip(self._runs, values, strict=True)):
            stacked[at * instances : (at + 1) * instances, np.searchsorted(self.steps, frames.step)] = part.T
        return stacked


def _position(letter: str, who: str) -> dict[str, Any]:
    direction = {"x": "east", "y": "north"}[letter]
    return _says("m", f"position of the {who}, {direction} of the center of the arena")


def _axis(letter: str) -> dict[str, Any]:
    """For agents only: a grid mapping has exactly one pair of these."""
    return {"standard_name": f"projection_{letter}_coordinate"}


def _flag(meanings: str, sentence: str) -> dict[str, Any]:
    return {
        "long_name": sentence,
        "flag_values": np.array([NOT_RECORDED, 0, 1], np.int8),
        "flag_meanings": f"not_recorded {meanings}",
    }


def _instances(dimension: str, runs: npt.NDArray[Any], who: str, count: int) -> dict[str, Variable]:
    """Identifier, run and number of each agent or target, runs one after the other."""
    return {
        f"{dimension}_id": (
            (dimension,),
            [f"run-{run}/{who}-{i}" for run in runs for i in range(count)],
            {"long_name": f"which {who} of which run"},
        ),
        f"{dimension}_run": ((dimension,), np.repeat(runs, count), {"long_name": "number of the run"}),
        f"{dimension}_number": (
            (dimension,),
            np.tile(np.arange(count), runs.size),
            {"long_name": f"number of the {who} in its run"},
        ),
    }


def _memory_units(record: "Record") -> dict[str, str]:
    """Unit of each memory field; none are known where a user's strategy has not been loaded in this process."""
    scenario = record.scenario
    units: dict[str, str] = {}
    for choice in (scenario.strategy, *(fleet.strategy for fleet in scenario.fleets)):
        units |= choice.known.memory if choice and choice.known else {}
    return units


# --- the place on Earth ---


def _origin(record: "Record") -> tuple[float, float] | None:
    """(lon, lat) [deg] of (0, 0), if the scenario has one."""
    return record.scenario.area.origin


def _grid_mapping(lon: float, lat: float) -> Variable:
    """The projection of recorded tracks, see core.geodesy."""
    attributes = {
        "grid_mapping_name": "azimuthal_equidistant",
        "longitude_of_projection_origin": lon,
        "latitude_of_projection_origin": lat,
        "false_easting": 0.0,
        "false_northing": 0.0,
        "semi_major_axis": RADIUS,
        "inverse_flattening": 1.0 / FLATTENING,
        "long_name": "local meters around the center of the arena (WGS 84)",
    }
    return ((), np.int32(0), attributes)


def _geographic(record: "Record", stack: _Stack) -> dict[str, Variable]:
    """Longitude and latitude of agents and targets; nothing without an origin or without pyproj."""
    origin = _origin(record)
    if origin is None:
        return {}
    try:
        frame = Frame(origin)
    except MissingExtraError:
        return {}
    variables: dict[str, Variable] = {}
    for dimension, prefix, who in (("trajectory", "", "agent"), ("target", "target_", "target")):
        lon, lat = frame.geographic(stack.floats(f"{prefix}x"), stack.floats(f"{prefix}y"))
        for name, long_name, unit, values in (
            ("lon", "longitude", "degrees_east", lon),
            ("lat", "latitude", "degrees_north", lat),
        ):
            attributes = {"standard_name": long_name, "units": unit, "long_name": f"{long_name} of the {who}"}
            variables[prefix + name] = ((dimension, "obs"), values, attributes)
    return variables


# --- files ---


def _global_attributes(record: "Record") -> dict[str, Any]:
    about = record.provenance
    return {
        "Conventions": CONVENTIONS,
        **({"featureType": "trajectory"} if record.trajectories else {}),
        "title": record.scenario.name,
        "summary": record.scenario.description,
        "source": f"Shoal {about['versions']['shoal']}, simulation of a swarm",
        "history": f"{about['started']} simulated by Shoal {about['versions']['shoal']}",
        "scenario_hash": about["scenario_hash"],
        "provenance": json.dumps(about),
        "scenario": json.dumps(record.scenario.model_dump(mode="json")),
    }


@contextmanager
def _failures_told(path: str | Path) -> Iterator[None]:
    """One error for what the libraries raise where the operating system refuses."""
    try:
        yield
    except (OSError, RuntimeError) as error:  # netCDF4 raises RuntimeError on a full disk
        reason = getattr(error, "strerror", None) or error
        raise RecordError(
            str(path), f"cannot be written: {reason}", "free space, or name a place you may write"
        ) from error
