"""The targets of a scenario, one class per kind."""

from typing import Annotated, Literal, Self

from pydantic import AfterValidator, Field, model_validator

from shoal.core.units import Degrees, Meters, MetersPerSecond, Seconds
from shoal.scenario.frozen import Count, Frozen, NotNegative, Positive


def _path(text: str) -> str:
    if "\0" in text:
        raise ValueError("file holds a NUL, which no path can; name a file")
    return text


class StillTarget(Frozen):
    """A target that stays where it is."""

    kind: Literal["still"] = "still"
    radius: Annotated[Meters, NotNegative] = Field(description="rho: size of the target [m]")
    x: Meters = Field(default=0.0, description="east of the center [m]")
    y: Meters = Field(default=0.0, description="north of the center [m]")


class MovingTarget(Frozen):
    """What all targets that move by a rule have in common."""

    radius: Annotated[Meters, NotNegative] = Field(description="rho: size of the target [m]")
    speed: Annotated[MetersPerSecond, NotNegative] = Field(description="constant speed [m/s]")
    margin: Annotated[Meters, NotNegative] = Field(
        default=0.0,
        description="it stays this far inside the edge [m]; of waypoint targets: waypoints and start",
    )
    surface_time: Annotated[Seconds, Positive] | None = Field(
        default=None, description="of a target that dives: how long it can be detected each time [s]"
    )
    dive_time: Annotated[Seconds, Positive] | None = Field(
        default=None, description="and how long it cannot, in turn [s]; default: it never dives"
    )

    @model_validator(mode="after")
    def _surfaces_and_dives(self) -> Self:
        if (self.surface_time is None) != (self.dive_time is None):
            raise ValueError("surface_time and dive_time belong together; give both or none")
        return self


class WaypointTarget(MovingTarget):
    """The paper's target: constant speed toward uniform random waypoints, turning at most so far per step."""

    kind: Literal["waypoint"] = "waypoint"
    max_turn: Annotated[Degrees, Field(gt=0, le=180)] = Field(default=20.0, description="largest turn in a step [deg]")
    waypoint_reach: Annotated[Meters, Positive] = Field(description="a new waypoint is taken when closer than this [m]")
    waypoint_patience: Count = Field(default=200, description="or after this many steps on the same one")


class LineTarget(MovingTarget):
    """Straight lines, reflected at the edge."""

    kind: Literal["line"] = "line"


class WalkTarget(MovingTarget):
    """A persistent random walk, reflected at the edge."""

    kind: Literal["walk"] = "walk"
    persistence: Annotated[Seconds, Positive] = Field(
        default=10.0, description="after this time the mean cosine of the turn is 1/e [s]"
    )


class LevyTarget(MovingTarget):
    """A Levy walk: legs of power-law length in random directions, reflected at the edge."""

    kind: Literal["levy"] = "levy"
    exponent: Annotated[float, Field(strict=True, ge=1, le=5)] = Field(default=2.0, description="mu: P(l) ~ l^-mu")
    shortest: Annotated[Meters, Positive] = Field(description="shortest leg [m]")
    longest: Annotated[Meters, Positive] = Field(description="longest leg [m]")

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.shortest > self.longest:
            raise ValueError(f"shortest is {self.shortest:g} m, more than longest, {self.longest:g} m; swap them")
        return self


class EvasiveTarget(MovingTarget):
    """Flees from the buoys that it sees and from walls; otherwise wanders."""

    kind: Literal["evasive"] = "evasive"
    sight: Annotated[Meters, NotNegative] = Field(description="it flees from buoys nearer than this [m]")
    wall_sight: Annotated[Meters, Positive] = Field(description="it turns from edges nearer than this [m]")
    max_turn: Annotated[Degrees, Field(gt=0, le=180)] = Field(default=20.0, description="largest turn in a step [deg]")
    persistence: Annotated[Seconds, Positive] = Field(
        default=10.0, description="of its wandering: after this time the mean cosine of the turn is 1/e [s]"
    )


class DriftTarget(MovingTarget):
    """Drifts with a uniform current, its own speed on top in a direction that wanders; re-enters at the other side."""

    kind: Literal["drift"] = "drift"
    speed: Annotated[MetersPerSecond, NotNegative] = Field(default=0.0, description="own speed [m/s]")
    current_x: MetersPerSecond = Field(default=0.0, description="eastward current [m/s]")
    current_y: MetersPerSecond = Field(default=0.0, description="northward current [m/s]")
    persistence: Annotated[Seconds, Positive] = Field(
        default=10.0, description="of its own motion: after this time the mean cosine of the turn is 1/e [s]"
    )


class TrackTarget(Frozen):
    """A recorded track in longitude and latitude: CSV, NMEA, GPX, KML, GeoJSON or NetCDF."""

    kind: Literal["track"] = "track"
    file: Annotated[str, AfterValidator(_path)] = Field(
        min_length=1, description="CSV, NMEA, GPX, KML, GeoJSON or CF NetCDF file; relative to the scenario's folder"
    )
    id: str | None = Field(default=None, description='which track of the file, as "COLUMN=VALUE"; "all" joins all')
    radius: Annotated[Meters, NotNegative] = Field(description="rho: size of the target [m]")
    max_gap: Annotated[Seconds, Positive] | None = Field(
        default=None, description="in a longer silence the target is absent [s]; default from the data"
    )
    max_speed: Annotated[MetersPerSecond, Positive] = Field(
        default=40.0, description="a faster jump between two fixes is a GPS error [m/s]"
    )
    day_first: bool | None = Field(
        default=None, description="dates such as 10/03/2024 are in March; default from the data"
    )
    digest: str | None = Field(
        default=None, description="hash of the fixes used; Shoal fills it in, then insists on it"
    )


TARGETS: dict[str, type[Frozen]] = {
    "still": StillTarget,
    "waypoint": WaypointTarget,
    "line": LineTarget,
    "walk": WalkTarget,
    "levy": LevyTarget,
    "evasive": EvasiveTarget,
    "drift": DriftTarget,
    "track": TrackTarget,
}

Target = Annotated[
    StillTarget | WaypointTarget | LineTarget | WalkTarget | LevyTarget | EvasiveTarget | DriftTarget | TrackTarget,
    Field(discriminator="kind"),
]
