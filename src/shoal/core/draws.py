"""Chance as a pure function of (seed, run, step, who, purpose).

No generator has a state, so a draw is the same whatever the number of threads, the batch, the chunk or the resume.
The hash is the finalizer of SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
OOPSLA 2014), applied once per level: run, step, agent, purpose.
"""

import math

import numpy as np

from shoal.compiler.kernel import kernel

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_FIRST = np.uint64(0xBF58476D1CE4E5B9)
_SECOND = np.uint64(0x94D049BB133111EB)
_ONE = np.uint64(1)
_TO_UNIT = 2.0**-53

TARGET_STREAM = 1 << 32  # targets draw as "agents" from here on, so that no fleet size can collide with them
START_STEP = (1 << 62) - 1  # draws made before the first step


@kernel
def mix(word):
    """Scramble 64 bits."""
    word = (word ^ (word >> np.uint64(30))) * _FIRST
    word = (word ^ (word >> np.uint64(27))) * _SECOND
    return word ^ (word >> np.uint64(31))


@kernel
def split(key, number):
    """Key number `number` below `key`: of a run below a seed, of a step below a run, of an agent below a step."""
    return mix(key + (np.uint64(number) + _ONE) * _GOLDEN)


@kernel
def uniform(key, purpose):
    """Draw from U[0, 1) for a purpose (a small int); the same key and purpose give the same number."""
    return np.float64(split(key, purpose) >> np.uint64(11)) * _TO_UNIT


@kernel
def normal(key, purpose):
    """Draw from N(0, 1) for a purpose; Box-Muller over two draws below the purpose."""
    below = split(key, purpose)
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform(below, 0)))
    return radius * math.cos(2.0 * math.pi * uniform(below, 1))
