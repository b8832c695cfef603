"""The kinds of disturbances that there are: ours, and those of installed packages; and their records."""

from shoal.core.declared import declared
from shoal.world.assembled import dtype_of, without_contradictions
from shoal.world.disturbances.contract import COMMON, Disturbance

_found, PROBLEMS = declared("shoal.world.disturbances", "DISTURBANCE", Disturbance, "shoal.disturbances")
KINDS, _state, _make, _wrong = without_contradictions(_found, {}, COMMON)
PROBLEMS += _wrong
NUMBERS = {each.value.name: number for number, each in enumerate(KINDS)}  # by which records say their kind

MEMORY = dtype_of(_state)  # what they remember of an agent
DISTURBANCE_FIELDS = dtype_of(_make)  # what is chosen of one
