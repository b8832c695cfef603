"""Time on target: share of the steps with at least one agent on target; and of every target, and over time."""

from typing import Any

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share

WINDOWS = 50  # of the timeline, per batch


@kernel
def tally_time_on_target(tally, step, world, swarm, targets, scratch):
    """Count a step, the agents that are on a present target (before the move), and the targets watched.

    The timeline counts the same in finer parts: window w of a batch is its steps from w / W to (w + 1) / W.
    """
    engaged = 0
    for i in range(world.agents):
        engaged += swarm.engaged[i]
    count_step(tally, step, targets, engaged)


@kernel
def count_step(tally, step, targets, engaged):
    """Count a step in which so many agents are on a target."""
    batch = step.batch
    present = False
    for j in range(targets.size):
        here = targets[j].present != 0
        present |= here
        tally.target_steps[batch, j] += 1.0 if here else 0.0
        tally.watched[batch, j] += 1.0 if targets[j].watchers > 0 else 0.0
    windows = tally.timeline_present.shape[1]
    window = min(int(tally.steps[batch] * windows / tally.batch_steps[batch]), windows - 1)
    tally.timeline_present[batch, window] += 1.0 if present else 0.0
    tally.timeline_on_target[batch, window] += 1.0 if engaged > 0 else 0.0
    tally.steps[batch] += 1.0
    tally.present[batch] += 1.0 if present else 0.0
    tally.on_target[batch] += 1.0 if engaged > 0 else 0.0
    tally.engaged[batch] += engaged


def fairness(tally: Any) -> float:
    """Jain's index of the targets' shares of time watched."""
    there = tally.target_steps.sum(axis=0)
    shares = tally.watched.sum(axis=0)[there > 0] / there[there > 0]
    squares = float((shares**2).sum())
    return float(shares.sum()) ** 2 / (shares.size * squares) if squares > 0 else float("nan")


MEASUREMENT = Measurement(
    "time_on_target",
    sums=(
        Sum("steps", "steps", "done"),
        Sum("present", "steps", "with a target present"),
        Sum("on_target", "steps", "with an agent on it"),
        Sum("engaged", "agents", "on target, summed over steps"),
        Sum("target_steps", "steps", "at which each target is present", ("batch", "target")),
        Sum("watched", "steps", "at which somebody watches it", ("batch", "target")),
        Sum("timeline_present", "steps", "with a target present, in windows of a batch", ("batch", WINDOWS)),
        Sum("timeline_on_target", "steps", "with an agent on it, in windows of a batch", ("batch", WINDOWS)),
    ),
    before_move=tally_time_on_target,
    metrics=(
        Metric(
            "time_on_target",
            "1",
            "share of the steps with a target present at which an agent is on it",
            lambda t, f: share(t.on_target, t.present),
            better="higher",
            high=1.0,
        ),
        Metric(
            "engaged",
            "agents",
            "mean number of agents on target while a target is present",
            lambda t, f: share(t.engaged, t.present),
            label="engaged agents",
            better="higher",
            high="agents",
        ),
        Metric(
            "target_present",
            "1",
            "share of the steps with a target present",
            lambda t, f: share(t.present, t.steps),
            label="target present",
            once=True,
            high=1.0,
        ),
        Metric(
            "targets_observed",
            "targets",
            "mean number of targets that somebody is on (as in CMOMMT: Parker, Autonomous Robots 12, 2002)",
            lambda t, f: share(t.watched, t.steps),
            better="higher",
            several_targets=True,
        ),
        Metric(
            "fairness",
            "1",
            "Jain's index of the targets' time on target: 1 all alike, 1/T one has it all",
            lambda t, f: fairness(t),
            better="higher",
            high=1.0,
            several_targets=True,
        ),
    ),
    order=1,
)
