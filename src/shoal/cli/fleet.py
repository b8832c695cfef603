"""shoal fleet: the buoys themselves, in a stand-in for the sea."""

from contextlib import suppress
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from shoal.cli.numbers import MaybeInteger, MaybeNumber, MaybeSteps
from shoal.cli.options import edited_table
from shoal.cli.places import check_places
from shoal.cli.progress import note, progress_bar
from shoal.cli.showing import NOWHERE, showing
from shoal.cli.startup import load_compiler, tell_of_compiling
from shoal.core.waiting import wait_for

if TYPE_CHECKING:
    from shoal.record.record import Record


def fleet(
    scenario: str,
    /,
    *,
    neighbors: Annotated[str | None, Parameter(name=["--neighbors", "-k"])] = None,
    fast: MaybeInteger = None,
    agents: MaybeInteger = None,
    density: Literal["keep"] | None = None,
    target_speed: str | None = None,
    steps: Annotated[MaybeSteps, Parameter(name=["--steps", "--for"])] = None,
    seed: MaybeInteger = None,
    strategy: str | None = None,
    target_track: str | None = None,
    track_id: str | None = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    processes: MaybeInteger = None,
    lockstep: Annotated[bool, Parameter(negative=())] = False,
    speed: MaybeNumber = None,
    kill: Annotated[list[str] | None, Parameter(negative=(), consume_multiple=False)] = None,
    mesh: str = "zenoh",
    max_age: MaybeInteger = None,
    plain: Annotated[bool, Parameter(negative=())] = False,
    watch: Annotated[bool, Parameter(negative=())] = False,
    browser: bool = True,
    listen: str | None = None,
    command_key: Path | None = None,
    mesh_config: Path | None = None,
    out: Path | None = None,
    figure: Path | None = None,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Run the buoys of a scenario as processes that decide by themselves and talk over a mesh. Ctrl-C ends it.

    A stand-in for the sea moves them, by the clock; what was done until the end, or until Ctrl-C, is the result.

    Parameters
    ----------
    scenario
        A preset's name (see `shoal presets`) or a TOML file.
    neighbors
        k: every buoy hears its k nearest others; or all.
    fast
        Number of buoys of the fastest fleet; the slowest fleet gives or takes the difference.
    agents
        Number of buoys in all, in the scenario's shares of fleets.
    density
        keep: with --agents, the sides of the arena grow with the root of their number.
    target_speed
        Speed of the waypoint targets: m/s, or with a unit, such as "6 kn".
    steps
        Time-steps of the run, or its duration, such as "1 min"; default the scenario's.
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
    processes
        Processes that the buoys run in; default one per core.
    lockstep
        Let a step take as long as all buoys need, instead of its time: the simulator's run, to the bit.
    speed
        Times real time; with --lockstep at most, default as fast as it goes.
    kill
        Kill the process of a buoy when a step begins, BUOY@STEP, with all buoys in it; may be repeated.
    mesh
        zenoh, between processes; or memory, all in this process and in lockstep.
    max_age
        network.max_age: steps that a report may be old to be gone by; by the clock 1 at least unless this is said.
    plain
        Let buoys decide without a compiler: they start at once, with a third of the memory.
    watch
        Show the buoys in the browser as they run; the page stays until Ctrl-C.
    browser
        Open that page in the browser.
    listen
        Where `shoal watch --fleet` and `shoal chart --fleet` find it, HOST:PORT, or none; port 0 is a free one. Default
        127.0.0.1:0, which can be reached from this machine only; with --mesh memory none.
    command_key
        Obey orders of `shoal command` that are sealed with the key in this file, which is made if it is not there.
    mesh_config
        File of zenoh's own configuration (JSON5), such as certificates.
    out
        Save the record, of every step, to this new folder.
    figure
        Draw the result to this file (.png, .svg or .pdf).
    json_
        Print one JSON object and nothing else.
    """
    if watch:
        from shoal.viewer.server import require_libraries

        require_libraries()
    load_compiler()
    from shoal.buoy.trust import Trust
    from shoal.run.compiling import BUOYS
    from shoal.run.fleet.run_fleet import Terms, check_terms, run_fleet
    from shoal.scenario.load import scenario_from

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
    check_places(out, figure)
    chosen = scenario_from(edited_table(scenario, changes, assignments or [], target_track, track_id), where=scenario)
    terms = Terms(processes, lockstep, speed, tuple(kill or ()), mesh, max_age, plain, Trust(command_key, mesh_config))
    for each in check_terms(chosen, terms):
        note(each)
    paced = None if terms.in_lockstep else terms.speed or 1.0
    where = listen or (NOWHERE if mesh == "memory" else "127.0.0.1:0")
    with showing(chosen, paced, page=watch, browser=browser, listen=where) as show:
        tell_of_compiling(chosen, BUOYS)
        note(f"{chosen.agents} buoys start (Ctrl-C ends the run, and keeps what was done)")
        with progress_bar(f"{chosen.name}, {chosen.agents} buoys, {chosen.steps:,} steps") as progress:
            record = run_fleet(
                chosen,
                terms,
                out=out,
                progress=progress,
                onlooker=show.feed.see if show else None,
                tell=lambda place: note(f"orders: shoal command {place} hold --key {command_key}"),
            )
        if show:
            show.end()
        _tell(record, out, figure, json_)
        if watch and record.scenario.steps == chosen.steps:
            note("the page stays until Ctrl-C")
            with suppress(KeyboardInterrupt):
                wait_for(Event())


def _tell(record: "Record", out: Path | None, figure: Path | None, json_: bool) -> None:
    """Tell the result."""
    for each in record.provenance["notes"]:
        note(each)
    if out:
        note(f"record: {out} (shoal show {out})")
    if json_:
        from shoal.cli.summary import print_json

        print_json(record)
    else:
        from shoal.cli.table import print_record

        print_record(record)
    if figure:
        from shoal.study.plot import save, summary

        save(summary(record), figure)
        note(f"figure: {figure}")
