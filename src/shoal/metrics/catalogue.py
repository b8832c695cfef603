"""Every measurement there is: one per file of this folder, and those of installed packages (docs/how-to/own-metric.md).

They are found, checked and put in order once, when the first of what is assembled from them is imported.
"""

import keyword
import math
import re
from collections import Counter
from collections.abc import Iterable

from shoal.core.declared import Declared, declared
from shoal.core.errors import PluginError
from shoal.metrics.contract import LIMITS, MOMENTS, Measurement, Metric, Sum

_OF_RUNS = {"batch", "run"}
_OF_EACH = {"fleet", "agent", "target"}
_TAKEN = (  # what tables of runs say besides
    "run", "run_id", "seed", "scenario_hash", "point", "status", "error", "started", "seconds", "checksum",
    "shoal_version", "results_version", "phi_histogram", "fleet_phi_histogram", "fleet_xi_raw", "fleet_stationary",
    "targets", "loss_lengths", "changes", "fleets", "units", "runs", "batch_steps",
)  # fmt: skip


def _in_order() -> tuple[Declared[Measurement], ...]:
    """Built-in measurements in their order, then those of packages by name.

    Raises
    ------
    PluginError : what a package offers cannot be used
    """
    found, wrong = declared("shoal.metrics", "MEASUREMENT", Measurement, "shoal.metrics")
    if wrong:
        raise wrong[0]
    found.sort(key=lambda each: (each.package is not None, each.value.order, each.value.name))
    names = Counter(_TAKEN)
    for each in found:
        problem = _problem(each.value, names)
        if problem and each.package is not None:
            raise PluginError(each.package, f"measurement {each.value.name!r}: {problem}", "fix or uninstall it")
        assert not problem, problem
    return tuple(found)


def _problem(measurement: Measurement, names: Counter[str]) -> str | None:
    """What is wrong with it; `names` are those that are taken, of sums and of metrics, and gain its own."""
    if not all(isinstance(each, Sum) for each in measurement.sums):
        return "sums is not a tuple of shoal.Sum"
    if not measurement.metrics or not all(isinstance(each, Metric) for each in measurement.metrics):
        return "metrics is not a tuple of at least one shoal.Metric"
    for moment in MOMENTS:
        if not callable(getattr(measurement, moment) or print):
            return f"{moment} is not a function"
    for each in measurement.sums:
        problem = _problem_of_name(each.name, "sum", names) or _problem_of_sum(each)
        if problem:
            return problem
    for metric in measurement.metrics:
        problem = _problem_of_name(metric.name, "metric", names) or _problem_of_metric(metric)
        if problem:
            return problem
    return None


def _problem_of_name(name: object, what: str, names: Counter[str]) -> str | None:
    if not isinstance(name, str) or not re.fullmatch(r"[a-z][a-z0-9_]{0,59}", name) or keyword.iskeyword(name):
        return f"{what} {name!r} is not called in small letters, digits and _"
    taken = f"{what} {name}"
    if names[taken] or (what == "metric" and names[name]) or (what == "sum" and name == "batch_steps"):
        return f"{what} {name!r} is there already; give it another name"
    names[taken] += 1
    return None


def _problem_of_sum(each: Sum) -> str | None:
    first, rest = each.shape[:1], each.shape[1:]
    if not _OF_RUNS.issuperset(first) or not first:
        return f"sum {each.name!r}: its shape begins with neither 'batch' nor 'run'"
    if not all(part in _OF_EACH or (type(part) is int and part > 0) for part in rest):
        return f"sum {each.name!r}: its shape goes on with neither 'fleet', 'agent', 'target' nor a number of bins"
    if not math.isfinite(each.start):
        return f"sum {each.name!r} starts at {each.start}, which is not finite"
    return _problem_of_words(each.name, "sum", (each.unit, each.sentence))


def _problem_of_metric(metric: Metric) -> str | None:
    if metric.better not in ("higher", "lower", "neither"):
        return f"metric {metric.name!r}: better is {metric.better!r}, none of 'higher', 'lower', 'neither'"
    if not callable(metric.formula):
        return f"metric {metric.name!r}: its formula is not a function"
    high = LIMITS.get(metric.high) if isinstance(metric.high, str) else metric.high
    if not isinstance(metric.low, (int, float)) or not isinstance(high, (int, float)):
        return f"metric {metric.name!r}: its bounds are not numbers; high may also be one of {', '.join(LIMITS)}"
    return _problem_of_words(metric.name, "metric", (metric.unit, metric.sentence))


def _problem_of_words(name: str, what: str, words: Iterable[object]) -> str | None:
    if not all(isinstance(each, str) and each.strip() for each in words):
        return f"{what} {name!r} has no unit or no sentence"
    return None


DECLARED = _in_order()
MEASUREMENTS = tuple(each.value for each in DECLARED)
