"""Scenario: all a run needs, nothing it produces. Frozen, validated once; SI inside, "5 kn" accepted at the door."""

import hashlib
import json
from collections.abc import Mapping
from html import escape
from typing import Annotated, Any, Literal, Self, cast

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from shoal.core.agents import NEVER
from shoal.core.errors import ScenarioError, ShoalError, did_you_mean
from shoal.core.text import hides, plain, quoted
from shoal.core.units import (
    DegreesPerSecond,
    Kilograms,
    Meters,
    MetersPerSecond,
    MetersPerSecondSquared,
    Seconds,
)
from shoal.scenario.battery import Battery, check_battery
from shoal.scenario.choices import headline
from shoal.scenario.commands import Command
from shoal.scenario.disturbances import Disturbance
from shoal.scenario.durations import Steps, with_whole_steps
from shoal.scenario.frozen import MOST_ENTRIES, Chance, Count, Frozen, Name, NotNegative, Positive
from shoal.scenario.network import Degree, Network
from shoal.scenario.presence import MOST_AGENTS, Join, Loss
from shoal.scenario.scales import scales_of
from shoal.scenario.sea import Sea
from shoal.scenario.strategy_choice import StrategyChoice
from shoal.scenario.targets import MovingTarget, Target
from shoal.scenario.windage import Windage

ARENA_UNITS = 20.0  # the paper's arena measures 20 units; one is the length its figures are in


def _sentence(text: str) -> str:
    if len(text) > 2000 or any(hides(each) for each in text if each not in "\n\t"):
        raise ValueError(f"{quoted(text)} is not a sentence; write 2000 characters at most, none of them a control one")
    return text


class Area(Frozen):
    """The arena, a rectangle centered at (0, 0)."""

    width: Annotated[Meters, Positive] = Field(description="east-west side [m]")
    height: Annotated[Meters, Positive] = Field(description="north-south side [m]")
    agent_margin: Annotated[Meters, NotNegative] = Field(
        default=0.0, description="agents are kept this far inside the edge [m]; the published runs used 1.5 of 20"
    )
    origin: tuple[float, float] | None = Field(
        default=None, description="longitude and latitude of (0, 0) [deg], for vehicles, maps and recorded tracks"
    )

    @model_validator(mode="after")
    def _agents_have_room(self) -> Self:
        if 2 * self.agent_margin >= min(self.width, self.height):
            raise ValueError(
                f"agent_margin is {self.agent_margin:g} m, which leaves agents no room in {self.width:g} m x "
                f"{self.height:g} m; lower it below {min(self.width, self.height) / 2:g} m"
            )
        return self


class Fleet(Frozen):
    """Agents of one make."""

    name: Name = Field(description="what reports call it")
    count: Count = Field(description="number of agents")
    max_speed: Annotated[MetersPerSecond, Positive] = Field(description="top speed [m/s]")
    mass: Annotated[Kilograms, Positive] | None = Field(default=None, description="mass of one agent [kg]; for reports")
    sensor_radius: Annotated[Meters, NotNegative] = Field(
        default=0.0, description="a target is detected when its rim is within this of the agent [m]"
    )
    sensor: Literal["definite", "inverse-cube"] = Field(
        default="definite",
        description="detects whatever is within sensor_radius; or at any range, by a chance that falls with its cube",
    )
    sensor_time: Annotated[Seconds, Positive] = Field(
        default=1.0, description="inverse-cube: at sensor_radius it takes this long to detect with a chance of 1/2 [s]"
    )
    position_error: Annotated[Meters, NotNegative] = Field(
        default=0.0, description="standard deviation of each coordinate that its satellite receiver gives [m]"
    )
    position_error_time: Annotated[Seconds, Positive] = Field(
        default=60.0, description="how long such an error lasts: its correlation falls by e in it [s]"
    )
    start: Literal["uniform", "center", "corner", "arena"] = Field(
        default="uniform",
        description="where agents start: all over where they may go, in a tenth of its sides, or all over the arena",
    )
    neighbors: Degree | None = Field(default=None, description="k of these agents; default: network.neighbors")
    strategy: StrategyChoice | None = Field(default=None, description="of these agents; default: the scenario's")
    detection_probability: Chance = Field(
        default=1.0, description="chance per step that an agent notices a target within its reach"
    )
    false_alarm_probability: Chance = Field(
        default=0.0, description="chance per step that an agent reports an absent target"
    )
    mean_lifetime: Annotated[Seconds, Positive] | None = Field(
        default=None, description="agents fail at a constant rate, after this time on average [s]; default: never"
    )
    windage: Windage | None = Field(
        default=None, description="how the wind moves it: a share of its speed, or a leeway class; default: not at all"
    )
    max_acceleration: Annotated[MetersPerSecondSquared, Positive] | None = Field(
        default=None, description="largest change of velocity per second [m/s^2]; default: any"
    )
    max_turn_rate: Annotated[DegreesPerSecond, Positive] | None = Field(
        default=None, description="largest turn per second [deg/s]; default: any"
    )
    battery: Battery | None = Field(default=None, description="what it has on board; default: never empty")
    cost: Annotated[float, Field(strict=True, ge=0, le=1e12)] | None = Field(
        default=None, description="of one agent, in any currency; for reports"
    )

    @model_validator(mode="after")
    def _sensor_sees(self) -> Self:
        if self.sensor == "inverse-cube" and self.sensor_radius <= 0:
            raise ValueError("sensor is inverse-cube, but sensor_radius is 0; say at what range the chance is 1/2")
        return self

    @model_validator(mode="after")
    def _battery_goes_with_it(self) -> Self:
        check_battery(self)
        return self


class Motion(Frozen):
    """How decisions become moves."""

    update_order: Literal["synchronous", "sequential"] = Field(
        default="synchronous", description="all decide on the state at t, or one after the other on the moved ones"
    )
    speed_rule: Literal["cap", "divide"] = Field(
        default="cap", description="velocities are scaled down to the top speed, or divided by it as the paper prints"
    )


def _split(names: Any) -> Any:
    """Names in a text, set apart by commas, as options say them."""
    return tuple(name.strip() for name in names.split(",") if name.strip()) if isinstance(names, str) else names


class Scenario(Frozen):
    """All a run needs, nothing it produces."""

    name: Name = Field(default="scenario", description="what reports call it")
    description: Annotated[str, AfterValidator(_sentence)] = Field(default="", description="one sentence")
    time_step: Annotated[Seconds, Positive] = Field(description="dt [s]")
    steps: Steps = Field(description='time-steps of a run; or its duration, such as "2 h"')
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**64)] = Field(
        default=1, description="run r of two scenarios with one seed share their chance"
    )
    area: Area
    fleets: tuple[Fleet, ...] = Field(min_length=1, max_length=MOST_ENTRIES, description="one or more makes of agents")
    network: Network
    motion: Motion = Motion()
    strategy: StrategyChoice
    targets: tuple[Target, ...] = Field(min_length=1, max_length=MOST_ENTRIES, description="one or more targets")
    losses: tuple[Loss, ...] = Field(
        default=(), max_length=MOST_ENTRIES, description="agents that are lost during the run"
    )
    joins: tuple[Join, ...] = Field(default=(), max_length=MOST_ENTRIES, description="agents that join during the run")
    disturbances: tuple[Disturbance, ...] = Field(
        default=(), max_length=MOST_ENTRIES, description="what disturbs agents and targets during the run"
    )
    commands: tuple[Command, ...] = Field(
        default=(), max_length=MOST_ENTRIES, description="what agents are told during the run"
    )
    sea: Sea | None = Field(default=None, description="currents, wind and land; default: still, open water")
    metrics: Annotated[tuple[str, ...], BeforeValidator(_split)] = Field(
        default=(), max_length=MOST_ENTRIES, description="those that are measured; default: all"
    )
    precision: Literal["double", "single"] = Field(
        default="double",
        description="of distances between agents and of what neighbors exert; single takes about half the time",
    )

    _whole_steps = model_validator(mode="before")(with_whole_steps)

    def with_(self, **changes: Any) -> "Scenario":
        """Return a changed scenario, in the words of the command line, validated.

        >>> scenario.with_(neighbors=10, target_speed="6 kn", strategy="encircle", **{"network.loss": 0.1})

        Parameters
        ----------
        changes : shorthands (neighbors, fast, agents, target_speed, strategy, target_track, track_id), fields of a
            scenario (steps, seed, ...) or paths such as network.loss, fleets.0.count; quantities may have a unit

        Raises
        ------
        ScenarioError, TrackError, StrategyError : what cannot run
        """
        from shoal.scenario.load import load  # which needs this class

        return load(self, **changes)

    def scaled(self, factor: float | None = None, *, to: float | str | None = None) -> "Scenario":
        """Return the scenario with its lengths and times multiplied; speeds, numbers and what counts in steps stay.

        >>> shoal.load("oceans2020").scaled(to="3 km")

        Parameters
        ----------
        factor : above 0; or
        to : the longer side of the area wanted [m], or "3 km"

        Raises
        ------
        ScenarioError : neither or both, nothing to scale by, or a scenario at a place on Earth
        """
        from shoal.scenario.load import load  # which needs this class
        from shoal.scenario.scaled import scaled

        return load(scaled(self, factor, to))

    def model_copy(self, *, update: Mapping[str, Any] | None = None, deep: bool = False) -> Self:
        """Return a copy with fields changed, validated; see `with_`, which knows shorthands and paths.

        Parameters
        ----------
        update : {field: value}, each value complete
        deep : copy the values too

        Raises
        ------
        ScenarioError, StrategyError : unknown or wrong fields
        """
        if not update:
            return super().model_copy(deep=deep)
        for name in update:
            if name not in type(self).model_fields:
                hint = did_you_mean(name, type(self).model_fields).rstrip() or f"scenario.with_(**{{{name!r}: ...}})"
                raise ScenarioError(name, f"is not a field of a scenario (value {quoted(update[name])})", hint)
        from shoal.scenario.load import scenario_from

        return cast(Self, scenario_from({**vars(self), **update}))

    def __eq__(self, other: object) -> bool:
        """Whether both say the same, a record's too."""
        return isinstance(other, Scenario) and self.model_dump(mode="json") == other.model_dump(mode="json")

    def __hash__(self) -> int:
        return hash((self.name, self.steps, self.seed))

    def __repr__(self) -> str:
        """One line: who looks for what, for how long."""
        try:
            return (
                f"<Scenario {plain(self.name)}: {plain(headline(self))}; "
                f"{self.steps:,} steps of {self.time_step:g} s, seed {self.seed}, {self.hash}>"
            )
        except Exception:  # one made by force must be shown, too
            return "<Scenario that cannot run>"

    __str__ = __repr__

    def _repr_html_(self) -> str:
        """The line, and the scenario as its file would say it, for a notebook."""
        from shoal.scenario.load import to_toml

        try:
            text = to_toml(self)
        except ShoalError as error:
            text = str(error)
        return f"<details><summary>{escape(repr(self))}</summary><pre>{escape(text)}</pre></details>"

    @property
    def counts(self) -> list[int]:
        """Agents of each fleet, those who join later too."""
        later = {name: sum(join.count for join in self.joins if join.fleet == name) for name in self.fleet_names}
        return [fleet.count + later[fleet.name] for fleet in self.fleets]

    @property
    def fleet_names(self) -> list[str]:
        """Names of the fleets, in order."""
        return [fleet.name for fleet in self.fleets]

    @property
    def agents(self) -> int:
        """N: number of agents of all fleets, those who join later too."""
        return sum(self.counts)

    @property
    def report_steps(self) -> int:
        """Steps from one report of an agent to its next."""
        interval = self.network.interval
        return 1 if interval is None else int(min(round(interval / self.time_step), NEVER))

    @property
    def report_interval(self) -> float:
        """Time from one report of an agent to its next [s]."""
        return self.report_steps * self.time_step

    @property
    def unit(self) -> float:
        """Length of one arena unit [m]: the longer side / 20."""
        return max(self.area.width, self.area.height) / ARENA_UNITS

    @property
    def choices(self) -> dict[str, Any]:
        """All that shapes a run but its seed, as far as it is not left at its default.

        A field that later versions add, off by default, is not part of it: hashes and stores stay what they are.
        """
        content = self.model_dump(mode="json", exclude={"name", "description", "seed"}, exclude_defaults=True)
        kinds: tuple[Any, ...] = (*self.targets, *self.disturbances)
        for each, part in zip(kinds, [*content["targets"], *content.get("disturbances", ())], strict=True):
            part["kind"] = each.kind
            if "source" in type(each).model_fields:  # of a package, whose next version may do something else
                part["source"] = each.source
        for part in (
            content["strategy"],
            *(fleet.get("strategy", {}) for fleet in content["fleets"]),
            *content["targets"],
        ):
            part.pop("file", None)  # what a file says counts (source, digest), not where it lies
        for name in self.sea.files if self.sea else ():
            content["sea"][name] = "file"
        return content

    @property
    def hash(self) -> str:
        """16 hex digits over `choices`."""
        return hashlib.sha256(json.dumps(self.choices, sort_keys=True).encode()).hexdigest()[:16]

    @model_validator(mode="after")
    def _sea_is_somewhere(self) -> Self:
        files = self.sea.files if self.sea else {}
        if files and self.area.origin is None:
            name = next(iter(files))
            raise ValueError(
                f"sea.{name} is a file, but area.origin is not given; say where (0, 0) is: [lon, lat] in deg"
            )
        return self

    @model_validator(mode="after")
    def _reports_take_a_step(self) -> Self:
        interval = self.network.interval
        if interval is not None and interval < self.time_step * (1 - 1e-9):
            raise ValueError(
                f"network.interval is {interval:g} s, but agents speak once in a step of {self.time_step:g} s at most; "
                "raise it, or lower time_step"
            )
        return self

    @model_validator(mode="after")
    def _reports_wait_for_nobody(self) -> Self:
        if self.network.collects and self.motion.update_order == "sequential":
            name = "max_age" if self.network.max_age else "hops"
            raise ValueError(
                f"network.{name} is {getattr(self.network, name)}, but motion.update_order is sequential: agents hear "
                f"what others have just done, which nobody keeps or relays; write synchronous, or leave {name} out"
            )
        return self

    @model_validator(mode="after")
    def _single_is_together(self) -> Self:
        if self.precision == "single":
            alone = "in single precision all agents decide at once, and by reports as they are sent"
            if self.motion.update_order == "sequential":
                raise ValueError(f"precision is single, but motion.update_order is sequential; {alone}: change either")
            if self.network.collects:
                name = "max_age" if self.network.max_age else "hops"
                raise ValueError(
                    f"precision is single, but network.{name} is {getattr(self.network, name)}; {alone}: change either"
                )
        return self

    @model_validator(mode="after")
    def _two_agents(self) -> Self:
        if not 2 <= self.agents <= MOST_AGENTS:
            raise ValueError(
                f"the fleets have {self.agents} agents together; a swarm has 2 to {MOST_AGENTS:,}; change count"
            )
        return self

    @model_validator(mode="after")
    def _can_hear_k_neighbors(self) -> Self:
        degrees = {"network.neighbors": self.network.neighbors}
        degrees |= {f"fleets.{number}.neighbors": fleet.neighbors or 1 for number, fleet in enumerate(self.fleets)}
        if self.network.adaptive:
            degrees["network.adaptive.most"] = self.network.adaptive.most
        for name, degree in degrees.items():
            if degree != "all" and degree >= self.agents:
                raise ValueError(
                    f"{name} is {degree}, but {self.agents} agents can hear at most "
                    f'{self.agents - 1}; lower it, write "all" or add agents under fleets'
                )
        return self

    @model_validator(mode="after")
    def _changes_name_fleets(self) -> Self:
        named = {f"losses.{number}": loss.fleet for number, loss in enumerate(self.losses)}
        named |= {f"joins.{number}": join.fleet for number, join in enumerate(self.joins)}
        named |= {f"disturbances.{number}": each.fleet for number, each in enumerate(self.disturbances)}
        for name, fleet in named.items():
            if fleet is not None and fleet not in self.fleet_names:
                raise ValueError(f"{name}.fleet is {quoted(fleet)}, no fleet; there are: {', '.join(self.fleet_names)}")
        return self

    @model_validator(mode="after")
    def _losses_have_agents(self) -> Self:
        counts: dict[str | None, int] = {None: self.agents, **dict(zip(self.fleet_names, self.counts, strict=True))}
        for number, loss in enumerate(self.losses):
            if any(agent >= self.agents for agent in loss.agents):
                raise ValueError(
                    f"losses.{number}.agents has {max(loss.agents)}, but agents are 0 to {self.agents - 1}; correct it"
                )
            lost = sum(each.size for each in self.losses if loss.fleet in (each.fleet, None))
            if lost > counts[loss.fleet]:
                whose = f"fleet {loss.fleet!r}" if loss.fleet else "the scenario"
                raise ValueError(
                    f"losses.{number} takes {loss.size}, with which {lost} agents are lost in all, but "
                    f"{whose} has {counts[loss.fleet]}; take fewer"
                )
        return self

    @model_validator(mode="after")
    def _fleets_have_names(self) -> Self:
        names = self.fleet_names
        if len(set(names)) < len(names):
            raise ValueError(f"fleets.name: {', '.join(names)} are not all different; rename one")
        return self

    @model_validator(mode="after")
    def _waypoints_have_room(self) -> Self:
        for number, target in enumerate(self.targets):
            if isinstance(target, MovingTarget) and 2 * target.margin >= min(self.area.width, self.area.height):
                raise ValueError(
                    f"targets.{number}.margin is {target.margin:g} m and leaves waypoints no room; lower it"
                )
        return self

    @model_validator(mode="after")
    def _defaults_follow(self) -> Self:
        scales = scales_of(self)
        fleets = tuple(each.model_copy() for each in self.fleets)
        for fleet in fleets:
            if fleet.strategy:
                vars(fleet)["strategy"] = fleet.strategy.at(scales)
        vars(self).update(fleets=fleets, strategy=self.strategy.at(scales))
        return self

    @model_validator(mode="after")
    def _commands_can_be_obeyed(self) -> Self:
        for number, command in enumerate(self.commands):
            if any(agent >= self.agents for agent in command.agents):
                raise ValueError(
                    f"commands.{number}.agents has {max(command.agents)}, but agents are 0 to {self.agents - 1}; "
                    "correct it"
                )
        if type(self) is Scenario and any(command.set for command in self.commands):  # a record's loads nothing
            from shoal.scenario.instructions import check_commands  # which needs this class

            check_commands(self)
        return self


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scenario file."""
    schema: dict[str, Any] = _with_limits(Scenario.model_json_schema(mode="validation"))
    return schema


_LIMITS = {"gt": "exclusiveMinimum", "ge": "minimum", "lt": "exclusiveMaximum", "le": "maximum"}


def _with_limits(schema: Any) -> Any:
    """Write the limits of quantities in JSON Schema's words, with the number and not with the text beside it."""
    if isinstance(schema, list):
        return [_with_limits(each) for each in schema]
    if not isinstance(schema, dict):
        return schema
    result = {_LIMITS.get(key, key): _with_limits(value) for key, value in schema.items()}
    if "unit" in schema:
        limits = {key: result.pop(key) for key in _LIMITS.values() if key in result}
        result["anyOf"] = [{**result["anyOf"][0], **limits}, *result["anyOf"][1:]]
    return result
