"""Contacts: when each target is first detected, how often it is lost, and how long until it is found again."""

import math

from shoal.compiler.kernel import kernel


@kernel
def tally_contacts(tally, batch, targets):
    """Count the steps before the first detection, those in which a found target is lost, and how long losses last.

    A loss begins at the first step without a watcher after one with, and ends when somebody watches again; steps at
    which the target is not there count for nothing. targets.lost holds the length of the loss under way, -1 before the
    first detection. tally.loss_lengths counts ended losses by their length in powers of 2: bin b is [2^b, 2^(b+1)).
    """
    bins = tally.loss_lengths.shape[1]
    for j in range(targets.size):
        if targets[j].present != 0:
            lost = targets[j].lost
            if targets[j].watchers > 0:
                if lost > 0:
                    tally.ended[batch, j] += 1.0
                    tally.ended_steps[batch, j] += lost
                    tally.loss_lengths[batch, min(int(math.log2(lost)), bins - 1)] += 1.0
                targets[j].lost = 0
            elif lost >= 0:
                tally.losses[batch, j] += 1.0 if lost == 0 else 0.0
                targets[j].lost = lost + 1
            else:
                tally.undetected[batch, j] += 1.0
