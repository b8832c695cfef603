"""States small enough for a hand, for tests of the oracle."""

import dataclasses
import math

import numpy as np

from oracle import Model, State, random_start, run, step

FAR = (100.0, 0.0)  # a target nobody detects
EAST = (1.0, 0.0)

STILL = {"a_up": 0.0, "a_down": 0.0}  # repulsion strengths that stay what they are
LONE = {"x": [(0, 0), (1e9, 0)], "v": [(3, 4), (0.3, 0.4)]}  # two agents too far apart to push
PUSHED = {"x": [(0, 0), (2, 0), (9, 9)], "v": [(1, 0), (0, 0), (0, 0)]}  # agent 0 runs at agent 1
TURNING = {"turn_max": math.radians(20), "target_speed": 0.5}


def model(n=2, k=1, max_speed=100.0, **switches):
    """n agents whose top speed and arena do not interfere, unless asked to."""
    switches = {"clamp_x": 1e12, "clamp_y": 1e12, **switches}
    return Model(max_speed=np.broadcast_to(max_speed, n), k=k, **switches)


def state(x, v=None, a=1.0, target=FAR, heading=EAST, waypoint=(200.0, 0.0), steps_on_waypoint=0):
    x = np.array(x, dtype=float)
    return State(
        x=x,
        v=np.zeros_like(x) if v is None else np.array(v, dtype=float),
        a=np.broadcast_to(np.array(a, dtype=float), len(x)).copy(),
        target=np.array(target, dtype=float),
        heading=np.array(heading, dtype=float),
        waypoint=np.array(waypoint, dtype=float),
        steps_on_waypoint=steps_on_waypoint,
    )


def advance(model, state, r=0.0, new_waypoint=(7.0, 7.0)):
    shape = (model.n, 2) if model.per_axis_r else (model.n,)
    return step(model, state, np.broadcast_to(r, shape), np.array(new_waypoint))


def spread(model, seed=0, steps=30):
    """A state in the middle of a run, where everything happens."""
    rng = np.random.default_rng(seed)
    return run(model, random_start(model, rng), steps, rng).state


def assert_same(one, other, atol=0.0):
    for field in dataclasses.fields(one):
        np.testing.assert_allclose(
            getattr(one, field.name),
            getattr(other, field.name),
            rtol=0,
            atol=atol,
            err_msg=field.name,
        )
