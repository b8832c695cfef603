"""A recorded track, followed fix by fix."""

from shoal.compiler.kernel import kernel


@kernel
def follow_track(target, tracks, time):
    """Interpolate between the two fixes around `time`; outside the track and in long gaps the target is not there."""
    first = target.first_fix
    last = first + target.fixes - 1
    target.present = 0
    if time < tracks.time[first] or time > tracks.time[last]:
        return
    before = first
    after = last
    while after - before > 1:
        middle = (before + after) // 2
        if tracks.time[middle] <= time:
            before = middle
        else:
            after = middle
    if tracks.time[after] <= time:
        before = after
    span = tracks.time[after] - tracks.time[before]
    elapsed = time - tracks.time[before]
    if elapsed > 0.0 and span > target.max_gap:
        return
    share = elapsed / span if span > 0.0 else 0.0
    target.x = tracks.x[before] + share * (tracks.x[after] - tracks.x[before])
    target.y = tracks.y[before] + share * (tracks.y[after] - tracks.y[before])
    target.present = 1
