"""Check that a scenario can run before it runs."""

from typing import Any

from shoal.scenario.assumptions import assumptions
from shoal.scenario.crew import crew_of
from shoal.scenario.load import Source, load
from shoal.scenario.on_track import open_tracks


def check(scenario: Source, **changes: Any) -> list[str]:
    """Check a scenario, its strategies and its recorded tracks; return notes of what was assumed or dropped.

    >>> shoal.check("mine.toml", neighbors=10)

    Parameters
    ----------
    scenario : a preset's name, a TOML file, a dict or a Scenario
    changes : as in `Scenario.with_`

    Raises
    ------
    ScenarioError, TrackError, StrategyError : it cannot run: where, why, and how to fix it
    """
    known = load(scenario, **changes)
    crew_of(known)
    return [*assumptions(known), *(note for track in open_tracks(known) for note in track.notes)]
