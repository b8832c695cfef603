"""Rows of made-up runs, for tests of what is read from them: the truth is known."""

import math

import numpy as np

KS = (2, 6, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30, 34, 40, 49)
SHARES = (0, 10, 15, 20, 30, 40, 50)


def hill(top, height=0.8):
    """A curve over k that peaks at `top`, steeper on the left, as time on target does."""
    return lambda k: height * math.exp(-(math.log(k / top) ** 2))


def made(metrics, *, points=None, seeds=5, noise=0.002, **labels):
    """One row per point and seed; a metric is a function of (fast, neighbors, target_speed), with noise.

    The same seed's noise is the same whatever the metrics are, as with common random numbers. Headings differ by seed,
    too: of values that are all alike no interval is known.
    """
    points = points or [(fast, k, speed) for fast in (15, 0) for k in KS for speed in (3.0, 5.0)]
    rng = np.random.default_rng(7)
    return [
        {
            "fast": fast,
            "neighbors": k,
            "target_speed": speed,
            "run": run,
            "status": "done",
            **{name: metric(fast, k, speed) + noise * rng.normal() for name, metric in metrics.items()},
            "phi_histogram": [1.0] * 5 + [4.0] + [1.0] * 3 + [0.1 * k, (0.2 + 1e-4 * (run - (seeds - 1) / 2)) * k],
            **labels,
        }
        for fast, k, speed in points
        for run in range(seeds)
    ]
