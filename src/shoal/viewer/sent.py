"""What a page is sent when it asks for it, or once: files to save, the course of a run until now, its total."""

import json
import math
from collections.abc import Sequence

from shoal.core.text import plain
from shoal.record.course import value_of
from shoal.run.change_log import ChangeLog
from shoal.run.facts import facts_of
from shoal.scenario.load import to_toml
from shoal.viewer.frame import SCALARS, gauges_of
from shoal.viewer.live import LiveRun
from shoal.viewer.requests import Export
from shoal.viewer.ring import Kept
from shoal.viewer.scene import as_json


def file_of(request: Export, run: LiveRun, log: ChangeLog) -> str:
    """The message that brings a page the text of a file: the scenario as it is set now, or the log of changes."""
    if request.what == "changes":
        text = log.text()
    else:
        scenario, step = run.simulation.scenario, run.simulation.number
        name = plain(scenario.name)
        text = f"# What {name} was set to at step {step:,} of a watched run; it begins anew, with all buoys.\n"
        text += to_toml(scenario)
    return as_json({"type": "file", "what": request.what, "run": request.run, "text": text})


def history_of(run: int, kept: Sequence[Kept]) -> str:
    """The message that fills the charts of a run with some of its frames."""
    gauges = [gauges_of(each.frames[run]) for each in kept]
    return as_json(
        {
            "type": "history",
            "run": run,
            "step": [each.step for each in kept],
            "numbers": [json.loads(each.numbers[run])["values"] if each.numbers else [] for each in kept],
            **{name: [getattr(each, name) for each in gauges] for name in SCALARS},
        }
    )


def words_at_end(run: LiveRun) -> str:
    """What is said when the recorded tracks of a run are over: the total."""
    simulation = run.simulation
    value = value_of("time_on_target", simulation.tally, facts_of(simulation.scenario))
    total = f"time on target {value:.3f}" if math.isfinite(value) else "no target was there"
    whole = f"since step {run.since:,}" if run.since else "over the whole track"
    which = f"run {'AB'[run.place]}: " if run.place else ""
    return f"The recorded track ends here; {which}{total} {whole}."
