"""Make a NetCDF file of currents and wind that `[sea]` of a scenario reads: CF names, units, longitudes and latitudes.

The sea is made up, and is the one of the preset `offshore`: an eddy of 0.5 m/s that drifts east, a turning of the
water with the inertial period of 45 degrees north, a mean flow, and a wind that veers from southwest to northwest.
"""

import sys

import netCDF4
import numpy as np

LON, LAT = -30.0, 45.0  # of the middle
MEAN, INERTIAL, EDDY = 0.10, 0.20, 0.50  # speeds of currents [m/s]
RADIUS = 9e3  # of the eddy, where it is fastest [m]
PERIOD = 12 / np.sin(np.radians(LAT))  # of inertial turning, clockwise [h]

x, y = np.meshgrid(np.arange(-30e3, 30e3 + 1, 2.5e3), np.arange(-30e3, 30e3 + 1, 2.5e3))  # [m]
lon, lat = LON + x[0] / (111320 * np.cos(np.radians(LAT))), LAT + y[:, 0] / 111132
hours = np.arange(0.0, 7.0)[:, None, None]

from_x, from_y = x - (-6e3 + 0.1 * 3600 * hours), y + 2e3  # of the center, which drifts at 0.1 m/s
around = EDDY / RADIUS * np.exp((1 - (from_x**2 + from_y**2) / RADIUS**2) / 2)
turn = 2 * np.pi * hours / PERIOD
toward = np.radians(45 - 15 * hours)  # the wind, counterclockwise from east: veering
speed = 8 + 0.5 * hours
fields = {
    "eastward_sea_water_velocity": MEAN + INERTIAL * np.cos(turn) - around * from_y,
    "northward_sea_water_velocity": -INERTIAL * np.sin(turn) + around * from_x,
    "eastward_wind": speed * np.cos(toward),
    "northward_wind": speed * np.sin(toward),
}

path = sys.argv[1] if len(sys.argv) > 1 else "sea.nc"
with netCDF4.Dataset(path, "w") as file:
    file.Conventions = "CF-1.11"
    file.title = "A made-up sea: an eddy, inertial turning and a veering wind"
    for name, values, units in (
        ("time", hours.ravel(), "hours since 2026-06-01 06:00:00"),
        ("lat", lat, "degrees_north"),
        ("lon", lon, "degrees_east"),
    ):
        file.createDimension(name, values.size)
        axis = file.createVariable(name, "f8", (name,))
        axis.units = units
        axis[:] = values
    for name, values in fields.items():
        field = file.createVariable(name, "i2", ("time", "lat", "lon"), zlib=True, fill_value=-32768)
        field.standard_name, field.units, field.scale_factor = name, "m s-1", 0.001
        field[:] = np.broadcast_to(values, (hours.size, *x.shape))
print(f"{path}: {hours.size} hours, {lat.size} x {lon.size} places")
