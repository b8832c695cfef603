"""What a sea does to targets: water and wind carry them, land stops them."""

from shoal.compiler.kernel import kernel
from shoal.world.sea.land import sailed, seaward
from shoal.world.sea.sea import Leeway, carried, span


@kernel
def drift(target, sea, world, number):
    """Let water and wind add to its displacement in step `number`; what disturbances add is there already."""
    step = span(sea, number, world.time_step)
    wind = Leeway(target.leeway_slope, target.leeway_offset, target.leeway_cosine, target.leeway_sine)
    own_x, own_y = target.speed * target.heading_x, target.speed * target.heading_y
    drift_x, drift_y = carried(sea, target.x, target.y, own_x, own_y, step, wind)
    target.drift_x = drift_x + (target.drift_x if world.disturbed else 0.0)
    target.drift_y = drift_y + (target.drift_y if world.disturbed else 0.0)


@kernel
def stop_at_land(target, shore, x, y):
    """Let a target that was at (x, y) end at the shore if it ran into it, and head off from there."""
    if target.fixes > 0:
        return  # a recorded one went where it went
    free_x, free_y = target.x, target.y
    target.x, target.y = sailed(shore, x, y, free_x, free_y)
    if target.x != free_x or target.y != free_y:
        out_x, out_y = seaward(shore, target.x, target.y)
        into = target.heading_x * out_x + target.heading_y * out_y
        if into < 0.0:
            target.heading_x -= 2.0 * into * out_x
            target.heading_y -= 2.0 * into * out_y
