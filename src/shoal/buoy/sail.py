"""What runs on one vehicle, without any sea but the real one: a buoy, its mesh, its body, its sensor and its log."""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

from shoal.buoy.aboard import Aboard
from shoal.buoy.body import open_body
from shoal.buoy.clock import CommonClock, clock_of
from shoal.buoy.detector import open_detector
from shoal.buoy.ground import frame_of
from shoal.buoy.helm import Helm
from shoal.buoy.logbook import Logbook
from shoal.buoy.meeting import meet
from shoal.buoy.orderbook import Orderbook
from shoal.buoy.trust import NOBODY, Trust, read_key
from shoal.buoy.twins import Twins
from shoal.buoy.zenoh_mesh import ZenohMesh, protocol_of
from shoal.core.errors import FleetError
from shoal.scenario.briefing import fleet_of
from shoal.scenario.load import Source, load
from shoal.scenario.schema import Scenario

MAX_AGE = 1  # steps, at least, that a report may be old to be heard, as in a fleet by the clock


@dataclass(frozen=True)
class Gear:
    """What a buoy is equipped with.

    Attributes
    ----------
    body : what it steers, as open_body takes it; arm, key : as there
    sensor : what sees targets, as open_detector takes it
    listen : HOST:PORT at which the other buoys reach it
    connect : HOST:PORT of the others; it may be the same list on all, its own among them
    wait : so many buoys must be there to begin; default: all of the scenario
    out : folder for its log; default: none is kept
    trust : whom it listens to
    """

    body: str
    sensor: str = "none"
    arm: bool = False
    key: bytes | None = None
    listen: str = "127.0.0.1:0"
    connect: Sequence[str] = ()
    wait: int | None = None
    out: str | Path | None = None
    trust: Trust = NOBODY


def sail(scenario: Source, id: int, gear: Gear, tell: Callable[[str], None]) -> None:
    """Run a buoy on its vehicle until the scenario is over, or until it is interrupted: then the vehicle is stopped.

    Parameters
    ----------
    scenario : of the whole swarm, the same on all buoys; those of another scenario or seed are not heard
    id : which agent it is
    gear : what it has
    tell : called with a sentence when something happens

    Raises
    ------
    ScenarioError, StrategyError : as Buoy; or the scenario does not say where it is
    FleetError : an address cannot be used, so many buoys cannot be waited for, or the buoy is there already
    BodyError : body or sensor cannot be had
    RecordError : its log cannot be written
    MissingExtraError : a library is needed and absent
    """
    scenario = load(scenario)
    fleet_of(scenario, id)
    wanted = scenario.agents if gear.wait is None else gear.wait
    if not 1 <= wanted <= scenario.agents:
        raise FleetError("--wait", f"is {wanted}", f"give 1 to {scenario.agents}, the buoys of the scenario")
    frame, period = frame_of(scenario), scenario.time_step
    with ExitStack() as stack:
        clock = CommonClock(id, period, clock_of([id]))
        detector = open_detector(gear.sensor, scenario, id, clock.elapsed)
        if hasattr(detector, "close"):
            stack.callback(detector.close)
        max_age = max(MAX_AGE, scenario.network.max_age)
        aboard = Aboard(scenario, [id], max_age=max_age, relays=True)
        if gear.trust.command_key:
            key = read_key(gear.trust.command_key)
            aboard.orderbook = Orderbook(scenario, mesh_of(scenario), key, time.time())
        aboard.warm()  # compiles: nothing must, under way
        log = Logbook(gear.out, id, frame)
        stack.callback(log.close)
        protocol = protocol_of(gear.trust.mesh_config)
        mesh = ZenohMesh(
            mesh_of(scenario),
            str(id),
            listen=f"{protocol}/{gear.listen}",
            connect=[f"{protocol}/{each}" for each in others_of(gear)],
            blocks=False,
            config=gear.trust.mesh_config,
        )
        stack.callback(mesh.close)
        twins = Twins(mesh, id, time.monotonic, tell)
        twins.wait(time.sleep)
        body = open_body(
            gear.body,
            scenario,
            id,
            detector=detector,
            arm=gear.arm,
            key=gear.key,
            tell=lambda said: tell(f"buoy {id}: {said}"),
        )
        stack.callback(body.close)
        if gear.listen.endswith(":0"):
            tell(f"buoy {id} listens at {mesh.place}")
        helm = None
        try:
            mesh.join()
            meet(mesh, clock, id, wanted, period, tell, twins)
            tell(f"buoy {id}: step {max(0, clock.step()):,} of {scenario.steps:,}")
            helm = Helm(aboard, mesh, body, clock, log, twins)
            helm.run(scenario.steps)
        finally:
            body.close()
            tell(_summary(id, helm, clock, aboard, log, twins))


def mesh_of(scenario: Scenario) -> str:
    """What the mesh of a swarm is called: those of another scenario or seed are on another."""
    return f"shoal/{scenario.hash[:16]}-{scenario.seed}"


def others_of(gear: Gear) -> list[str]:
    """Whom a buoy connects to: all that it is told of, or where its own address is among them, those before it."""
    told = list(gear.connect)
    return told[: told.index(gear.listen)] if gear.listen in told else told


def _summary(id: int, helm: Helm | None, clock: CommonClock, aboard: Aboard, log: Logbook, twins: Twins) -> str:
    """What it did, in one line."""
    if helm is None:
        return f"buoy {id} ended before the first step; its vehicle was stopped"
    counts, heard = helm.counts, aboard.inbox.counts
    useless = sum(heard.values()) - heard["new"] - heard["reordered"]
    said = [
        f"decided in {counts['decided']:,} step{'s' * (counts['decided'] != 1)}",
        f"skipped {counts['skipped']:,}",
        f"did not know its place in {counts['unready']:,}",
        f"was not obeyed in {counts['disobeyed']:,}",
        f"heard nobody in {counts['alone']:,}",
        f"{heard['new']:,} report{' was' if heard['new'] == 1 else 's were'} new, {useless:,} of no use",
        f"step 0 was moved by {1000 * clock.furthest:.1f} ms at most",
    ]
    if twins.came or aboard.inbox.foreign:
        said.append(f"another buoy {id} came {twins.came:,} times and said {aboard.inbox.foreign:,} reports")
    kept = f"; log: {log.file}{' (not all of it: the disk is full)' if log.full else ''}" if log.file else ""
    return f"buoy {id} stopped its vehicle; {', '.join(said)}{kept}"
