"""A recorded track, followed fix by fix. No current moves it: what the water did is in the record."""

from dataclasses import dataclass
from typing import Annotated

from shoal.compiler.kernel import kernel
from shoal.core.units import Doc, FileName, Meters, MetersPerSecond, Range, Seconds
from shoal.world.targets.contract import Target


@dataclass(frozen=True, kw_only=True)
class Track:
    """A recorded track in longitude and latitude: CSV, NMEA, GPX, KML, GeoJSON or NetCDF."""

    file: Annotated[
        str,
        FileName(),
        Doc("CSV, NMEA, GPX, KML, GeoJSON or CF NetCDF file; relative to the scenario's folder"),
    ]
    id: Annotated[str | None, Doc('which track of the file, as "COLUMN=VALUE"; "all" joins all')] = None
    radius: Annotated[Meters, Range(), Doc("rho: size of the target [m]")]
    max_gap: Annotated[
        Annotated[Seconds, Range(open=True)] | None,
        Doc("in a longer silence the target is absent [s]; default from the data"),
    ] = None
    max_speed: Annotated[
        MetersPerSecond, Range(open=True), Doc("a faster jump between two fixes is a GPS error [m/s]")
    ] = 40.0
    day_first: Annotated[bool | None, Doc("dates such as 10/03/2024 are in March; default from the data")] = None
    digest: Annotated[str | None, Doc("hash of the fixes used; Shoal fills it in, then insists on it")] = None


@kernel
def begin(target, around, draw):
    """Be where the track is at time 0."""
    follow_track(target, around.tracks, 0.0)


@kernel
def advance(target, around, draw):
    """Be where the track is at the end of the step."""
    follow_track(target, around.tracks, around.time)


@kernel
def follow_track(target, tracks, time):
    """Interpolate between the two fixes around `time`; outside the track and in long gaps the target is absent."""
    first = target.first_fix
    last = first + target.fixes - 1
    target.present = 0
    if time < tracks.time[first] or time > tracks.time[last]:
        return
    before = first
    after = last
    while after - before > 1:
        middle = (before + after) // 2
        if tracks.time[middle] <= time:
            before = middle
        else:
            after = middle
    if tracks.time[after] <= time:
        before = after
    span = tracks.time[after] - tracks.time[before]
    elapsed = time - tracks.time[before]
    if elapsed > 0.0 and span > target.max_gap:
        return
    share = elapsed / span if span > 0.0 else 0.0
    target.x = tracks.x[before] + share * (tracks.x[after] - tracks.x[before])
    target.y = tracks.y[before] + share * (tracks.y[after] - tracks.y[before])
    target.present = 1


TARGET = Target(name="track", options=Track, begin=begin, advance=advance, moves=False)
