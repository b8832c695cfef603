"""shoal chart: a run on chart plotters, by AIS over TCP."""

from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from shoal.cli.numbers import Integer, Number
from shoal.cli.older import opened
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler, tell_of_compiling

if TYPE_CHECKING:
    from shoal.viewer.broadcast import Broadcast
    from shoal.viewer.chart import Moment


def chart(
    source: str | None = None,
    /,
    *,
    fleet: str | None = None,
    tcp: Integer = 10110,
    host: str = "127.0.0.1",
    speed: Number = 1.0,
    every: Number = 1.0,
    run: Integer = 0,
    origin: Annotated[str | None, Parameter(allow_leading_hyphen=True)] = None,
    loop: Annotated[bool, Parameter(negative=())] = False,
) -> None:
    """Show a run on chart plotters as it goes: buoys and targets as AIS, over TCP. Ctrl-C ends it.

    It begins when the first plotter connects, and ends with the run. A fleet is shown as it is, whoever is connected.

    Parameters
    ----------
    source
        A record (folder made by --out), which is replayed; or a preset's name or a TOML file, which is simulated.
    fleet
        Show a fleet that runs instead: HOST:PORT as `shoal fleet` says it. It is only listened to.
    tcp
        Port to serve at; 0 takes a free one.
    host
        Address to serve at; the default can be reached from this machine only.
    speed
        Times real time.
    every
        Seconds of the run between two reports of a buoy, at least.
    run
        Number of the run.
    origin
        Longitude and latitude of the center, LON,LAT in degrees; default the scenario's area.origin.
    loop
        Begin again at the end.
    """
    load_compiler()
    from shoal.core.errors import ScenarioError
    from shoal.record.voyage.anchor import anchor_of, place_of
    from shoal.record.voyage.voyages import crafts_of, frames_of
    from shoal.run.facts import facts_of
    from shoal.run.simulation import Simulation
    from shoal.scenario.load import load
    from shoal.viewer.chart import check_pace, greeting, live_moments, recorded_moments

    check_pace(speed, every)
    if run < 0:
        raise ScenarioError("--run", f"is {run}", "ask for 0 or more")
    place, now = None if origin is None else place_of(origin), datetime.now(UTC)
    if fleet is not None:
        if source is not None or run or loop or speed != 1.0:
            problem, fix = "is shown as it runs", "leave out SOURCE, --run, --loop and --speed"
            raise ScenarioError("--fleet", problem, fix)
        _follow(fleet, place, every, (host, tcp))
        return
    if source is None:
        raise ScenarioError(
            "SOURCE", "is missing", "name a record, a scenario, or a fleet that runs (--fleet HOST:PORT)"
        )
    if Path(source).is_dir():
        record = opened(source)
        scenario, facts = record.scenario, record.facts
        frames_of(record, run)
        anchor = anchor_of(scenario, origin=place, start=now)

        def begin() -> "Iterator[Moment]":
            return recorded_moments(record, run, every, anchor)
    else:
        scenario = load(source)
        facts = facts_of(scenario)
        anchor = anchor_of(scenario, origin=place, start=now)
        tell_of_compiling(scenario)
        simulations = [Simulation(scenario, run)]  # compiled before anybody connects

        def begin() -> "Iterator[Moment]":
            simulation = simulations.pop() if simulations else Simulation(scenario, run)
            return live_moments(simulation, every, anchor)

    _serve(begin, greeting(crafts_of(facts, len(scenario.targets))), (host, tcp), speed, loop)


def _follow(fleet: str, place: tuple[float, float] | None, every: float, address: tuple[str, int]) -> None:
    from shoal.buoy.address import host_and_port
    from shoal.buoy.beacon import Lookout
    from shoal.core.errors import ScenarioError
    from shoal.core.geodesy import Frame
    from shoal.record.voyage.voyages import crafts_of
    from shoal.run.facts import facts_told
    from shoal.viewer.broadcast import Broadcast
    from shoal.viewer.bulletin import bulletins
    from shoal.viewer.chart import follow, greeting

    with suppress(KeyboardInterrupt), closing(Lookout(*host_and_port(fleet, "--fleet"))) as lookout:
        heard = bulletins(lookout, 0.05)
        first = next(filter(None, heard), None)
        if first is None:
            raise ScenarioError("--fleet", "is gone already", "start it again")
        origin = place or first.origin
        if origin is None:
            fix = "say where its center lies: --origin LON,LAT, such as --origin=-1.3,50.8"
            raise ScenarioError("--fleet", "is of a scenario that has no place on Earth (area.origin)", fix)
        hello = greeting(crafts_of(facts_told(first.scene), len(first.scene["targets"])))
        with Broadcast(*address, hello) as broadcast:
            _tell_where(address[0], broadcast.port)
            moments = follow(heard, broadcast, every, Frame(origin))
            broadcast.finish()
            _tell_what(moments, broadcast)


def _tell_where(host: str, port: int) -> None:
    from shoal.viewer.address import is_local, reachable

    note(f"waiting for a chart plotter: AIS over TCP at {reachable(host)}:{port} (Ctrl-C ends)")
    if not is_local(host):
        note(f"anybody who can reach {host} can see this run")


def _tell_what(moments: int, broadcast: "Broadcast") -> None:
    missed = f"; {broadcast.missed:,} were missed by slow ones" if broadcast.missed else ""
    note(f"chart: {moments:,} moments for {broadcast.met} plotter{'s' * (broadcast.met != 1)}{missed}")


def _serve(
    begin: "Callable[[], Iterator[Moment]]", hello: bytes, address: tuple[str, int], speed: float, loop: bool
) -> None:
    from shoal.viewer.broadcast import Broadcast
    from shoal.viewer.chart import play

    with suppress(KeyboardInterrupt), Broadcast(*address, hello) as broadcast:
        _tell_where(address[0], broadcast.port)
        broadcast.wait_for_somebody()
        note("a chart plotter is connected; the run begins")
        moments = play(begin(), broadcast, speed)
        while loop:
            moments += play(begin(), broadcast, speed)
        broadcast.finish()
        _tell_what(moments, broadcast)
