"""Time on target: share of the steps with at least one agent on target; and of every target, and over time."""

from shoal.compiler.kernel import kernel


@kernel
def tally_time_on_target(tally, batch, targets, engaged):
    """Count a step at which `engaged` agents watch a target (before the move), and the targets watched.

    The timeline counts the same in finer parts: window w of a batch is its steps from w / W to (w + 1) / W.
    """
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
