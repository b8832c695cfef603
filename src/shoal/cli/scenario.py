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

    if scale_to is not None:
        write(to_toml(load(preset).scaled(to=parse_value(scale_to))))
    else:
        write(preset_text(preset) or to_toml(load(preset)))


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
