"""The kinds of targets that there are: ours, and those of installed packages; and their records."""

from shoal.core.declared import declared
from shoal.world.assembled import dtype_of, without_contradictions
from shoal.world.targets.contract import MAKE, STATE, Target

_found, PROBLEMS = declared("shoal.world.targets", "TARGET", Target, "shoal.targets")
KINDS, _state, _make, _wrong = without_contradictions(_found, STATE, MAKE)
PROBLEMS += _wrong
NUMBERS = {each.value.name: number for number, each in enumerate(KINDS)}  # by which records say their kind

TARGET_STATE = dtype_of(_state)  # what a target is doing
TARGET_MAKE = dtype_of(_make)  # what is chosen of it
TARGET_FIELDS = dtype_of({**_state, **_make})  # both, as kernels take them
