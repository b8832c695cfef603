"""Evolve a policy on 16 swarms at a time, each with weights of its own, by the environment alone: no gradients.

    python examples/learning/evolve.py [generations]

A (mu, lambda) evolution strategy of 30 lines; `shoal learn` does it better, and writes a strategy file.
"""

import sys

import numpy as np

import shoal
from shoal.learn.env import Act, Observe, VectorEnv

SWARMS, PARENTS, STEPS, SPREAD = 16, 4, 1000, 0.2


def actions(weights, observations):
    """a_R and attraction of every buoy, linear in what it knows and cut to -1 to 1: (E, N, 2)."""
    return np.tanh(np.einsum("enf,efa->ena", observations, weights[:, :-1]) + weights[:, None, -1])


def scores(env, weights, seeds):
    """Time on target of each swarm, (E,)."""
    observations, _ = env.reset(seed=seeds)
    total = np.zeros(SWARMS)
    for _ in range(STEPS):
        observations, rewards, *_ = env.step(actions(weights, observations))
        total += rewards
    return total / STEPS


def fresh(env, weights):
    """The mean over swarms that all have these weights, each with chance of its own, which no generation had."""
    return scores(env, np.tile(weights, (SWARMS, 1, 1)), 7).mean()


def main(generations):
    print("compiling: a minute or two the first time", flush=True)
    scenario = shoal.load("oceans2020", neighbors=8, steps=STEPS + 1)
    knows = Observe(own=("on_target", "max_speed"), report=("on_target",))
    env = VectorEnv(scenario, SWARMS, observe=knows, act=Act(kind="repulsion"))
    rng = np.random.default_rng(1)
    center = np.zeros((env.single_observation_space.shape[1] + 1, 2))
    for generation in range(generations):
        tried = center + SPREAD * rng.standard_normal((SWARMS, *center.shape))
        found = scores(env, tried, [100 + generation] * SWARMS)  # the same chance for all
        center = tried[np.argsort(-found)[:PARENTS]].mean(axis=0)
        print(f"generation {generation}: {found.mean():.3f} on target, its best {found.max():.3f}", flush=True)
    before, after = (fresh(env, each) for each in (0 * center, center))
    print(f"a fresh seed: {before:.3f} before, {after:.3f} after")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 15)
