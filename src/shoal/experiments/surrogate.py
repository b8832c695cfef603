"""A surrogate: what a metric is expected to be where nothing was run yet, from what was, noise and all.

A plane by least squares, and a Gaussian process of its residuals with a squared exponential kernel, whose length and
noise are those of the greatest marginal likelihood among a few. Rasmussen, Williams, "Gaussian Processes for Machine
Learning" (2006), sections 2.2 and 5.4.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

LENGTHS = (0.15, 0.25, 0.4, 0.7, 1.2)  # of the kernel, where the ranges of all variables are 1 wide
NOISES = (0.002, 0.01, 0.04, 0.15, 0.5)  # variance of a mean over runs, as a share of that of the residuals
_EXACT = 1e-9  # of the spread: residuals below it are rounding
_PRIMES = (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)

Floats = npt.NDArray[np.float64]


class Surrogate(NamedTuple):
    """plane (V + 1,); places (T, V) that are known; weights (T,) of the kernel there; its length."""

    plane: Floats
    places: Floats
    weights: Floats
    length: float

    def __call__(self, places: Floats) -> Floats:
        """Expected values (M,) at places (M, V)."""
        return _columns(places) @ self.plane + _kernel(places, self.places, self.length) @ self.weights


def surrogate(places: Floats, values: Floats) -> Surrogate:
    """Return the surrogate of values (T,) at places (T, V), each coordinate from 0 to 1."""
    columns = _columns(places)
    plane: Floats = np.asarray(np.linalg.lstsq(columns, values, rcond=None)[0], np.float64)
    rest = values - columns @ plane
    scale = float(rest.std())
    if scale <= _EXACT * max(float(np.abs(values).max()), 1e-300):
        return Surrogate(plane, places, np.zeros(values.size), 1.0)
    best, weights, chosen = -math.inf, np.zeros(values.size), 1.0
    for length in LENGTHS:
        kernel = _kernel(places, places, length)
        for noise in NOISES:
            likelihood, solved = _fitted(kernel + noise * np.eye(values.size), rest / scale)
            if likelihood > best:
                best, weights, chosen = likelihood, solved * scale, length
    return Surrogate(plane, places, weights, chosen)


def halton(count: int, begin: int, dimensions: int) -> Floats:
    """Return `count` points of the Halton sequence from number `begin` on, (count, dimensions): even in a unit cube."""
    numbers = np.arange(begin + 1, begin + 1 + count)
    return np.column_stack([_radical_inverse(numbers, _PRIMES[axis % len(_PRIMES)]) for axis in range(dimensions)])


def _fitted(covariance: Floats, values: Floats) -> tuple[float, Floats]:
    """Logarithm of the marginal likelihood, its variance at its best, and the weights of the kernel."""
    factor = np.linalg.cholesky(covariance)
    weights = np.linalg.solve(factor.T, np.linalg.solve(factor, values))
    variance = float(values @ weights) / values.size
    return -0.5 * values.size * math.log(variance) - float(np.log(np.diag(factor)).sum()), weights


def _kernel(one: Floats, other: Floats, length: float) -> Floats:
    squares: Floats = ((one[:, None, :] - other[None, :, :]) ** 2).sum(axis=2)
    return np.exp(-squares / (2 * length**2))


def _columns(places: Floats) -> Floats:
    return np.column_stack([np.ones(len(places)), places])


def _radical_inverse(numbers: npt.NDArray[np.int64], base: int) -> Floats:
    """The digits of whole numbers in a base, mirrored behind the point."""
    left, found, share = numbers.copy(), np.zeros(numbers.size), 1.0 / base
    while left.any():
        found += share * (left % base)
        left //= base
        share /= base
    return found
