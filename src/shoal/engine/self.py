"""What agent i knows of itself, as its strategy sees it."""

from shoal.compiler.kernel import kernel
from shoal.core.messages import Briefing, Own, Truth
from shoal.strategies import asking
from shoal.world.targets.dispatch import heading_to


@kernel
def own(world, swarm, targets, params, number, i):
    """Return Own of agent i at step `number`."""
    briefing = Briefing(
        world.agents,
        world.clamp_x,
        world.clamp_y,
        swarm.sensor_radius[i] + world.target_radius,
        swarm.share_end[i - 1] if i > 0 else 0.0,
        swarm.share_end[i],
        world.coastal,
        swarm.station_x[i],
        swarm.station_y[i],
    )
    return Own(
        i,
        swarm.fix_x[i],
        swarm.fix_y[i],
        swarm.vx[i],
        swarm.vy[i],
        swarm.on_target[i],
        swarm.max_speed[i],
        world.time_step,
        number * world.time_step,
        swarm.fleet[i],
        briefing,
        _truth(swarm.x[i], swarm.y[i], targets, params),
        swarm.drift_x[i],
        swarm.drift_y[i],
        swarm.aground[i],
    )


@kernel
def _truth(x, y, targets, params):
    """The nearest target present, for references; nothing for the others."""
    truth = Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if asking.is_informed(params):
        nearest = 1e300
        for target in targets:
            dx = target.x - x
            dy = target.y - y
            square = dx * dx + dy * dy
            if target.present and square < nearest:
                nearest = square
                vx, vy, goal_x, goal_y = heading_to(target)
                truth = Truth(True, target.x, target.y, vx, vy, goal_x, goal_y)
    return truth
