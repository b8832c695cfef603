"""Where a noisy curve is highest: draws from all smooth curves that fit its points, their smoothness learned from them.

A polynomial through the points near the top would need to know how smooth the curve is: where a curve rises and
falls unequally, it finds a place beside the true one, by an error that no interval of it knows of. A Gaussian process
says how far the curve can bend between the points, so its draws hold both, noise and bend.
Rasmussen, Williams, "Gaussian Processes for Machine Learning" (2006), chapters 2 and 5.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]

_STEP = 0.25  # between the places where a top is looked for; a parabola through three of them tells it finer
_LENGTHS = np.geomspace(6.0, 120.0, 10)  # over which a curve bends, in units of x; smoothly, or with kinks
_HEIGHTS = np.geomspace(3.0, 3000.0, 13)  # by which it bends, in errors of a point
_LEVEL = 25.0  # variance of a curve's level, in squared heights
_FAR = 5.0  # standard deviations: places that lie so far below the top are not the top
_FITS = 24  # of equal weight, that stand for all


class Tops(NamedTuple):
    """Place and height of the top of the mean curve, and of every drawn one, (D,)."""

    place: float
    height: float
    places: Floats
    heights: Floats


class _Grid(NamedTuple):
    """What the places alone decide: K points, F fine places, for each of L ways to bend.

    values (L, K), vectors (L, K, K) : of the points' covariance
    across (L, F, K), fine_only (L, F, F) : covariances of the fine places
    """

    fine: Floats
    values: Floats
    vectors: Floats
    across: Floats
    fine_only: Floats


class _Fit(NamedTuple):
    """One smoothness: its weight, its height, and the operator from points to fine places (F, K)."""

    weight: float
    bend: int
    height: float
    smooth: Floats


def tops(x: Floats, mean: Floats, error: float, noise: Floats, rng: np.random.Generator) -> Tops:
    """Return the top of a curve, as likely curves have it.

    Parameters
    ----------
    x, mean : its points, (K,); x ascends
    error : standard error of a point
    noise : made-up errors of all points, one row for each curve that is drawn, (D, K)
    rng : decides how drawn curves bend between the points
    """
    grid, level = _grid(tuple(x.tolist())), float(mean.mean())
    points = (mean - level) / error
    fits = _fits(grid, points)
    middle, near = _promising(grid, fits, points)
    place, height = _highest(grid.fine[near], middle[np.newaxis, near])
    draws = rng.multinomial(len(noise), [fit.weight for fit in fits])
    made_up = np.split(points - noise / error, np.cumsum(draws)[:-1])
    curves = np.concatenate([_draw(grid, fit, each, near, rng) for fit, each in zip(fits, made_up, strict=True)])
    places, heights = _highest(grid.fine[near], curves)
    return Tops(float(place[0]), level + error * float(height[0]), places, level + error * heights)


@lru_cache(maxsize=32)
def _grid(points: tuple[float, ...]) -> _Grid:
    x = np.array(points)
    fine = np.linspace(x[0], x[-1], 1 + round((x[-1] - x[0]) / _STEP))
    values, vectors = np.linalg.eigh(_covariance(x, x))
    return _Grid(fine, np.maximum(values, 0.0), vectors, _covariance(fine, x), _covariance(fine, fine))


def _covariance(one: Floats, other: Floats) -> Floats:
    """Matern's, of curves with two derivatives and with one, of each length, and that of the level."""
    distance = np.abs(one[:, np.newaxis] - other) / _LENGTHS[:, np.newaxis, np.newaxis]
    two, one_only = np.sqrt(5) * distance, np.sqrt(3) * distance
    bends = [(1 + two + two**2 / 3) * np.exp(-two), (1 + one_only) * np.exp(-one_only)]
    covariance: Floats = _LEVEL + np.concatenate(bends)
    return covariance


def _fits(grid: _Grid, points: Floats) -> list[_Fit]:
    """Likely combinations of bend and height, by their marginal likelihood."""
    rotated = points @ grid.vectors  # (L, K)
    spread = _HEIGHTS[:, np.newaxis] ** 2 * grid.values[:, np.newaxis] + 1  # (L, heights, K)
    fit = -0.5 * (rotated[:, np.newaxis] ** 2 / spread + np.log(spread)).sum(axis=2)
    likely = np.exp(fit - fit.max()).ravel()
    chosen = np.searchsorted(likely.cumsum() / likely.sum(), (np.arange(_FITS) + 0.5) / _FITS)
    return [
        _Fit(count / _FITS, at, _HEIGHTS[h], _smoother(grid, at, _HEIGHTS[h]))
        for each, count in zip(*np.unique(chosen, return_counts=True), strict=True)
        for at, h in [divmod(int(each), _HEIGHTS.size)]
    ]


def _smoother(grid: _Grid, bend: int, height: float) -> Floats:
    vectors, values = grid.vectors[bend], grid.values[bend]
    smoother: Floats = grid.across[bend] @ (vectors / (values + 1 / height**2)) @ vectors.T
    return smoother


def _promising(grid: _Grid, fits: Sequence[_Fit], points: Floats) -> tuple[Floats, slice]:
    """The mean curve (F,), and the stretch of it that can hold the top."""
    means = np.array([fit.smooth @ points for fit in fits])
    weights = np.array([fit.weight for fit in fits])
    within = [
        fit.height**2 * ((1 + _LEVEL) - (fit.smooth * grid.across[fit.bend]).sum(axis=1)).clip(min=0.0) for fit in fits
    ]
    middle: Floats = weights @ means
    deviation = np.sqrt(weights @ (np.array(within) + (means - middle) ** 2))
    high = np.flatnonzero(middle + _FAR * deviation >= (middle - _FAR * deviation).max())
    return middle, slice(int(high[0]), int(high[-1]) + 1)


def _draw(grid: _Grid, fit: _Fit, points: Floats, near: slice, rng: np.random.Generator) -> Floats:
    """Curves through noisy points (D, K), with what they do not tell made up (Matheron's rule)."""
    smooth, across = fit.smooth[near], grid.across[fit.bend][near]
    vectors, values = grid.vectors[fit.bend], grid.values[fit.bend]
    seen = smooth @ (vectors * np.sqrt(values))
    shared = smooth @ across.T
    unknown = grid.fine_only[fit.bend][near, near] - shared - shared.T + seen @ seen.T
    spread, axes = np.linalg.eigh(unknown)
    bend = rng.standard_normal((len(points), len(spread))) @ (axes * np.sqrt(spread.clip(min=0.0))).T
    curves: Floats = points @ smooth.T + fit.height * bend
    return curves


def _highest(x: Floats, curves: Floats) -> tuple[Floats, Floats]:
    """Place and height of the top of each curve (C, F), by a parabola through the highest point and its neighbors."""
    top = curves.argmax(axis=1)
    inner = np.clip(top, 1, max(x.size - 2, 1))
    if x.size < 3:
        return x[top], curves.max(axis=1)
    rows = np.arange(len(curves))
    left, middle, right = (curves[rows, inner + beside] for beside in (-1, 0, 1))
    bent = left - 2 * middle + right
    shift = np.where((top == inner) & (bent < 0), (left - right) / (2 * np.where(bent < 0, bent, 1.0)), 0.0)
    height = np.where(top == inner, middle - (left - right) * shift / 4, curves[rows, top])
    return x[top] + shift * (x[1] - x[0]), height
