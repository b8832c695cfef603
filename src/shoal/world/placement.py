"""Where agents start, at rest."""

from shoal.compiler.kernel import kernel
from shoal.core.draws import START_STEP, TARGET_STREAM, split, uniform
from shoal.world.sea.land import afloat, anywhere_afloat, clearance

PLACES = ("uniform", "center", "corner", "arena")
_CENTER = 1
_CORNER = 2
_ARENA = 3
_PLACEMENT = 1 << 20  # a purpose that no strategy draws for
_SIDE = (1 << 20) + 1
_CLUSTER = 0.1  # side of the cluster, as a share of the arena's


@kernel
def start(where, x, y):
    """Where an agent starts, as shares of half the sides of where it may go, from two numbers uniform in [-1, 1).

    where : index into PLACES: all over, in a tenth of the sides at the center, or in a corner
    """
    if where == _CENTER:
        return _CLUSTER * x, _CLUSTER * y
    if where == _CORNER:
        return _CLUSTER * (x + 1.0) - 1.0, _CLUSTER * (y + 1.0) - 1.0
    return x, y


@kernel
def place(swarm, world, places, run_key):
    """Scatter agents over where they may go, or over the whole arena, as in the runs that were published.

    Of the latter the wall puts those outside it inside in step 1.

    places : index into PLACES of each fleet
    """
    for i in range(world.agents):
        draw = split(split(split(run_key, START_STEP), i), _PLACEMENT)
        where = places[swarm.fleet[i]]
        x, y = start(where, 2.0 * uniform(draw, 0) - 1.0, 2.0 * uniform(draw, 1) - 1.0)
        swarm.x[i] = (world.half_x if where == _ARENA else world.clamp_x) * x
        swarm.y[i] = (world.half_y if where == _ARENA else world.clamp_y) * y


@kernel
def launch(swarm, i, shore, where, world, run_key):
    """Put an agent that would start on land at sea: another place by chance, all over; else the nearest water."""
    if clearance(shore, swarm.x[i], swarm.y[i]) > 0.0:
        return
    if where in (_CENTER, _CORNER):
        swarm.x[i], swarm.y[i] = afloat(shore, swarm.x[i], swarm.y[i])
    else:
        draw = split(split(split(run_key, START_STEP), i), _PLACEMENT)
        x, y = anywhere_afloat(shore, world.clamp_x, world.clamp_y, draw)
        swarm.x[i], swarm.y[i] = afloat(shore, x, y)


@kernel
def draw_sides(swarm, targets, world, run_key):
    """Let the wind push each to the left or the right of its own direction, by chance, half of them each."""
    for i in range(world.agents):
        if uniform(split(split(run_key, START_STEP), i), _SIDE) < 0.5:
            swarm.leeway[i, 3] = -swarm.leeway[i, 3]
    for j in range(targets.size):
        if uniform(split(split(run_key, START_STEP), TARGET_STREAM + j), _SIDE) < 0.5:
            targets[j].leeway_sine = -targets[j].leeway_sine
