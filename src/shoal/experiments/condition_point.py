"""A point of a search under another condition: lengths and times of strategies follow what their defaults follow."""

import re
from collections.abc import Callable

from shoal.core.errors import ScenarioError
from shoal.experiments.design import Point
from shoal.scenario.scales import scales_of
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice, following

_PARAMETER = re.compile(r"(?:fleets\.(?P<fleet>.+)\.)?strategy\.(?P<name>\w+)")


def followed_point(point: Point, searched: Callable[[], Scenario], condition: Callable[[], Scenario]) -> Point:
    """Return the point as a condition has it; as it is, where no varied parameter follows a length of the scenario.

    Parameters
    ----------
    point : {field: value}, its lengths and times as the searched scenario would have them
    searched, condition : make that scenario and the one of the condition, both at the point, once they are needed

    Notes
    -----
    A parameter that is marked `Follows` is as many times longer under the condition as its default is there
    (docs/explanation/scale.md): so one set of numbers serves conditions of another spacing, reach or step.
    """
    said = {field: found for field in point if (found := _PARAMETER.fullmatch(field))}
    if not said:
        return point
    here, there = searched(), condition()
    values = dict(point)
    for field, found in said.items():
        ours, theirs = (_choice(each, found["fleet"], field) for each in (here, there))
        if found["name"] in following(ours.owner) and (default := ours.at(scales_of(here)).defaults[found["name"]]):
            values[field] = point[field] * (theirs.at(scales_of(there)).defaults[found["name"]] / default)
    return values


def _choice(scenario: Scenario, fleet: str | None, field: str) -> StrategyChoice:
    if fleet is None:
        return scenario.strategy
    for number, each in enumerate(scenario.fleets):
        if fleet in (each.name, str(number)):
            return each.strategy or scenario.strategy
    raise ScenarioError(field, "names no fleet", f"there are: {', '.join(each.name for each in scenario.fleets)}")
