"""shoal film: a record or a scenario as a film, or as a still."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from shoal.cli.numbers import Integer, MaybeInteger, MaybeNumber
from shoal.cli.older import opened
from shoal.cli.options import edited_table
from shoal.cli.progress import note, progress_bar
from shoal.cli.startup import load_compiler, tell_of_compiling
from shoal.core.errors import ScenarioError
from shoal.core.text import cut

if TYPE_CHECKING:
    from shoal.drawing.film import FilmLook
    from shoal.record.record import Record

_STEPS = 600  # of a scenario, if nobody says otherwise
_ROOM = 1_000_000_000  # [bytes] of its frames, if nobody says otherwise

_No = Parameter(negative=())


def film(
    source: str,
    /,
    *,
    out: Path,
    start: MaybeInteger = None,
    steps: MaybeInteger = None,
    every: MaybeInteger = None,
    step: MaybeInteger = None,
    seconds: MaybeNumber = None,
    fps: MaybeNumber = None,
    size: str | None = None,
    run: Integer = 0,
    links: Annotated[bool, _No] = False,
    trails: bool = True,
    halos: Annotated[bool, _No] = False,
    sensors: Annotated[bool, _No] = False,
    panels: Annotated[bool, _No] = False,
    seed: MaybeInteger = None,
    assignments: Annotated[list[str] | None, Parameter(name="--set", negative=(), consume_multiple=False)] = None,
) -> None:
    """Make a film (.mp4, .gif) or a still (.png) of a record, or of a scenario, which is run for it.

    Parameters
    ----------
    source
        Folder made by `shoal run --out`, a preset's name or a TOML file.
    out
        File to write; its suffix says what: .mp4, .gif, or .png for a still of the last step shown.
    start
        First step shown. Default: of a scenario 0; of a record the last stretch that was kept evenly.
    steps
        Steps shown, from --start, or the last ones of a record. Default: of a scenario 600; of a record all.
    every
        Show every n-th step; default 1, or what the record kept.
    step
        With .png: the step to show.
    seconds
        Length of the film, instead of --steps.
    fps
        Frames per second; default 30, of a gif 20.
    size
        WIDTHxHEIGHT in pixels, or WIDTH alone: the arena then decides the height. Default 720, of a gif 480; half as
        much again with --panels.
    run
        Number of the run shown.
    links
        Draw a line between buoys of which one really hears the other.
    trails
        Draw where buoys and targets were.
    halos
        Draw a disc of radius a_R, the repulsion, around each buoy.
    sensors
        Draw how far each buoy senses.
    panels
        Draw charts beside the arena: headings, how many are on target.
    seed
        Of a scenario: seed of all chance.
    assignments
        Of a scenario: any field by its path, such as network.neighbors=10; may be repeated.
    """
    load_compiler()
    from shoal.drawing.arena_drawing import Parts
    from shoal.drawing.film import FilmLook, check_film, default_fps, write_film

    width, height = _size(size)
    look = FilmLook(fps, width, height, Parts(links, trails, halos, sensors), panels)
    kind = check_film(out, look)
    _check_numbers(start=start, steps=steps, every=every, step=step, seconds=seconds, run=run)
    if step is not None:
        if kind != "png" or (start, steps, every, seconds) != (None,) * 4:
            raise ScenarioError("--step", "shows one step", "name a .png, and leave --start, --steps and the like out")
        start, steps = step, 1
    if seconds is not None:
        if steps is not None or kind == "png":
            raise ScenarioError("--seconds", "is the length of a film", "give --seconds or --steps, and no .png")
        steps = max(1, round(seconds * (fps or default_fps(out)))) * (every or 1)
    if Path(source).is_dir():
        record = _opened(source, seed=seed, assignments=assignments)
    else:
        table = edited_table(source, {"seed": seed}, assignments or [], None, None)
        start, record = _filmed(source, table, start or 0, steps, every or 1, run, look)
        steps = None  # all that was run from `start` on
    with progress_bar(f"{out.name}", "frames") as progress:
        made = write_film(
            record, out, run=run, start=start, steps=steps, every=every, look=look, progress=progress
        )  # fmt: skip
    shown = f"{made.size[0]} x {made.size[1]} pixels"
    if kind == "png":
        note(f"still: {out}, step {made.last:,}, {shown}")
        return
    apart = f", every {made.every}" if made.every > 1 else ""
    faster = made.every * record.facts.time_step * made.fps
    note(
        f"film: {out}, steps {made.first:,} to {made.last:,}{apart}, {made.frames} frames in "
        f"{made.frames / made.fps:.1f} s ({faster:.3g} times real time), {shown}"
    )


def _opened(folder: str, **changes: Any) -> "Record":
    changed = [f"--{'set' if name == 'assignments' else name}" for name, value in changes.items() if value is not None]
    if changed:
        raise ScenarioError(changed[0], "changes a scenario, and a record is done", "film the scenario instead")
    return opened(folder)


def _filmed(
    source: str, table: dict[str, Any], start: int, steps: int | None, every: int, run: int, look: "FilmLook"
) -> tuple[int, "Record"]:
    """Run a scenario, a little before `start` for the trails; return the first step shown, and the record."""
    from shoal.core.links import MOST_LINKED
    from shoal.drawing.arena_drawing import trail_steps
    from shoal.drawing.dots import MARKED
    from shoal.drawing.footage import footage, footage_bytes
    from shoal.scenario.load import scenario_from

    scenario = scenario_from(table, where=source)
    if look.parts.links and scenario.agents > MOST_LINKED:
        problem = f"are kept of up to {MOST_LINKED} agents, and there are {scenario.agents:,}"
        raise ScenarioError("--links", problem, "leave them out")
    start = -(-start // every) * every
    lead = min(start, -(-trail_steps(scenario) // every) * every)
    lean = scenario.agents > MARKED and not (look.parts.halos or look.panels)
    if steps is None:
        steps = min(_STEPS, max(scenario.steps - start, 1))
        fit = every * (_ROOM // footage_bytes(scenario, lean)) - lead
        if fit < steps:
            steps = max(fit, every)
            note(f"{steps} steps of {scenario.agents:,} agents are filmed, in 1 GB of memory; --steps asks for more")
    tell_of_compiling(scenario)
    with progress_bar(f"{scenario.name}, {start + steps:,} steps") as progress:
        return start, footage(
            scenario, steps + lead, start=start - lead, every=every, run=run, lean=lean, progress=progress
        )


def _size(text: str | None) -> tuple[int | None, int | None]:
    """WIDTHxHEIGHT or WIDTH."""
    if text is None:
        return None, None
    numbers = re.fullmatch(r"([0-9]{1,5})(?:x([0-9]{1,5}))?", text.lower())
    if not numbers:
        raise ScenarioError(
            f"--size {cut(text)}", "is not a size", "write WIDTHxHEIGHT such as 1280x720, or WIDTH alone"
        )
    return int(numbers[1]), int(numbers[2]) if numbers[2] else None


def _check_numbers(**numbers: float | None) -> None:
    least = {"start": 0, "step": 0, "run": 0, "steps": 1, "every": 1}
    for name, number in numbers.items():
        if number is not None and not number >= least.get(name, 1e-9):
            raise ScenarioError(f"--{name}", f"is {number:g}", f"ask for {least.get(name, 'more than 0')} or more")
