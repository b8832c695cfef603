"""Check that a scenario can run before it runs, and that it is one that its strategies were made for."""

from typing import Any

from shoal.scenario.assumptions import assumptions
from shoal.scenario.at_sea import open_sea
from shoal.scenario.crew import crew_of
from shoal.scenario.load import Source, load
from shoal.scenario.on_track import open_tracks
from shoal.scenario.schema import Scenario
from shoal.study.suited import rounded, unsuited


def check(scenario: Source, *, trials: bool = False, **changes: Any) -> list[str]:
    """Check a scenario, its strategies and its recorded tracks; return notes of what was assumed or is odd.

    >>> shoal.check("mine.toml", neighbors=10)

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    trials : whether to run it for some seconds, too: are agents at the walls, is its time-step short enough
    changes : as in `Scenario.with_`

    Raises
    ------
    ScenarioError, TrackError, StrategyError : it cannot run: where, why, and how to fix it
    """
    known = load(scenario, **changes)
    if known.metrics:
        from shoal.metrics.chosen import check_metrics  # which imports all metrics, those of packages too

        check_metrics(known.metrics)
    crew_of(known)
    opened = open_sea(known)
    notes = [*assumptions(known), *(opened.notes if opened else ())]
    notes += [note for track in open_tracks(known) for note in track.notes]
    notes += [*_followed(known), *unsuited(known)]
    if trials:
        from shoal.study.trial import tried  # which needs the engine

        notes += tried(known)
    return notes


def _followed(scenario: Scenario) -> list[str]:
    """What strategies leave to follow the scenario, and what that is here."""
    choices = [fleet.strategy or scenario.strategy for fleet in scenario.fleets]
    return [
        f"strategy {choice.name} follows the scenario: "
        + ", ".join(f"{name} = {rounded(value)}" for name, value in choice.open.items())
        for choice in dict.fromkeys(choices)
        if choice.open
    ]
