"""All figures of a reproduction, in the order of the paper."""

from collections.abc import Iterable
from dataclasses import replace

from shoal.paper.figures_alife import alife_figures
from shoal.paper.figures_curves import k_figure, share_figure
from shoal.paper.figures_density import density_figures
from shoal.paper.figures_heading import heading_figure
from shoal.paper.figures_histograms import phi_figure
from shoal.paper.figures_published import published_figure
from shoal.paper.figures_readings import readings_figure, readings_peaks_figure
from shoal.paper.figures_sensitivity import sensitivity_figure
from shoal.paper.figures_series import TIME_ON_TARGET, XI, XI_RAW
from shoal.paper.figures_sides import sides_figure
from shoal.paper.figures_snapshots import clustering_figure, locked_figure
from shoal.paper.plan import PRINTED, REFIT, SPEEDS
from shoal.paper.results import Figure, Reproduction
from shoal.paper.snapshots import STEPS, watch
from shoal.scenario.load import load


def make_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the figures of the OCEANS 2020 paper, drawn from our runs; what was not run is left out.

    The snapshots come from runs made here: the presets, their seed, up to 20,000 steps (a second). Locked buoys are
    shown in the reading that has them inside the area.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    rows, refit = reproduction.main, reproduction.refit
    steps = min(STEPS, reproduction.steps)
    return _drawn(
        [
            heading_figure(),
            locked_figure(watch(load(REFIT), steps=steps)),
            phi_figure(rows),
            share_figure(rows, "tot_share", "Time on target against the share of fast buoys", [TIME_ON_TARGET]),
            k_figure(rows, "tot_k", "Time on target against connectivity", TIME_ON_TARGET, "k* ="),
            clustering_figure(watch(load(PRINTED), steps=steps)),
            share_figure(rows, "xi_share", "Velocity fluctuation against the share of fast buoys", [XI, XI_RAW]),
            k_figure(rows, "xi_k", "Velocity fluctuation against connectivity", XI, "peak at k ="),
            _refit(phi_figure(refit)),
            _refit(k_figure(refit, "tot_k", "Time on target against connectivity", TIME_ON_TARGET, "k* =")),
            _refit(k_figure(refit, "xi_k", "Velocity fluctuation against connectivity", XI, "peak at k =")),
            sides_figure(reproduction.sides),
            *(sensitivity_figure(reproduction.sensitivity, speed) for speed in SPEEDS),
        ]
    )


def make_study_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the figures of the study of the readings.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    tables = reproduction.tables
    scores, peaks = tables["readings_scores"], tables["readings_peaks"]
    return _drawn([readings_figure(scores), readings_peaks_figure(scores, peaks)])


def _refit(figure: Figure | None) -> Figure | None:
    """A figure of the other reading, under another name."""
    if figure is None:
        return None
    return replace(figure, name=f"{figure.name}_refit", title=f"{figure.title}, {REFIT}")


def make_aamas_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the curves of the AAMAS 2020 predecessor beside its published numbers.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    return _drawn([published_figure(reproduction.main, reproduction.tables.get("published", []))])


def make_alife_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the figures of mixed fleets after a target that flees.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    return alife_figures(reproduction.groups)


def make_density_figures(reproduction: Reproduction) -> list[Figure]:
    """Return the figure of the density of a swarm.

    Raises
    ------
    MissingExtraError : matplotlib is not installed
    """
    return density_figures(reproduction.groups)


def _drawn(figures: Iterable[Figure | None]) -> list[Figure]:
    return [figure for figure in figures if figure is not None]
