"""Contacts: when each target is first detected, how often it is lost, and how long until it is found again."""

from shoal.compiler.kernel import kernel
from shoal.metrics.contract import Measurement, Metric, Sum
from shoal.metrics.shares import share

LENGTHS = 32  # bins of the lengths of losses


@kernel
def tally_contacts(tally, step, world, swarm, targets, scratch):
    """Count the steps before the first detection, those in which a found target is lost, and how long losses last.

    A loss begins at the first step without a watcher after one with, and ends when somebody watches again; steps at
    which the target is absent count for nothing. targets.lost holds the length of the current loss, -1 before the
    first detection. tally.loss_lengths counts ended losses by their length in powers of 2: bin b is [2^b, 2^(b+1)).
    """
    batch = step.batch
    bins = tally.loss_lengths.shape[1]
    for j in range(targets.size):
        if targets[j].present != 0:
            lost = targets[j].lost
            if targets[j].watchers > 0:
                if lost > 0:
                    tally.ended[batch, j] += 1.0
                    tally.ended_steps[batch, j] += lost
                    length = 0
                    while length < bins - 1 and lost >= 2 << length:
                        length += 1
                    tally.loss_lengths[batch, length] += 1.0
                targets[j].lost = 0
            elif lost >= 0:
                tally.losses[batch, j] += 1.0 if lost == 0 else 0.0
                targets[j].lost = lost + 1
            else:
                tally.undetected[batch, j] += 1.0


MEASUREMENT = Measurement(
    "contacts",
    sums=(
        Sum("undetected", "steps", "before the first detection of each target", ("batch", "target")),
        Sum("losses", "losses", "begun, of each target", ("batch", "target")),
        Sum("ended", "losses", "ended, of each target", ("batch", "target")),
        Sum("ended_steps", "steps", "that ended losses lasted, of each target", ("batch", "target")),
        Sum("loss_lengths", "losses", "ended, by their length: bin b is [2^b, 2^(b+1)) steps", ("batch", LENGTHS)),
    ),
    before_move=tally_contacts,
    metrics=(
        Metric(
            "first_detection",
            "s",
            "time at which a target is present until it is first detected, mean over targets; all of it if never",
            lambda t, f: float(t.undetected.sum(axis=0).mean()) * f.time_step,
            better="lower",
            once=True,
            high="duration",
        ),
        Metric(
            "losses",
            "1/h",
            "how often a target is lost, per hour of it being there",
            lambda t, f: share(t.losses, t.target_steps) * 3600.0 / f.time_step,
            better="lower",
            high="flicker",
        ),
        Metric(
            "reacquisition",
            "s",
            "mean time from the loss of a target to its next detection",
            lambda t, f: share(t.ended_steps, t.ended) * f.time_step,
            better="lower",
            high="duration",
        ),
    ),
    order=4,
)
