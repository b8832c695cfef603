"""What the engine works on, built from a scenario: world, swarm, radio, losses, targets, disturbances."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from shoal.core.agents import (
    KeptMemories,
    ListedMemories,
    Memories,
    SingleListedMemories,
    SingleMemories,
    TurnMemories,
    aligned_zeros,
    new_swarm,
)
from shoal.core.declared import Declared
from shoal.core.errors import PluginError, ScenarioError
from shoal.engine.stage import new_nature
from shoal.metrics.chosen import skipped
from shoal.scenario.battery import drag_of
from shoal.scenario.briefing import degrees, shares
from shoal.scenario.crew import Crew
from shoal.scenario.schema import Fleet, Scenario
from shoal.scenario.targets import MovingTarget
from shoal.scenario.windage import leeway
from shoal.world.arena import World
from shoal.world.assembled import fill
from shoal.world.disturbances.catalogue import KINDS as DISTURBANCES
from shoal.world.disturbances.catalogue import NUMBERS as DISTURBANCE_NUMBERS
from shoal.world.disturbances.contract import Nature
from shoal.world.radio import new_radio
from shoal.world.reception import collecting
from shoal.world.sea.field import STILL
from shoal.world.sea.sea import Leeway, Sea
from shoal.world.targets.catalogue import KINDS, NUMBERS, TARGET_FIELDS
from shoal.world.targets.contract import Tracks


def build_world(scenario: Scenario, sea: Sea) -> World:
    """What nobody controls."""
    area, fleets = scenario.area, scenario.fleets
    return World(
        agents=scenario.agents,
        fleets=len(scenario.fleets),
        time_step=scenario.time_step,
        half_x=area.width / 2,
        half_y=area.height / 2,
        clamp_x=area.width / 2 - area.agent_margin,
        clamp_y=area.height / 2 - area.agent_margin,
        sequential=scenario.motion.update_order == "sequential",
        divide=scenario.motion.speed_rule == "divide",
        inertial=any(fleet.max_acceleration or fleet.max_turn_rate for fleet in fleets),
        imperfect=any(fleet.detection_probability < 1 or fleet.false_alarm_probability > 0 for fleet in fleets)
        or bool(scenario.disturbances)
        or any(fleet.sensor == "inverse-cube" for fleet in fleets),
        mortal=_is_mortal(scenario),
        disturbed=bool(scenario.disturbances),
        inexact=_is_inexact(scenario),
        powered=any(fleet.battery for fleet in fleets),
        flowing=sea.currents.kind != STILL or sea.wind.kind != STILL,
        windy=sea.wind.kind != STILL and any(fleet.windage for fleet in fleets),
        coastal=sea.shore.distance.size > 1,
        ordered=False,
        listed=0,
        single=scenario.precision == "single",
        skipped=skipped(scenario.metrics),
        target_radius=min(target.radius for target in scenario.targets),
    )


FEWEST_LISTED = 150  # agents from which on lists of neighbors are faster than the distances of all pairs
MOST_MEASURED = 10_000  # agents of which the distances of all pairs are kept: 800 MB


def kind_of_memories(scenario: Scenario, world: World) -> type[Memories]:
    """Return the class of a run's memories: which way to listen is compiled, see engine/arrivals.py."""
    if world.listed:
        return SingleListedMemories if world.single else ListedMemories
    if world.single:
        return SingleMemories
    if scenario.network.max_age:
        return KeptMemories
    return TurnMemories if world.sequential else Memories


def most_listed(scenario: Scenario, world: World, swarm: Any, radio: Any) -> int:
    """Return the most neighbors that lists must hold; 0 where the distances of all pairs say who hears whom.

    Raises
    ------
    ScenarioError : there are more agents than distances are kept of, and something needs them
    """
    most = int(max(swarm.neighbors[: scenario.agents].max(), radio.most[: scenario.agents].max()))
    network = scenario.network
    needed = [
        ("motion.update_order", "is sequential", world.sequential),
        ("sea", "has land or a limit", world.coastal),
        ("network", "keeps or relays reports", network.collects),
        ("network.neighbors", f"is {most}, more than a quarter of all", 4 * most > scenario.agents),
    ]
    for where, what, needs in needed:
        if needs and scenario.agents > MOST_MEASURED:
            problem = f"{what}, with {scenario.agents:,} agents"
            raise ScenarioError(where, problem, f"that works with up to {MOST_MEASURED:,} agents; change either")
    return 0 if scenario.agents < FEWEST_LISTED or any(needs for *_, needs in needed) else most


def _is_mortal(scenario: Scenario) -> bool:
    return bool(
        scenario.losses
        or scenario.joins
        or scenario.disturbances
        or any(fleet.mean_lifetime or fleet.battery for fleet in scenario.fleets)
    )


def _is_inexact(scenario: Scenario) -> bool:
    return any(fleet.position_error > 0 for fleet in scenario.fleets)


def build_swarm(scenario: Scenario, crew: Crew) -> Any:
    """Agents in the order of the fleets, nowhere yet; those who join later are the last of their fleet."""
    agents, fleets, counts = scenario.agents, scenario.fleets, scenario.counts
    points = max(len(fleet.battery.curve) if fleet.battery and fleet.battery.curve else 1 for fleet in fleets)
    swarm = new_swarm(counts, crew.memory, crew.told, exact=not _is_inexact(scenario), points=points)

    def fill(array: Any, values: list[Any]) -> None:
        array[:agents] = np.repeat(values, counts, axis=0)

    fill(swarm.max_speed, [fleet.max_speed for fleet in fleets])
    fill(swarm.sensor_radius, [fleet.sensor_radius for fleet in fleets])
    if any(fleet.sensor == "inverse-cube" for fleet in fleets):
        swarm = swarm._replace(horizon=aligned_zeros(swarm.x.size))
        fill(swarm.horizon, [_horizon(fleet) for fleet in fleets])
        fill(swarm.glimpse, [_glimpse(fleet) for fleet in fleets])
    fill(swarm.detection, [fleet.detection_probability for fleet in fleets])
    fill(swarm.false_alarm, [fleet.false_alarm_probability for fleet in fleets])
    fill(swarm.max_acceleration, [fleet.max_acceleration or math.inf for fleet in fleets])
    fill(swarm.max_turn_rate, [math.radians(fleet.max_turn_rate or math.inf) for fleet in fleets])
    fill(swarm.position_error, [fleet.position_error for fleet in fleets])
    fill(swarm.position_memory, [math.exp(-scenario.time_step / fleet.position_error_time) for fleet in fleets])
    fill(swarm.capacity, [fleet.battery.capacity if fleet.battery else math.inf for fleet in fleets])
    fill(swarm.hotel, [fleet.battery.hotel if fleet.battery else 0.0 for fleet in fleets])
    fill(swarm.drag, [drag_of(fleet) for fleet in fleets])
    for curve, make in zip(swarm.curve, fleets, strict=True):
        if make.battery and make.battery.curve:
            known = np.array(make.battery.curve).T
            curve[:] = np.pad(known, ((0, 0), (0, points - known.shape[1])), mode="edge")
    fill(swarm.neighbors, degrees(scenario, crew))
    fill(swarm.leeway, [leeway(fleet.windage) for fleet in fleets])
    swarm.share_end[:agents] = shares(scenario)
    nobody = swarm.fleet_end - [
        sum(join.count for join in scenario.joins if join.fleet == each.name) for each in fleets
    ]
    for join in scenario.joins:
        fleet = scenario.fleet_names.index(join.fleet)
        swarm.joins[nobody[fleet] : nobody[fleet] + join.count] = join.step
        nobody[fleet] += join.count
    return swarm


def _horizon(fleet: Fleet) -> float:
    return math.inf if fleet.sensor == "inverse-cube" else fleet.sensor_radius


def _glimpse(fleet: Fleet) -> float:
    """The m of `glimpsed` [m^3/s], such that at sensor_radius half of all targets are detected in sensor_time."""
    return math.log(2.0) * fleet.sensor_radius**3 / fleet.sensor_time if fleet.sensor == "inverse-cube" else 0.0


def build_radio(scenario: Scenario, crew: Crew, world: World, lanes: int) -> Any:
    """Limits of the network, and room for reports in flight. Strategies that hear all get k = N - 1 here, too."""
    network, adaptive = scenario.network, scenario.network.adaptive
    radio = new_radio(
        lanes,
        crew.told,
        limited=network.range is not None
        or network.delay > 0
        or scenario.report_steps > 1
        or world.mortal
        or network.collects,
        reach=network.range or math.inf,
        delay=network.delay,
        loss=network.loss,
        interval=scenario.report_steps,
        degree=(adaptive.fewest, adaptive.most, adaptive.patience) if adaptive else None,
    )
    if network.collects:
        radio = collecting(radio, scenario.agents, network.max_age, network.hops)
    everybody = np.repeat([strategy.hears_all for strategy in crew.strategies], scenario.counts)
    for limit in (radio.fewest, radio.most):
        limit[: scenario.agents][everybody] = scenario.agents - 1
    return radio


def build_nature(scenario: Scenario, lanes: int) -> Nature:
    """One record per disturbance, and room for what each does to so many lanes of agents."""
    nature = new_nature(len(scenario.disturbances), lanes)
    for record, disturbance in zip(nature.disturbances, scenario.disturbances, strict=True):
        record["kind"] = DISTURBANCE_NUMBERS[disturbance.kind]
        record["fleet"] = scenario.fleet_names.index(disturbance.fleet) if disturbance.fleet else -1
        record["since"] = disturbance.since
        record["until"] = math.inf if disturbance.until is None else disturbance.until
        _work_out(record, DISTURBANCES[record["kind"]], disturbance)
    return nature


def losses_of(scenario: Scenario) -> Any:
    """Step, fleet (-1: any), count and agent (-1: by lot) of every loss, in the order of the steps, (C, 4)."""
    names = scenario.fleet_names
    rows = [
        [loss.step, names.index(loss.fleet) if loss.fleet else -1, loss.size if agent < 0 else 1, agent]
        for loss in scenario.losses
        for agent in loss.agents or (-1,)
    ]
    return np.array(sorted(rows), np.int64).reshape(-1, 4)


def build_targets(scenario: Scenario, tracks: Sequence[Any]) -> tuple[Any, Tracks]:
    """One record per target; the fixes of recorded ones one after the other."""
    targets = np.zeros(len(scenario.targets), TARGET_FIELDS).view(np.recarray)
    unread = list(tracks)
    first_fix = 0
    for record, target in zip(targets, scenario.targets, strict=True):
        record["kind"] = NUMBERS[target.kind]
        record["radius"] = target.radius
        record["present"] = 1
        record["lost"] = -1
        for name, number in zip(Leeway._fields, leeway(target.windage), strict=True):
            record[f"leeway_{name}"] = number
        if isinstance(target, MovingTarget):
            record["half_x"] = scenario.area.width / 2 - target.margin
            record["half_y"] = scenario.area.height / 2 - target.margin
            record["speed"] = target.speed
            record["surface_time"], record["dive_time"] = target.surface_time or 0.0, target.dive_time or 0.0
        _work_out(record, KINDS[NUMBERS[target.kind]], target)
        if target.kind == "track":
            track = unread.pop(0)
            record["first_fix"] = first_fix
            record["fixes"] = track.time.size
            record["max_gap"] = track.max_gap
            first_fix += track.time.size
    return targets, _join_tracks(tracks)


def _work_out(record: Any, kind: Declared[Any], options: Any) -> None:
    """Write what is chosen of a target or a disturbance into its record.

    Raises
    ------
    PluginError : an installed package cannot work it out
    """
    try:
        fill(record, kind.value, options)
    except Exception as error:
        if kind.package is None:
            raise
        problem = f"{kind.value.name!r} cannot be made of its options: {type(error).__name__}: {error}"
        raise PluginError(kind.package, problem, "fix or uninstall it") from error


def _join_tracks(tracks: Sequence[Any]) -> Tracks:
    if not tracks:
        return Tracks(np.zeros(1), np.zeros(1), np.zeros(1))
    return Tracks(*(np.concatenate([getattr(track, name) for track in tracks]) for name in ("time", "x", "y")))
