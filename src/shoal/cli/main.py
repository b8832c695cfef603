"""The command line: one file per verb, imported when called, so that `shoal --help` is instant."""

import sys

from cyclopts import App, CycloptsError

from shoal.cli.output import CANNOT_PRINT, CannotPrintError, drop_stdout, guarded_stdout, silence_stderr, tell
from shoal.cli.signals import exit_code, heed_signals, interrupt_behind
from shoal.core.errors import ShoalError
from shoal.core.text import readable
from shoal.core.version import VERSION

BAD_INPUT = 2

app = App(
    name="shoal",
    version=VERSION,
    help="Simulate and compare swarms of buoys that search for and track moving targets at sea. The presets are in an "
    "arena of 20 m x 20 m; `shoal scenario oceans2020` prints one, every field explained.",
    help_format="plaintext",
    suppress_keyboard_interrupt=False,  # run_command says what an interrupt left behind
)
app.command("shoal.cli.run:run", name="run", help="Run a scenario and print its metrics.")
app.command("shoal.cli.fleet:fleet", name="fleet", help="Run the buoys themselves, in a stand-in for the sea.")
app.command("shoal.cli.buoy:buoy", name="buoy", help="Run one buoy of a fleet: what runs on a vehicle.")
app.command("shoal.cli.command:command", name="command", help="Give buoys of a fleet an order, and say who obeys.")
app.command("shoal.cli.show:show", name="show", help="Print the table of a saved record, and draw its figure.")
app.command("shoal.cli.film:film", name="film", help="Make a film or a still of a record or a scenario.")
app.command("shoal.cli.watch:watch", name="watch", help="Watch a run in the browser, and change it as it goes.")
app.command("shoal.cli.replay:replay", name="replay", help="Write a page that plays a record by itself.")
app.command("shoal.cli.export:export", name="export", help="Write the tracks of a record for maps and plotters.")
app.command("shoal.cli.chart:chart", name="chart", help="Show a run on chart plotters as it goes, by AIS.")
app.command("shoal.cli.sweep:sweep", name="sweep", help="Run every combination of varied fields, several times each.")
app.command("shoal.cli.tune:tune", name="tune", help="Look for the best values of some fields of a scenario.")
app.command("shoal.cli.design:design", name="design", help="Look for the fleets that are worth their cost.")
app.command("shoal.cli.compare.command:compare", name="compare", help="Compare strategies, with the same seeds.")
app.command("shoal.cli.learn:learn", name="learn", help="Learn the weights of a strategy, by evolution.")
app.command("shoal.cli.reproduce:reproduce", name="reproduce", help="Reproduce a paper: its figures, its claims.")
app.command("shoal.cli.results:results", name="results", help="Print means and 95 % intervals of a sweep.")
app.command("shoal.cli.results:plot", name="plot", help="Draw a metric of a sweep against a field.")
app.command("shoal.cli.listing:presets", name="presets", help="List the scenarios that come with Shoal.")
app.command("shoal.cli.listing:strategies", name="strategies", help="List the strategies that there are.")
app.command("shoal.cli.listing:metrics", name="metrics", help="List what is measured: names, units, meanings.")
app.command("shoal.cli.new_strategy:new_strategy", name="new-strategy", help="Write a strategy and its test, to edit.")
app.command("shoal.cli.scenario:scenario", name="scenario", help="Print the TOML of a preset, to start your own from.")
app.command("shoal.cli.scenario:check", name="check", help="Check that a scenario can run.")
app.command("shoal.cli.scenario:schema", name="schema", help="Print the JSON Schema of scenario files.")


def main() -> None:
    """Run the command line and exit; see shoal.__main__, which does it with an eye on Ctrl-C."""
    heed_signals()
    sys.exit(run_command(sys.argv[1:]))


def run_command(tokens: list[str]) -> int:
    """Run one command and return its exit code; every error of the user is one message on stderr."""
    if sys.stderr is None:
        silence_stderr()
    try:
        if any("\0" in token for token in tokens):
            raise ShoalError("command line", "holds a NUL", "leave it out")
        with guarded_stdout():
            return _code_of(tokens)
    except CycloptsError as error:
        tell(readable(f"{_one_line(error)}\n  fix: see `shoal{_verb(tokens)} --help`"))
        return BAD_INPUT
    except ShoalError as error:
        tell(str(error))
        return BAD_INPUT
    except KeyboardInterrupt as error:
        tell("interrupted; nothing was left half-written")
        return exit_code(error)
    except ModuleNotFoundError as error:
        if error.name != "numba":
            raise
        fix = "pip install numba; `shoal buoy` does without it by --plain"
        tell(str(ShoalError("numba", "is not installed, and compiles what Shoal runs", fix)))
        return BAD_INPUT
    except BrokenPipeError:  # the reader of our output left, as `| head` does
        drop_stdout()
    except CannotPrintError as error:
        drop_stdout()
        tell(f"the result cannot be printed: {error}\n  fix: send it where there is room, or to /dev/null")
        return CANNOT_PRINT
    except OSError as error:
        where = error.filename if isinstance(error.filename, str) else "the system"
        tell(str(ShoalError(where, error.strerror or str(error), "name a file or folder that you may use")))
        return BAD_INPUT
    except RecursionError:
        tell("an input is nested too deeply\n  fix: a scenario is four levels deep at most")
        return BAD_INPUT
    except MemoryError:
        tell("there is not enough memory\n  fix: ask for less: fewer agents, runs, frames or combinations")
        return BAD_INPUT
    return 0


def _code_of(tokens: list[str]) -> int:
    try:
        code = app(tokens, exit_on_error=False, print_error=False, result_action="return_value")
    except Exception as error:
        if interrupt := interrupt_behind(error):
            raise interrupt from None
        raise
    return code if type(code) is int else 0


def _verb(tokens: list[str]) -> str:
    return f" {tokens[0]}" if tokens and tokens[0].isidentifier() and len(tokens[0]) < 20 else ""


def _one_line(error: CycloptsError) -> str:
    return " ".join(str(error).split())
