"""What a design found, as a table, a figure and a page."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from shoal.core.sheet import MOST_ROWS, Sheet
from shoal.core.version import RESULTS_VERSION
from shoal.experiments.fleet_front import Alternative, FleetFront
from shoal.experiments.front import Spread
from shoal.record.tables import data_frame
from shoal.study.design_words import fleet_text, names_of, sentences, shortened, spread, standing
from shoal.study.searching import shown

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure

    from shoal.drawing.style import Width


@dataclass(frozen=True, repr=False)
class Designed:
    """What a design found. A notebook shows the front; `plot` draws it, `report` is a page for who buys.

    Attributes
    ----------
    scenario : what was designed
    result : alternatives, trials, hypervolumes, exchange rates
    """

    scenario: str
    result: FleetFront

    @property
    def front(self) -> list[Alternative]:
        """Fleets that no other beats, cheapest first, on fresh seeds."""
        return self.result.front

    @property
    def alternatives(self) -> tuple[Alternative, ...]:
        """All fleets that were run again, cheapest first."""
        return self.result.alternatives

    def to_pandas(self) -> "pandas.DataFrame":
        """Return a row per fleet that was run again: counts, fields, both metrics with ends, standing (extra: sweep).

        Raises
        ------
        MissingExtraError : pandas is not installed
        """
        return data_frame(self.rows(), "a design as a DataFrame")

    def rows(self) -> list[dict[str, Any]]:
        """What `to_pandas` makes a table of."""
        search = self.result.search
        names = [each.name for each in search.scenario.fleets]
        return [
            {
                **dict(zip(names, each.counts, strict=True)),
                **self._others(each),
                **_ends(search.less.metric, each.less), **_ends(search.more.metric, each.more),
                "searched": _finite(each.searched), "on_front": each.on_front, "present": each.present,
                "beaten_by": each.beaten_by,
            }
            for each in self.alternatives
        ]  # fmt: skip

    def to_dict(self) -> dict[str, Any]:
        """Return all of it as `shoal design --json` prints it."""
        result, search = self.result, self.result.search
        names = [each.name for each in search.scenario.fleets]
        return {
            "scenario": self.scenario, "minimize": search.less.metric, "maximize": search.more.metric,
            "trials": search.trials, "runs": search.runs, "final_runs": search.final_runs,
            "steps": search.scenario.steps, "seed": search.scenario.seed, "all_steps": result.steps,
            "results_version": RESULTS_VERSION,
            "hypervolume": {**result.hypervolumes, "reference": list(result.reference)},
            "exchange_rates": [
                {"one": names[each.fleet], "of": names[result.base], "worth": each.worth, "ci95": [each.low, each.high]}
                for each in result.rates
            ],
            "fleets": self.rows(),
            "failed": [each.reason for several in result.tried.values() for each in several if each.reason],
        }  # fmt: skip

    def plot(self, width: "Width" = "double") -> "Figure":
        """Draw the front: cost against metric, with intervals (extra: plots).

        Parameters
        ----------
        width : of one column of a journal (single), or of two (double)
        """
        from shoal.drawing.front import Place, front_figure

        search = self.result.search
        places = [
            Place(each.less.mean, each.more.mean, _finite(each.more.low), _finite(each.more.high),
                  fleet_text(each.counts), standing(each), each.present)
            for each in self.alternatives
        ]  # fmt: skip
        tried = [each.means for several in self.result.tried.values() for each in several if each.known]
        labels = search.less.words, search.more.words
        return front_figure(places, tried, labels, " + ".join(names_of(self.result)), width)

    def report(self, file: str | Path) -> None:
        """Write one self-contained HTML page for whoever buys; one of Shoal's of this name is replaced (extra: plots).

        Parameters
        ----------
        file : where, NAME.html

        Raises
        ------
        RecordError : it cannot be written
        MissingExtraError : matplotlib is not installed
        """
        from shoal.study.design_page import write_page

        write_page(self.scenario, self.result, self.plot(), file)

    def __repr__(self) -> str:
        """The table of the front, and what it says."""
        return "\n".join([self._sheet().text(), *sentences(self.result)])

    def _repr_html_(self) -> str:
        """The table for a notebook."""
        return self._sheet(" ".join(sentences(self.result))).html()

    def _sheet(self, note: str = "") -> Sheet:
        result, search = self.result, self.result.search
        kept = shortened(result, MOST_ROWS - 1)
        left = len(result.front) - sum(each.on_front for each in kept)
        return Sheet(
            head=f"{self.scenario}: {search.trials} trials and as many at random, of {search.runs} runs of "
            f"{search.scenario.steps:,} steps; below, {search.final_runs} runs each on fresh seeds",
            titles=(search.less.words, *names_of(result), *(each.field for each in search.variables),
                    search.more.words, ""),
            rows=[
                (
                    spread(each.less, exact=True), *map(str, each.counts),
                    *(shown(value) for value in self._others(each).values()),
                    spread(each.more), "present" if each.present and each.on_front else
                    "present, dominated for sure" if each.present and each.beaten_by is not None else
                    "present, behind the front" if each.present else "",
                )
                for each in kept
            ],
            note=" ".join([f"({left} more of the front lie between these)"] * (left > 0) + [note] * bool(note)),
            words=("",),
        )  # fmt: skip

    def _others(self, each: Alternative) -> dict[str, Any]:
        search = self.result.search
        values = {**search.start, **each.point}
        return {variable.field: values[variable.field] for variable in search.variables}


def _ends(metric: str, value: Spread) -> dict[str, float | None]:
    return {
        metric: _finite(value.mean), f"{metric}_low": _finite(value.low), f"{metric}_high": _finite(value.high)
    }  # fmt: skip


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None
