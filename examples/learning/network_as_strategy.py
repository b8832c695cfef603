"""A trained network as a strategy: what it does in the environment, it does in any run, and on a buoy.

    python examples/learning/ppo.py     # writes network_as_strategy.npz beside this file
    shoal run oceans2020 --neighbors 8 --strategy examples/learning/network_as_strategy.py

In the .npz are the layers, w0 (inputs, outputs), b0 (outputs,), w1, b1, ..., with tanh between them; and what counted
as 1 in the environment: length [m], speed [m/s]. It observes what Observe(reports=8) says, and does what Act() means.
"""

import math
import zlib
from pathlib import Path
from typing import NamedTuple

import numpy as np

import shoal

FILE = Path(__file__).with_suffix(".npz")
OWN, REPORTS, EACH = 6, 8, 6  # numbers of oneself; of how many reports; numbers of each

if not FILE.exists():
    raise FileNotFoundError(f"there is no {FILE}: save the weights there, as ppo.py does")
saved = np.load(FILE)
LAYERS = sum(1 for name in saved if name.startswith("w"))
WIDEST = max(saved[f"w{n}"].shape[1] for n in range(LAYERS))
WEIGHTS = tuple(np.ascontiguousarray(saved[f"w{n}"], float) for n in range(LAYERS))  # constants of the compiled code
BIASES = tuple(np.ascontiguousarray(saved[f"b{n}"], float) for n in range(LAYERS))
if len(WEIGHTS[0]) != OWN + REPORTS * EACH or len(BIASES[-1]) != 2:
    raise ValueError(f"{FILE.name} has {len(WEIGHTS[0])} inputs and {len(BIASES[-1])} outputs, not 54 and 2")


class Network(NamedTuple):
    length: shoal.Meters = float(saved["length"])  # what counts as 1, as when it learned
    speed: shoal.MetersPerSecond = float(saved["speed"])
    weights: int = zlib.crc32(FILE.read_bytes())  # other weights are another scenario, with a hash of its own


@shoal.kernel
def cut(value):
    return min(max(value, -2.0), 2.0)


@shoal.kernel
def report(me, other, params, n):
    """The six numbers of a neighbor's report if it is the n-th nearest, else zeros."""
    this = (other.rank == n) * 1.0
    dx, dy = cut((other.x - me.x) / params.length), cut((other.y - me.y) / params.length)
    vx, vy = cut(other.vx / params.speed), cut(other.vy / params.speed)
    return this, this * dx, this * dy, this * vx, this * vy, this * other.on_target


def all_reports(me, other, params):
    """Each sum is over all neighbors, but only one of them has the rank: so the sums are the reports, in order."""
    return (
        *report(me, other, params, 0),
        *report(me, other, params, 1),
        *report(me, other, params, 2),
        *report(me, other, params, 3),
        *report(me, other, params, 4),
        *report(me, other, params, 5),
        *report(me, other, params, 6),
        *report(me, other, params, 7),
    )


@shoal.strategy(
    "network",
    params=Network,
    influence=all_reports,
    sums=tuple(f"report_{n}" for n in range(REPORTS * EACH)),
)
def network(me, heard, memory, params, draw):
    """What a trained network wants of what it observes."""
    known, found = np.zeros(max(WIDEST, OWN + REPORTS * EACH)), np.zeros(WIDEST)
    known[0], known[1] = cut(me.x / params.length), cut(me.y / params.length)
    known[2], known[3] = cut(me.vx / params.speed), cut(me.vy / params.speed)
    known[4], known[5] = me.on_target, me.max_speed / params.speed
    for n in range(REPORTS * EACH):
        known[OWN + n] = heard.sums[n]
    for layer in range(LAYERS):
        weights, biases = WEIGHTS[layer], BIASES[layer]
        inputs, outputs = weights.shape
        for j in range(outputs):
            found[j] = biases[j]
        for i in range(inputs):
            for j in range(outputs):
                found[j] += known[i] * weights[i, j]
        for j in range(outputs):
            known[j] = math.tanh(found[j]) if layer < LAYERS - 1 else min(max(found[j], -1.0), 1.0)
    return known[0] * me.max_speed, known[1] * me.max_speed
