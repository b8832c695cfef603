"""Targets that surface and dive: nobody can detect one that is down."""

from shoal.compiler.kernel import kernel


@kernel
def surface_or_dive(target, time):
    """Set whether a target is up at a time [s]: for surface_time of every surface_time + dive_time."""
    if target.dive_time > 0.0:
        cycle = target.surface_time + target.dive_time
        into = (time + target.dive_phase * cycle) % cycle
        target.present = 1 if into < target.surface_time else 0
