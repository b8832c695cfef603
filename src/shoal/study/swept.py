"""Sweep a scenario from Python: every combination of varied fields, several runs each."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

from shoal.core.errors import UnknownNameError
from shoal.core.keywords import lists_keywords, split_keywords
from shoal.core.sheet import Sheet
from shoal.experiments.design import Design, grid, together
from shoal.experiments.on_card import executor_on
from shoal.experiments.results import aggregate, seal
from shoal.experiments.rows import Row
from shoal.experiments.sweep import Stop
from shoal.experiments.sweep import sweep as run_sweep
from shoal.record.names import label_of
from shoal.record.tables import data_frame
from shoal.record.words import told
from shoal.scenario.edit import check_words
from shoal.scenario.load import Source, load
from shoal.study.folder import positive, progress_of, store_folder
from shoal.study.plot import curves
from shoal.study.varied import Values, varied, written

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from shoal.drawing.style import Width

RUNS = 5
SHOWN = ("time_on_target", "xi", "engaged")


@dataclass(frozen=True, repr=False)
class Swept:
    """What a sweep found. A notebook shows means and intervals; `plot` draws them, `to_pandas` gives the numbers.

    Attributes
    ----------
    scenario : what was varied
    fields : names of the fields that vary
    rows : one per run: the fields, run, seed, status, every metric
    """

    scenario: str
    fields: list[str]
    rows: list[Row]

    @property
    def failures(self) -> list[str]:
        """The errors of runs that failed."""
        return [row["error"] for row in self.rows if row["status"] == "failed"]

    def to_pandas(self, what: Literal["runs", "means"] = "runs", by: Sequence[str] | None = None) -> "pandas.DataFrame":
        """Return a tidy table (extra: sweep).

        Parameters
        ----------
        what : runs - a row per run; means - a row per combination of fields: runs, and mean, low and high (95 %)
            of every metric
        by : of means: the fields that make the rows; default all that vary

        Raises
        ------
        UnknownNameError : another table
        ScenarioError : no such field
        MissingExtraError : pandas is not installed
        """
        tables: dict[str, Callable[[], list[Row]]] = {
            "runs": lambda: self.rows,
            "means": lambda: aggregate(self.rows, self.fields if by is None else by),
        }
        if what not in tables:
            raise UnknownNameError.of("table", what, tables)
        return data_frame(tables[what](), "a sweep as a DataFrame")

    def plot(
        self,
        x: str | None = None,
        y: str = "time_on_target",
        hue: str | None = None,
        axes: "Axes | None" = None,
        width: "Width" = "single",
    ) -> "Figure":
        """Draw a metric against a field with bands of the 95 % interval, as shoal.plot.curves (extra: plots)."""
        return curves(self.rows, x=x, y=y, hue=hue, axes=axes, width=width)

    def __repr__(self) -> str:
        """The table."""
        return self._sheet().text()

    def _repr_html_(self) -> str:
        """The table for a notebook."""
        return self._sheet().html()

    def _sheet(self) -> Sheet:
        groups = aggregate(self.rows, self.fields, SHOWN)
        combinations = len({(row["scenario_hash"], row["seed"]) for row in self.rows})
        failed = [error.splitlines()[0] for error in self.failures]
        return Sheet(
            head=f"{self.scenario}: {combinations} combinations, {len(self.rows)} runs",
            titles=(*self.fields, "runs", *map(label_of, SHOWN)),
            rows=[
                (
                    *(str(group[name]) for name in self.fields),
                    str(group["runs"]),
                    *(_mean(group, name) for name in SHOWN),
                )
                for group in groups
            ],
            note=f"{len(failed)} runs failed, the first: {failed[0]}" if failed else "means [95 % intervals over runs]",
        )


class SweepOptions(NamedTuple):
    """How `sweep` runs, see there; its other words change the scenario."""

    runs: int = RUNS
    mode: Literal["grid", "zip"] = "grid"
    until_ci: float | None = None
    max_runs: int = 50
    independent: bool = False
    jobs: int | None = None
    device: str = "cpu"
    out: str | Path | None = None
    progress: Callable[[int, int], None] | None = None


@lists_keywords(SweepOptions)
def sweep(scenario: Source, vary: Mapping[str, Values], **changes: Any) -> Swept:
    """Run every combination of varied fields, several times each, and return the runs.

    >>> shoal.sweep("oceans2020", {"neighbors": range(10, 50, 10), "target_speed": [3, 5]}, runs=5, steps=5000)

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    vary : {field: values}, in the words of the command line: a list, a range, an array, or text such as "10:49:3"
    runs : replicates of each combination; run r shares its chance in all of them
    mode : grid - every combination; zip - the first values of all fields, then the second, and so on
    until_ci : add replicates to each combination until the 95 % interval of its time on target is narrower than this
    max_runs : most replicates of each combination then
    independent : give every combination a seed of its own
    jobs : threads, one run each; default one per core
    device : cpu, or cuda: on a graphics card, thousands at once, for what docs/how-to/gpu.md lists
    out : keep all runs in this folder; the same call again resumes, and adds what is new
    progress : called as progress(runs done, runs in all) after every run
    changes : to the scenario, for all combinations, as in `Scenario.with_`

    Raises
    ------
    ScenarioError, StrategyError : a combination that cannot run; nothing was run then
    RecordError : `out` is another study's, is in use, or cannot be written
    """
    options, changes = split_keywords(SweepOptions, changes)
    modes = {"grid": grid, "zip": together}
    if options.mode not in modes:
        raise UnknownNameError.of("mode", options.mode, modes)
    positive(runs=options.runs, jobs=options.jobs, max_runs=options.max_runs)
    check_words(changes, also=("vary", *SweepOptions._fields))
    design = Design(scenario, tuple(modes[options.mode](varied(vary))), options.runs)
    name = str(scenario) if isinstance(scenario, (str, Path)) else load(scenario).name
    with store_folder(options.out) as folder:
        rows = run_sweep(
            design,
            folder,
            changes={name: written(value) for name, value in changes.items()},
            executor=executor_on(options.device, options.jobs),
            until=Stop(options.until_ci, options.max_runs) if options.until_ci else None,
            independent=options.independent,
            report=progress_of(options.progress),
        )
        if options.out is not None:
            seal(folder, rows)
    return Swept(name, design.fields, rows)


def _mean(group: Row, name: str) -> str:
    return told(group[name], group[f"{name}_low"], group[f"{name}_high"])
