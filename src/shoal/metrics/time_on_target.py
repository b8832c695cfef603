"""Time on target: share of the steps with at least one agent on target."""

from shoal.core.kernel import kernel


@kernel
def tally_time_on_target(tally, batch, targets, engaged):
    """Count a step; returns whether any target is there. `engaged` agents are on target (before the move)."""
    present = False
    for target in targets:
        present |= target.present != 0
    tally.steps[batch] += 1.0
    tally.present[batch] += 1.0 if present else 0.0
    tally.on_target[batch] += 1.0 if engaged > 0 else 0.0
    tally.engaged[batch] += engaged
    return present
