"""The paper's step in JAX: one replicate as a function, mapped over replicates and scanned over steps, all compiled."""

import os

os.environ["JAX_ENABLE_X64"] = "1"  # before jax is imported: it computes in single precision otherwise
os.environ["JAX_PLATFORMS"] = "cpu"

from typing import NamedTuple

import jax
import jax.numpy as jnp
import numpy as np

import paper as p
from paper import SEED, C, K, N, measure, start

REPLICATES = 64
HALVINGS = 18  # two millionths of the square


class State(NamedTuple):
    """All that changes in a replicate."""

    x: jax.Array  # (N, 2)
    v: jax.Array
    a: jax.Array  # (N,)
    reach: jax.Array  # (N,) squared distance within which the K nearest were
    target: jax.Array  # (2,)
    waypoint: jax.Array
    heading: jax.Array
    age: jax.Array
    key: jax.Array


def nearest(squares: jax.Array, before: jax.Array) -> jax.Array:
    """Within which the K nearest lie, by halving: four times faster here than jax.lax.top_k or sorting."""

    def enough(reach: jax.Array) -> jax.Array:
        return (squares <= reach[:, None]).sum(axis=1) >= K

    def halve(_: int, ends: tuple[jax.Array, jax.Array]) -> tuple[jax.Array, jax.Array]:
        middle = (ends[0] + ends[1]) / 2
        return jnp.where(enough(middle), ends[0], middle), jnp.where(enough(middle), middle, ends[1])

    low, high = 0.75 * before, 1.25 * before  # neighborhoods change slowly
    ends = jnp.where(enough(low), 0.0, low), jnp.where(enough(high), high, 1000.0)
    return jax.lax.fori_loop(0, HALVINGS, halve, ends)[1]


def step(state: State, _: None) -> tuple[State, jax.Array]:
    """One step of one replicate, and whether anybody was on target."""
    x, v, a, reach, target, waypoint, heading, age, key = state
    key, for_agents, for_target = jax.random.split(key, 3)
    apart = x[:, None] - x[None]
    squares = (apart**2).sum(axis=2) + jnp.diag(jnp.full(N, jnp.inf))
    reach = nearest(squares, reach)
    near = squares <= reach[:, None]
    on_target = ((x - target) ** 2).sum(axis=1) <= p.RHO**2

    heard = near & on_target
    best = jnp.where(heard, squares, jnp.inf).argmin(axis=1)
    follows = heard.any(axis=1) & ~on_target
    pull = jnp.where(follows, C * jax.random.uniform(for_agents, (N,)), 0.0)[:, None] * (x[best] - x)

    tracking = follows | on_target
    a = a + jnp.where(tracking, -p.A_STEP * (a > p.A_MIN), p.A_STEP * (a < p.A_MAX))
    weight = jnp.where(near, 1.0 / (squares**3 * jnp.sqrt(squares)), 0.0)  # r^-6 along a vector of length r
    wanted = p.OMEGA * v + pull + a[:, None] ** 6 * (weight[..., None] * apart).sum(axis=1)

    wanted *= jnp.minimum(1.0, p.MAX_SPEED / jnp.maximum(jnp.hypot(*wanted.T), 1e-99))[:, None]
    reached = jnp.clip(x + wanted, -p.WALL, p.WALL)
    v = jnp.where(reached != x + wanted, reached - x, wanted)

    turn = jnp.arctan2(*(waypoint - target)[::-1]) - heading
    heading += jnp.clip((turn + jnp.pi) % (2 * jnp.pi) - jnp.pi, -p.TURN, p.TURN)
    target += p.SPEED * jnp.array([jnp.cos(heading), jnp.sin(heading)])
    done = (jnp.hypot(*(waypoint - target)) < p.REACHED) | (age + 1 >= p.PATIENCE)
    anywhere = jax.random.uniform(for_target, (2,), minval=-p.MARGIN, maxval=p.MARGIN)
    waypoint = jnp.where(done, anywhere, waypoint)
    state = State(reached, v, a, reach, target, waypoint, heading, jnp.where(done, 0, age + 1), key)
    return state, on_target.any()


STEPS = 20


@jax.jit
def steps(state: State) -> tuple[State, jax.Array]:
    """STEPS steps of all replicates, and at how many of them anybody was on target."""
    state, found = jax.vmap(lambda each: jax.lax.scan(step, each, None, length=STEPS))(state)
    return state, found.sum()


def advance(_: int) -> int:
    """The next STEPS steps."""
    global state
    state, found = steps(state)
    return int(found)


if __name__ == "__main__":
    zeros, agents = jnp.zeros((REPLICATES, 2)), jnp.ones((REPLICATES, N))
    state = State(
        jnp.asarray(start(REPLICATES, np.random.default_rng(SEED))), jnp.zeros((REPLICATES, N, 2)),
        p.A_START * agents, 50.0 * agents, zeros, zeros, jnp.zeros(REPLICATES), jnp.zeros(REPLICATES, int),
        jax.random.split(jax.random.key(SEED), REPLICATES),
    )  # fmt: skip
    measure(advance, STEPS, REPLICATES, str(state.x.dtype).replace("float", "f"), jax.__version__)
