"""Chance as a pure function of (seed, run, step, who, purpose).

No generator has a state, so a draw is the same whatever the number of threads, the batch, the chunk or the resume.
The hash is the finalizer of SplitMix64 (Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
OOPSLA 2014), applied once per level: run, step, agent, purpose.
"""

import math

from shoal.compiler.kernel import kernel
from shoal.compiler.late import compiles

_ALL = 0xFFFFFFFFFFFFFFFF  # 64 bits: what machine words keep by themselves, and Python's integers do not

if compiles():
    from numpy import uint64 as word
else:

    def word(number):  # type: ignore[no-redef]
        """An integer as 64 bits without sign."""
        return int(number) & _ALL


_GOLDEN = word(0x9E3779B97F4A7C15)
_FIRST = word(0xBF58476D1CE4E5B9)
_SECOND = word(0x94D049BB133111EB)
_ONE, _11, _27, _30, _31 = word(1), word(11), word(27), word(30), word(31)
_TO_UNIT = 2.0**-53

TARGET_STREAM = 1 << 32  # targets draw as "agents" from here on, so that no fleet size can collide with them
START_STEP = (1 << 62) - 1  # draws made before the first step


@kernel
def mix(bits):
    """Scramble 64 bits."""
    bits = (bits ^ (bits >> _30)) * _FIRST & _ALL
    bits = (bits ^ (bits >> _27)) * _SECOND & _ALL
    return bits ^ (bits >> _31)


@kernel
def split(key, number):
    """Key number `number` below `key`: of a run below a seed, of a step below a run, of an agent below a step."""
    return mix(word(key) + (word(number) + _ONE) * _GOLDEN & _ALL)


@kernel
def uniform(key, purpose):
    """Draw from U[0, 1) for a purpose (a small int); the same key and purpose give the same number."""
    return float(split(key, purpose) >> _11) * _TO_UNIT


@kernel
def normal(key, purpose):
    """Draw from N(0, 1) for a purpose; Box-Muller over two draws below the purpose."""
    below = split(key, purpose)
    radius = math.sqrt(-2.0 * math.log(1.0 - uniform(below, 0)))
    return radius * math.cos(2.0 * math.pi * uniform(below, 1))
