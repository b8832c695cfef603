"""The sea of a scenario: where currents, wind and coast come from, and when it is."""

from datetime import datetime
from typing import Annotated, Any, Literal, Self

from pydantic import AfterValidator, BeforeValidator, Discriminator, Field, Tag, model_validator

from shoal.core.text import quoted
from shoal.core.units import Degrees, Meters, MetersPerSecond, Seconds, Unit
from shoal.scenario.frozen import Frozen, Positive

PerSecond = Annotated[float, Unit("1/s")]
MOST_CORNERS = 10_000
FILES = ("currents", "wind", "coast", "search_area")  # fields that may name one


def _file(text: str) -> str:
    if not text or "\0" in text:
        raise ValueError("a file is named by a text; name one")
    return text


FileName = Annotated[str, AfterValidator(_file)]
Place = tuple[Meters, Meters]


class UniformFlow(Frozen):
    """The same everywhere and always."""

    kind: Literal["uniform"]
    x: MetersPerSecond = Field(default=0.0, description="eastward [m/s]")
    y: MetersPerSecond = Field(default=0.0, description="northward [m/s]")

    def numbers(self) -> list[float]:
        """What world/sea/flows.py takes."""
        return [self.x, self.y]


class TideFlow(Frozen):
    """A tidal ellipse over a mean flow: mean + major cos(2 pi t / period + phase) + minor sin(...)."""

    kind: Literal["tide"]
    major_x: MetersPerSecond = Field(default=0.0, description="semi-major axis, eastward [m/s]")
    major_y: MetersPerSecond = Field(default=0.0, description="semi-major axis, northward [m/s]")
    minor_x: MetersPerSecond = Field(default=0.0, description="semi-minor axis, eastward [m/s]")
    minor_y: MetersPerSecond = Field(default=0.0, description="semi-minor axis, northward [m/s]")
    mean_x: MetersPerSecond = Field(default=0.0, description="mean, eastward [m/s]")
    mean_y: MetersPerSecond = Field(default=0.0, description="mean, northward [m/s]")
    period: Annotated[Seconds, Positive] = Field(default=44714.16, description="of the tide [s]; default: M2, 12.42 h")
    phase: Degrees = Field(default=0.0, description="at the start [deg]; 0: full flow along the major axis")

    def numbers(self) -> list[float]:
        """What world/sea/flows.py takes."""
        from math import pi, radians

        mean, major, minor = (self.mean_x, self.mean_y), (self.major_x, self.major_y), (self.minor_x, self.minor_y)
        return [*mean, *major, *minor, 2.0 * pi / self.period, radians(self.phase)]


class GyreFlow(Frozen):
    """A closed gyre in a square, psi = U L / pi sin(pi x / L) sin(pi y / L); no flow beyond its sides."""

    kind: Literal["gyre"]
    speed: MetersPerSecond = Field(description="U: largest, at the middle of each side; counterclockwise [m/s]")
    side: Annotated[Meters, Positive] = Field(description="L: of the square [m]")
    x: Meters = Field(default=0.0, description="its middle [m]")
    y: Meters = Field(default=0.0, description="its middle [m]")

    def numbers(self) -> list[float]:
        """What world/sea/flows.py takes."""
        return [self.speed, self.side, self.x, self.y]


class EddyFlow(Frozen):
    """A Gaussian vortex: speed U (r / R) exp((1 - r^2 / R^2) / 2) around a center that moves, with the water in it."""

    kind: Literal["eddy"]
    speed: MetersPerSecond = Field(description="U: largest, at the radius; counterclockwise [m/s]")
    radius: Annotated[Meters, Positive] = Field(description="R [m]")
    x: Meters = Field(default=0.0, description="its center at the start [m]")
    y: Meters = Field(default=0.0, description="its center at the start [m]")
    speed_x: MetersPerSecond = Field(default=0.0, description="of the center, eastward [m/s]")
    speed_y: MetersPerSecond = Field(default=0.0, description="of the center, northward [m/s]")

    def numbers(self) -> list[float]:
        """What world/sea/flows.py takes."""
        return [self.speed, self.radius, self.x, self.y, self.speed_x, self.speed_y]


class RotationFlow(Frozen):
    """Solid-body rotation around a point, for tests of what is known exactly."""

    kind: Literal["rotation"]
    period: Annotated[Seconds, Positive] = Field(description="of a turn, counterclockwise [s]")
    x: Meters = Field(default=0.0, description="of the point [m]")
    y: Meters = Field(default=0.0, description="of the point [m]")

    def numbers(self) -> list[float]:
        """What world/sea/flows.py takes."""
        from math import pi

        return [2.0 * pi / self.period, self.x, self.y]


FLOWS = {"uniform": UniformFlow, "tide": TideFlow, "gyre": GyreFlow, "eddy": EddyFlow, "rotation": RotationFlow}


def _source(value: Any) -> str:
    """What currents or wind come from: a file, or a flow of some kind."""
    if isinstance(value, str):
        return "file"
    return str(value.get("kind") if isinstance(value, dict) else getattr(value, "kind", type(value).__name__))


Flow = Annotated[
    Annotated[FileName, Tag("file")]
    | Annotated[UniformFlow, Tag("uniform")]
    | Annotated[TideFlow, Tag("tide")]
    | Annotated[GyreFlow, Tag("gyre")]
    | Annotated[EddyFlow, Tag("eddy")]
    | Annotated[RotationFlow, Tag("rotation")],
    Discriminator(_source),
]
Polygons = tuple[tuple[Place, ...], ...]


def _corners(polygons: Polygons) -> Polygons:
    for polygon in polygons:
        if len(polygon) < 3:
            raise ValueError(f"a polygon has 3 corners at least, this one {len(polygon)}; give their [x, y] in m")
    if sum(map(len, polygons)) > MOST_CORNERS:
        raise ValueError(f"polygons have {MOST_CORNERS:,} corners at most; write a GeoJSON file")
    return polygons


Shore = Annotated[
    Annotated[FileName, Tag("file")]
    | Annotated[Polygons, Field(min_length=1), AfterValidator(_corners), Tag("polygons")],
    Discriminator(lambda value: "file" if isinstance(value, str) else "polygons"),
]
TAGS = ("file", "polygons", *FLOWS)  # of the unions above, in where pydantic says that errors are


def _moment(value: Any) -> Any:
    """Refuse a time that does not say which."""
    if isinstance(value, str):
        try:
            value = datetime.fromisoformat(value)
        except ValueError:
            raise ValueError(f"{quoted(value)} is no time; write 2015-11-16T06:00:00Z") from None
    if not isinstance(value, datetime):
        raise ValueError(f"{quoted(value)} is no time; write 2015-11-16T06:00:00Z")
    if value.tzinfo is None:
        raise ValueError(
            f"{value.isoformat()} does not say which clock; write a Z for UTC, or an offset such as +01:00"
        )
    return value


class Sea(Frozen):
    """What carries agents and targets, and what stops them."""

    start: Annotated[datetime, BeforeValidator(_moment)] | None = Field(
        default=None, description="when the run begins, with Z or an offset; files and exports need it"
    )
    currents: Flow | None = Field(default=None, description="a NetCDF file, or a flow; default: still water")
    wind: Flow | None = Field(default=None, description="a NetCDF file, or a flow; default: no wind")
    coast: Shore | None = Field(
        default=None,
        description="land: a GeoJSON file, or polygons of [x, y] [m]; default: none, or where currents end",
    )
    search_area: Shore | None = Field(
        default=None,
        description="polygons that agents and targets stay in: a GeoJSON file, or [x, y] [m]; default: the arena",
    )
    cell: Annotated[Meters, Positive] | None = Field(
        default=None, description="of the raster of land [m]; default: by the size of the arena"
    )
    digest: str | None = Field(
        default=None, description="of what was read from files; Shoal fills it in, then insists on it"
    )

    @model_validator(mode="after")
    def _files_have_a_start(self) -> Self:
        for name in ("currents", "wind"):
            if isinstance(getattr(self, name), str) and self.start is None:
                raise ValueError(
                    f"{name} is a file, but start is not given; say when the run begins: 2015-11-16T06:00:00Z"
                )
        return self

    @property
    def files(self) -> dict[str, str]:
        """The files that it names, by field."""
        found = {name: getattr(self, name) for name in FILES}
        return {name: value for name, value in found.items() if isinstance(value, str)}
