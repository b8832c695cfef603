"""shoal scenario, check, schema: write, check and describe scenario files."""

import json
from typing import Annotated

from cyclopts import Parameter

from shoal.cli.output import write
from shoal.cli.progress import note
from shoal.cli.startup import load_compiler, tell_of_compiling


def scenario(preset: str, /, *, scale_to: str | None = None) -> None:
    """Print the TOML of a preset, to start a scenario of your own from.

    Parameters
    ----------
    preset
        A preset's name (see `shoal presets`), or a TOML file, which is printed with all defaults filled in.
    scale_to
        Make the longer side this long, such as "3 km", and multiply all lengths and times alike; speeds stay.
    """
    from shoal.scenario.edit import parse_value
    from shoal.scenario.load import load, preset_text, to_toml
    from shoal.scenario.text import rewritten

    text, chosen = preset_text(preset), load(preset)
    if scale_to is not None:
        size = max(chosen.area.width, chosen.area.height)
        chosen = chosen.scaled(to=parse_value(scale_to))
        text = text and rewritten(text, chosen)
        times = max(chosen.area.width, chosen.area.height) / size
        text = text and f"{_SCALED.format(preset=preset, times=times)}{text}"
    write(text or to_toml(chosen))


_SCALED = """\
# Preset {preset} with all lengths and times {times:g} times as large; where a comment names a size, it is the preset's.

"""


def check(file: str, /, *, quick: Annotated[bool, Parameter(negative=())] = False) -> None:
    """Check that a scenario can run, its strategy and its tracks included, and say what looks like a mistake.

    Parameters
    ----------
    file
        A TOML file or a preset's name.
    quick
        Make no trial runs, which take some seconds: are agents at the walls, is the time-step short enough.
    """
    from shoal.scenario.load import load
    from shoal.study.check import check as notes_of

    loaded = load(file)
    if not quick:
        load_compiler()
        tell_of_compiling(loaded)
    for each in notes_of(loaded, trials=not quick):
        note(each)
    write(
        f"{file}: fine ({loaded.agents} agents, k = {loaded.network.neighbors}, {loaded.steps:,} steps, "
        f"scenario {loaded.hash})\n"
    )


def schema() -> None:
    """Print the JSON Schema of scenario files, for editors."""
    from shoal.scenario.schema import json_schema

    write(json.dumps(json_schema(), indent=1) + "\n")
