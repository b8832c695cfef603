"""Between the Earth, as autopilots know it, and the arena's frame, whose axes are not quite east and north."""

from shoal.buoy.mavlink import Fix
from shoal.core.errors import ScenarioError
from shoal.core.geodesy import Frame
from shoal.scenario.schema import Scenario


def frame_of(scenario: Scenario) -> Frame:
    """Return the frame of a scenario.

    Raises
    ------
    ScenarioError : it does not say where it is
    MissingExtraError : pyproj is not installed
    """
    if scenario.area.origin is None:
        raise ScenarioError("area.origin", "is not given", "say at what longitude and latitude (0, 0) lies")
    return Frame(scenario.area.origin)


def in_frame(frame: Frame, fix: Fix) -> tuple[float, float, float, float]:
    """Return x, y [m] and vx, vy [m/s] of a fix in the frame."""
    x, y = frame.local(fix.lon, fix.lat)
    vx, vy = frame.turned(fix.lon, fix.lat, fix.east, fix.north)
    return float(x), float(y), float(vx), float(vy)


def over_ground(frame: Frame, fix: Fix, vx: float, vy: float) -> tuple[float, float]:
    """Return what a velocity of the frame is on the Earth: east and north, true [m/s]; the inverse of Frame.turned.

    Away from the origin the meridians turn, by about 1 degree in 65 km at 60 degrees north, and the frame stretches.
    """
    a, b, c, d = (float(each) for each in frame.turn(fix.lon, fix.lat))
    size = a * d - b * c
    return (d * vx - b * vy) / size, (a * vy - c * vx) / size
