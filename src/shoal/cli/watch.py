"""shoal watch: a run in the browser as it runs."""

import webbrowser
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger, MaybeSteps, Number
from shoal.cli.older import opened
from shoal.cli.options import edited_table
from shoal.cli.progress import note, progress_bar
from shoal.cli.showing import serving_outlook
from shoal.cli.startup import load_compiler, tell_of_compiling

if TYPE_CHECKING:
    from shoal.run.change_log import ChangeLog
    from shoal.viewer.session import Session


def watch(
    source: str | None = None,
    /,
    *,
    fleet: str | None = None,
    against: str | None = None,
    neighbors: Annotated[str | None, Parameter(name=["--neighbors", "-k"])] = None,
    fast: MaybeInteger = None,
    agents: MaybeInteger = None,
    density: Literal["keep"] | None = None,
    target_speed: str | None = None,
    steps: MaybeSteps = None,
    seed: MaybeInteger = None,
    strategy: str | None = None,
    target_track: str | None = None,
    track_id: str | None = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    speed: Number = 1.0,
    host: str = "127.0.0.1",
    port: Integer = 0,
    browser: bool = True,
    out: Path | None = None,
    replay_changes: Path | None = None,
) -> None:
    """Watch a run in the browser and change it as it runs. Ctrl-C ends it.

    Parameters
    ----------
    source
        A preset's name, a TOML file, or a record (folder made by --out), whose frames are played. Default oceans2020.
    fleet
        Watch a fleet that runs instead: HOST:PORT as `shoal fleet` says it. It is only listened to.
    against
        A second run beside it, on the same seed: another preset or file, or a change such as neighbors=5.
    neighbors
        k: every agent hears its k nearest others.
    fast
        Number of agents of the fastest fleet; the slowest fleet gives or takes the difference.
    agents
        Number of agents in all, in the scenario's shares of fleets.
    density
        keep: with --agents, the sides of the arena grow with the root of their number.
    target_speed
        Speed of the waypoint targets: m/s, or with a unit, such as "6 kn".
    steps
        Time-steps of a recorded run (--out), or its duration, such as "2 h"; without --out a run has no end.
    seed
        Seed of all chance.
    strategy
        A strategy's name (see `shoal strategies`) or a Python file that defines one.
    target_track
        Recorded track to follow instead (CSV, NMEA, GPX, KML, GeoJSON, NetCDF): arena and lengths are fitted around it.
    track_id
        Which track of the file, as COLUMN=VALUE, such as mmsi=235069877; all joins all.
    assignments
        Any field by its path, such as strategy.delta=0.02; may be repeated.
    speed
        Times real time, 0.1 to 1000, to begin with.
    host
        Address to serve at; the default can be reached from this machine only.
    port
        Port to serve at; 0 takes a free one.
    browser
        Open the page in the browser.
    out
        Save a record of the steps watched to this new folder, at the end of the run or at Ctrl-C. What you change
        meanwhile is logged beside it, and the record says that it was steered. Fleets stay: a record has one roster.
    replay_changes
        A log of changes that the page saved: its scenario runs, and the same is changed at the same steps. Then time
        stops, and the run is yours.
    """
    load_compiler()
    from shoal.core.errors import ScenarioError
    from shoal.viewer.server import require_libraries

    require_libraries()  # missing ones are named now, not after compiling

    changes: dict[str, Any] = {
        "agents": agents,
        "density": density,
        "fast": fast,
        "strategy": strategy,
        "neighbors": neighbors,
        "target-speed": target_speed,
        "steps": steps,
        "seed": seed,
    }
    if fleet is not None:
        asked = [source, against, out, target_track, track_id, assignments, *changes.values()]
        if any(each is not None for each in asked) or speed != 1.0:
            problem, fix = (
                "is of buoys that decide by themselves, and is watched as it is",
                "leave out what would change it",
            )
            raise ScenarioError("--fleet", problem, fix)
        _watch_fleet(fleet, host, port, browser)
        return
    if replay_changes is not None:
        asked = [source, against, target_track, track_id, assignments, *changes.values()]
        if any(each is not None for each in asked):
            problem, fix = "says what is run, and how it changes", "leave out what would change it"
            raise ScenarioError("--replay-changes", problem, fix)
        _watch_again(replay_changes, speed, host, port, browser, out)
        return
    source = source or "oceans2020"
    if Path(source).is_dir():
        asked = [against, out, target_track, track_id, assignments, *changes.values()]
        if any(each is not None for each in asked):
            raise ScenarioError(source, "is a record, which plays as it is", "watch its scenario to change something")
        _play_record(source, host, port, browser)
        return
    tables = [edited_table(source, changes, assignments or [], target_track, track_id)]
    if against:
        if out:
            raise ScenarioError("--out", "keeps one run, and --against shows two", "leave out one of them")
        tables.append(_other(tables[0], against))
    _watch(tables, [source, against or ""], speed, host, port, browser, out)


def _watch_again(file: Path, speed: float, host: str, port: int, browser: bool, out: Path | None) -> None:
    from shoal.core.errors import ScenarioError
    from shoal.run.change_log import read_log
    from shoal.run.replay_changes import planned

    log = read_log(file)
    tables = [log.settings(run).table for run in range(len(log.runs))]  # refused now, as what --out cannot hold
    if out and len(tables) > 1:
        raise ScenarioError("--out", "keeps one run, and the log is of two", "leave out one of them")
    if out:
        planned(log)
    if log.note:
        note(log.note)
    _watch(tables, [each.name for each in log.runs], speed, host, port, browser, out, script=log)


def _watch_fleet(address: str, host: str, port: int, browser: bool) -> None:
    from threading import Event

    from shoal.buoy.address import host_and_port
    from shoal.buoy.beacon import Lookout
    from shoal.core.waiting import wait_for
    from shoal.viewer.bulletin import bulletins
    from shoal.viewer.outlook import Outlook

    lookout, outlook = Lookout(*host_and_port(address, "--fleet")), Outlook()
    with suppress(KeyboardInterrupt), closing(lookout), serving_outlook(outlook, host=host, port=port, browser=browser):
        for bulletin in bulletins(lookout, 0.5):
            if bulletin:
                outlook.hear(bulletin)
        outlook.end("the fleet is gone")
        note("the fleet is gone; the page stays until Ctrl-C")
        wait_for(Event())


def _watch(
    tables: list[dict[str, Any]],
    names: list[str],
    speed: float,
    host: str,
    port: int,
    browser: bool,
    out: Path | None,
    script: "ChangeLog | None" = None,
) -> None:
    from shoal.record.files import RecordFolder
    from shoal.scenario.load import scenario_from
    from shoal.viewer.server import live_app, serving
    from shoal.viewer.session import Session
    from shoal.viewer.worker import Worker

    scenarios = [scenario_from(table, where=name) for table, name in zip(tables, names, strict=False)]
    for scenario in {each.strategy.name: each for each in scenarios}.values():
        tell_of_compiling(scenario)
    if out:
        with RecordFolder(out):  # refused now, not after the run
            pass
    last = script.last if script else scenarios[0].steps
    session = Session(tables, names=names, speed=speed, limit=last if out else None, script=script)
    for run in session.runs:
        for each in run.simulation.notes:
            note(each)
    saved: list[Path] = []

    def save() -> None:
        if out and session.number and not saved:
            _record(session, out)
            saved.append(out)

    with (
        suppress(KeyboardInterrupt),
        Worker(session, on_done=save) as worker,
        serving(live_app(worker), host, port) as address,
    ):
        _announce(address, host, browser)
        worker.wait()
    save()


def _record(session: "Session", out: Path) -> None:
    """Save what was watched: the same steps and changes of the same scenario and seed again: the same bits."""
    from shoal.run.replay_changes import replay_changes
    from shoal.run.simulate import simulate
    from shoal.scenario.schema import Scenario

    planned, steps = session.runs[0].simulation.scenario, session.number
    with progress_bar(f"recording {steps:,} steps") as progress:
        if session.steersman.changes:
            replay_changes(session.steersman.log, out=out, progress=progress)
        else:
            simulate(Scenario.model_validate({**dict(planned), "steps": steps}), out=out, progress=progress)
    note(f"record: {out}, {steps:,} of {planned.steps:,} steps (shoal show {out})")


def _play_record(folder: str, host: str, port: int, browser: bool) -> None:
    from threading import Event

    from shoal.core.waiting import wait_for
    from shoal.viewer.replay import replay_page
    from shoal.viewer.server import page_app, serving

    page = replay_page(opened(folder))
    with suppress(KeyboardInterrupt), serving(page_app(page), host, port) as address:
        _announce(address, host, browser)
        wait_for(Event())


def _other(table: dict[str, Any], against: str) -> dict[str, Any]:
    """The second run: the first with a change, or another scenario with the first one's seed."""
    from shoal.scenario.edit import apply, parse_assignment
    from shoal.scenario.load import read_table

    if "=" in against and not Path(against).exists():
        return apply(table, dict([parse_assignment(against)]))
    return {**read_table(against), "seed": table.get("seed", 1)}


def _announce(address: str, host: str, browser: bool) -> None:
    from shoal.viewer.address import is_local

    note(f"watch at {address} (Ctrl-C ends)")
    if not is_local(host):
        note(f"anybody who can reach {host} can watch and control this run")
    if browser:
        webbrowser.open(address)
