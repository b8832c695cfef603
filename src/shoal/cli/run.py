"""shoal run: one scenario, R runs, a table of results."""

from pathlib import Path
from typing import Annotated, Any, Literal

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger, MaybeSteps
from shoal.cli.options import check_most, edited_table
from shoal.cli.places import check_places
from shoal.cli.progress import note, progress_bar
from shoal.cli.startup import load_compiler, tell_of_compiling
from shoal.cli.steered import SUFFIX, make_again, refuse_changes
from shoal.cli.told import tell


def run(
    scenario: str,
    /,
    *,
    neighbors: Annotated[str | None, Parameter(name=["--neighbors", "-k"])] = None,
    fast: MaybeInteger = None,
    agents: MaybeInteger = None,
    density: Literal["keep"] | None = None,
    target_speed: str | None = None,
    steps: MaybeSteps = None,
    seed: MaybeInteger = None,
    runs: Integer = 1,
    jobs: MaybeInteger = None,
    device: Literal["cpu", "cuda"] = "cpu",
    strategy: str | None = None,
    target_track: str | None = None,
    track_id: str | None = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
    every: MaybeInteger = None,
    out: Path | None = None,
    figure: Path | None = None,
    width: Literal["single", "double"] = "double",
    all_: Annotated[bool, Parameter(name="--all", negative=())] = False,
    json_: Annotated[bool, Parameter(name="--json", negative=())] = False,
) -> None:
    """Run a scenario and print time on target, velocity fluctuation and heading-bearing correlation.

    Parameters
    ----------
    scenario
        A preset's name (see `shoal presets`), a TOML file, or a log of changes (.jsonl) that `shoal watch` saved.
    neighbors
        k: every agent hears its k nearest others; or all.
    fast
        Number of agents of the fastest fleet; the slowest fleet gives or takes the difference.
    agents
        Number of agents in all, in the scenario's shares of fleets.
    density
        keep: with --agents, the sides of the arena grow with the root of their number.
    target_speed
        Speed of the waypoint targets: m/s, or with a unit, such as "6 kn".
    steps
        Time-steps of a run, or its duration, such as "2 h".
    seed
        Seed of all chance; run r of two scenarios with one seed shares its target path and its starts.
    runs
        Independent replicates; with 2 or more, intervals are over them.
    jobs
        Threads, one run each; default one per core.
    device
        Where runs happen: the processor's cores (cpu), or a graphics card (cuda), all at once; see docs/how-to/gpu.md.
    strategy
        A strategy's name (see `shoal strategies`) or a Python file that defines one.
    target_track
        Recorded track to follow instead (CSV, NMEA, GPX, KML, GeoJSON, NetCDF): arena and lengths are fitted around it.
    track_id
        Which track of the file, as COLUMN=VALUE, such as mmsi=235069877; all joins all.
    assignments
        Any field by its path, such as strategy.delta=0.02 or fleets.BoB-1.start=corner; may be repeated.
    every
        With --out, keep every n-th step of every run; default an overview of the first run and its last steps.
    out
        Save the record to this new folder.
    figure
        Draw the result to this file (.png, .svg or .pdf).
    width
        Of the figure: one column of a journal (single, 3.5 in) or two (double, 7.16 in).
    all_
        Show all metrics, not only the eight that matter most: those of each fleet, target and change of the swarm, too.
    json_
        Print one JSON object and nothing else.
    """
    load_compiler()
    from shoal.run.simulate import simulate
    from shoal.scenario.load import read_table, scenario_from

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
    check_most(runs=runs, jobs=jobs)
    check_places(out, figure)
    if scenario.endswith(SUFFIX):
        asked_of_log = [*changes.values(), target_track, track_id, assignments]
        refuse_changes(scenario, asked_of_log, runs=runs, device=device)
        tell(make_again(scenario, every, out), out, figure, json_, width=width, everything=all_)
        return
    table = edited_table(scenario, changes, assignments or [], target_track, track_id)
    chosen = scenario_from(table, where=scenario)
    asked = read_table(scenario).get("network", {}).get("neighbors")
    if agents and neighbors is None and isinstance(asked, int) and asked >= chosen.agents:
        note(f"k is {chosen.network.neighbors} instead of {asked}: {chosen.agents} agents have no more neighbors")
    tell_of_compiling(chosen)
    with progress_bar(f"{chosen.name}, {runs} x {chosen.steps:,} steps") as progress:
        record = simulate(chosen, runs=runs, jobs=jobs, device=device, every=every, out=out, progress=progress)
    tell(record, out, figure, json_, width=width, everything=all_)
