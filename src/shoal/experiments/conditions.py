"""The conditions that a search looks at together: those of the arena by name, or changes of one's own."""

import re
from collections.abc import Sequence
from dataclasses import replace

from shoal.core.errors import ScenarioError, did_you_mean
from shoal.experiments.suite import SuiteCondition, read_suite, resized
from shoal.scenario.edit import parse_assignment
from shoal.scenario.load import load
from shoal.scenario.schema import Scenario

ARENA = "arena-wide"  # it has all conditions of the arena, and more
AS_IT_IS = "as-it-is"
_SHARE = "time_on_target"  # asked for under a condition of the arena, what counts there is asked for


def conditions_of(texts: Sequence[str], metric: str, scenario: Scenario) -> list[SuiteCondition]:
    """Return the conditions that are named; without a name, the scenario as it is.

    Parameters
    ----------
    texts : each as-it-is, a condition of the arena ("half lost"), or "target-speed=5,network.loss=0.2"
    metric : what counts
    scenario : what is searched; what happens at a step of the arena happens at the same share of its runs

    Raises
    ------
    ScenarioError : no such condition, one of another arena, or the same twice
    """
    found = [_condition(text, metric, scenario) for text in texts or [AS_IT_IS]]
    for number, each in enumerate(found):
        if any(each.folder == other.folder for other in found[:number]):
            raise ScenarioError(f"--condition {each.name}", "is given twice", "leave out one of them")
    return found


def _condition(text: str, metric: str, scenario: Scenario) -> SuiteCondition:
    if text == AS_IT_IS:
        return SuiteCondition(AS_IT_IS, "the scenario as it is", metric)
    if "=" in text:
        parts = re.split(r",(?=[\w.\-]+=)", text)
        return SuiteCondition(text, text, metric, changes=dict(map(parse_assignment, parts)))
    suite = resized(read_suite(ARENA), steps=scenario.steps)
    known = {each.name: each for each in suite.conditions} | {each.folder: each for each in suite.conditions}
    if text not in known:
        names = [AS_IT_IS, *(each.name for each in suite.conditions)]
        fix = f"{did_you_mean(text, names)}there are: {', '.join(names)}; or FIELD=VALUE,FIELD=VALUE"
        raise ScenarioError(f"--condition {text}", "is not a condition", fix)
    chosen = known[text]
    area, there = scenario.area, load(chosen.scenario or suite.scenario).area
    if chosen.scenario is None and (area.width, area.height) != (there.width, there.height):
        problem = f"is of an arena of {there.width:g} m x {there.height:g} m, and this scenario is not"
        raise ScenarioError(f"--condition {text}", problem, "say it in its fields: FIELD=VALUE,FIELD=VALUE")
    return chosen if metric == _SHARE else replace(chosen, metric=metric, out_of=1.0)
