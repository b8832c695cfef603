"""shoal replay: a record, or a run of a scenario, as one HTML file."""

from pathlib import Path
from typing import Literal

from shoal.cli.numbers import Integer
from shoal.cli.older import opened
from shoal.cli.progress import note, progress_bar
from shoal.cli.startup import load_compiler


def replay(
    source: str,
    /,
    *,
    out: Path,
    frames: Integer = 2000,
    part: Literal["all", "end"] = "all",
) -> None:
    """Write a page that plays a record in any browser, by itself: no server, no network.

    Parameters
    ----------
    source
        A record (folder made by --out); or a preset's name or a TOML file, which is run first.
    out
        The HTML file to write; a page of this name that Shoal made is replaced.
    frames
        Frames in the page, at most; fewer where agents are so many that a page would be larger than 64 MB.
    part
        all: spread evenly over the whole run; end: the last steps, every one of them as far as they were kept.
    """
    from shoal.core.errors import ScenarioError
    from shoal.core.files import check_file, write_atomic
    from shoal.core.links import link_bytes
    from shoal.viewer.replay import most_frames, replay_page

    if frames < 1:
        raise ScenarioError("--frames", f"is {frames}", "ask for 1 or more")
    check_file(out, ours=True)
    if Path(source).is_dir():
        record = opened(source)
    else:
        load_compiler()
        from shoal.run.simulate import simulate
        from shoal.scenario.load import load

        scenario = load(source)
        frames = min(frames, most_frames(scenario.agents, len(scenario.targets), link_bytes(scenario.agents)))
        every = max(1, -(-scenario.steps // frames)) if part == "all" else None
        with progress_bar(f"{scenario.name}, {scenario.steps:,} steps") as progress:
            record = simulate(scenario, every=every, progress=progress)
    write_atomic(out, replay_page(record, frames=frames, part=part).encode(), ours=True)
    note(f"page: {out} ({out.stat().st_size / 1e6:.1f} MB)")
