"""A NetCDF file, opened so that a damaged one is an error and not the end of the process."""

import difflib
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from shoal.core.crash import Crashed, elsewhere
from shoal.core.errors import MissingExtraError, SeaError, ShoalError, reason_of

T = TypeVar("T")

LONGEST = 900.0  # [s] slow disks may take long
AGAIN = "download or export it again"
NETCDF = (b"CDF", b"\x89HDF")
INSTEAD = {
    b"GRIB": "is a GRIB file; convert it: cdo -f nc copy FILE.grib FILE.nc, or grib_to_netcdf",
    b"\x1f\x8b": "is compressed; unpack it: gunzip FILE",
    b"PK": "is a zip archive; unpack it",
    b"<": "is a page of the web, as a server answers that refuses; download it again",
    b"BZh": "is compressed; unpack it: bunzip2 FILE",
}


def from_netcdf(path: Path, function: Callable[..., T], *arguments: Any) -> T:
    """Return what `function(dataset, path, *arguments)` makes of an open netCDF4.Dataset, in another process.

    Raises
    ------
    SeaError : there is no such file, or it is not NetCDF, or damaged
    MissingExtraError : netCDF4 is not installed
    """
    check_there(path)
    with path.open("rb") as file:
        start = file.read(8)
    if not start.startswith(NETCDF):
        hint = next((text for mark, text in INSTEAD.items() if start.lstrip().startswith(mark)), None)
        problem, _, fix = (hint or "is not a NetCDF file; give one that follows the CF conventions").partition("; ")
        raise SeaError(str(path), problem, fix)
    _netcdf4()
    try:
        return elsewhere(_applied, path, function, arguments, longest=LONGEST)  # type: ignore[no-any-return]
    except (ShoalError, MemoryError):
        raise
    except Crashed as error:
        raise SeaError(str(path), "is damaged: the NetCDF library fails on it", AGAIN) from error
    except Exception as error:  # what netCDF4 raises on a damaged file has no common class
        raise SeaError(str(path), f"cannot be read ({reason_of(error)})", AGAIN) from error


def check_there(path: Path) -> None:
    """Refuse a file that is absent, empty, or a folder.

    Raises
    ------
    SeaError : says what to do instead
    """
    if "://" in str(path) or str(path).startswith(("http:", "https:")):
        raise SeaError(str(path), "is an address, not a file", "download the part that you need first")
    try:
        if path.is_dir():
            raise SeaError(str(path), "is a folder", "name a file in it")
        if not path.is_file():
            there = [entry.name for entry in path.parent.iterdir()] if path.parent.is_dir() else []
            similar = difflib.get_close_matches(path.name, there, n=1)
            raise SeaError(str(path), "no such file", f"did you mean {similar[0]}?" if similar else "check the path")
        if not path.stat().st_size:
            raise SeaError(str(path), "is empty", AGAIN)
        with path.open("rb"):
            pass
    except (OSError, ValueError) as error:
        if isinstance(error, SeaError):
            raise
        raise SeaError(str(path), f"cannot be read ({reason_of(error)})", "check the path and its rights") from error


def _applied(path: Path, function: Callable[..., T], arguments: tuple[Any, ...]) -> T:
    with warnings.catch_warnings(), _netcdf4().Dataset(path) as dataset:
        warnings.simplefilter("ignore")  # netCDF4's own, of attributes that it does not use
        return function(dataset, path, *arguments)


def _netcdf4() -> Any:
    try:
        import netCDF4
    except ImportError as error:
        raise MissingExtraError.of("netCDF4", "maritime", "reading currents and wind") from error
    return netCDF4
