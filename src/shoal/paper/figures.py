"""All figures of a reproduction, in the order of the paper."""

from collections.abc import Iterable

from shoal.paper.figures_curves import k_figure, share_figure
from shoal.paper.figures_histograms import phi_figure
from shoal.paper.figures_published import published_figure
from shoal.paper.figures_sensitivity import sensitivity_figure
from shoal.paper.figures_series import TIME_ON_TARGET, XI, XI_RAW
from shoal.paper.figures_snapshots import clustering_figure, locked_figure
from shoal.paper.results import Figure, Reproduction
from shoal.paper.snapshots import STEPS, watch


def make_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the figures of the OCEANS 2020 paper, drawn from our runs; what was not run is left out.

    The two snapshots come from a run made here: the preset, its seed, up to 20,000 steps (a second).

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    rows = reproduction.main
    seen = watch(steps=min(STEPS, reproduction.steps))
    return _drawn(
        [
            locked_figure(seen),
            phi_figure(rows),
            share_figure(rows, "tot_share", "Time on target against the share of fast buoys", [TIME_ON_TARGET]),
            k_figure(rows, "tot_k", "Time on target against connectivity", TIME_ON_TARGET, "k* ="),
            clustering_figure(seen),
            share_figure(rows, "xi_share", "Velocity fluctuation against the share of fast buoys", [XI, XI_RAW]),
            k_figure(rows, "xi_k", "Velocity fluctuation against connectivity", XI, "peak at k ="),
            sensitivity_figure(reproduction.sensitivity),
        ]
    )


def make_aamas_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the curves of the AAMAS 2020 predecessor beside its published numbers.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    return _drawn([published_figure(reproduction.main, reproduction.tables.get("published", []))])


def _drawn(figures: Iterable[Figure | None]) -> list[Figure]:
    return [figure for figure in figures if figure is not None]
