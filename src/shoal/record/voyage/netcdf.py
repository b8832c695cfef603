"""Voyages as NetCDF: CF-1.11 trajectories on (trajectory, obs), chapter 9 and H.4, as drift models read and write."""

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from shoal.core.errors import MissingExtraError
from shoal.core.version import VERSION
from shoal.record.voyage.voyages import Voyages

UNKNOWN = -1  # in on_target
OVER = ("trajectory", "obs")


def write_netcdf(voyages: Voyages, path: Path) -> None:
    """Write a file: lon, lat and time of every craft, its speed, course and heading, and what it reports.

    Where a craft was not there, all but its time is missing.

    Raises
    ------
    MissingExtraError : xarray or netCDF4 is not installed
    OSError : it cannot be written
    """
    xarray = _library("xarray")
    _library("netCDF4")
    seen = [(m, craft) for m, craft in voyages.known()]
    columns = [m for m, _ in seen]
    crafts = [craft for _, craft in seen]

    def of_all(values: Any) -> Any:
        return OVER, values[:, columns].T

    buoys = np.array([craft.kind == "buoy" for craft in crafts], np.bool_)[np.newaxis]
    told = np.where(voyages.there[:, columns] & buoys, voyages.on_target[:, columns], UNKNOWN).astype(np.int8)
    who = {
        "trajectory_id": ([craft.id for craft in crafts], {"cf_role": "trajectory_id", "long_name": "which craft"}),
        "name": ([craft.name for craft in crafts], {"long_name": "name of the craft"}),
        "kind": ([craft.kind for craft in crafts], {"long_name": "buoy or target"}),
        "fleet": ([craft.fleet for craft in crafts], {"long_name": "fleet of the buoy, empty of a target"}),
    }
    dataset = xarray.Dataset(
        {
            "speed": (
                *of_all(voyages.speed),
                {"standard_name": "platform_speed_wrt_ground", "units": "m s-1", "long_name": "speed over ground"},
            ),
            "course": (
                *of_all(voyages.course),
                {"standard_name": "platform_course", "units": "degree", "long_name": "course over ground, from north"},
            ),
            "heading": (
                *of_all(voyages.heading),
                {"units": "degree", "long_name": "direction of the buoy's velocity through the water, from north"},
            ),
            "on_target": (
                OVER,
                told.T,
                {
                    "long_name": "whether the buoy reports a target",
                    "flag_values": np.array([UNKNOWN, 0, 1], np.int8),
                    "flag_meanings": "unknown off_target on_target",
                },
            ),
        },
        {
            "time": (
                OVER,
                np.repeat(voyages.times[np.newaxis] / 1e6, len(crafts), axis=0),
                {
                    "standard_name": "time",
                    "units": "seconds since 1970-01-01T00:00:00Z",
                    "calendar": "standard",
                    "axis": "T",
                    "long_name": "time, UTC",
                },
            ),
            "lat": (
                *of_all(voyages.lat),
                {"standard_name": "latitude", "units": "degrees_north", "axis": "Y", "long_name": "latitude, WGS 84"},
            ),
            "lon": (
                *of_all(voyages.lon),
                {"standard_name": "longitude", "units": "degrees_east", "axis": "X", "long_name": "longitude, WGS 84"},
            ),
            **{name: (("trajectory",), np.array(texts, object), says) for name, (texts, says) in who.items()},
        },
        {
            "Conventions": "CF-1.11",
            "featureType": "trajectory",
            "title": voyages.title,
            "source": f"Shoal {VERSION}, simulation of a swarm",
        },
    )
    dataset["time"].encoding["_FillValue"] = None  # never missing
    for name in who:
        dataset[name].encoding["dtype"] = str
    try:
        dataset.to_netcdf(path, format="NETCDF4", engine="netcdf4")
    except RuntimeError as error:  # netCDF4's, on a full disk
        raise OSError(str(error)) from error


def _library(name: str) -> Any:
    try:
        return import_module(name)
    except ImportError as error:
        raise MissingExtraError.of(name, "xarray", "writing NetCDF") from error
