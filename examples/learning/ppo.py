"""PPO with one network for all buoys, on 16 swarms at a time. Needs JAX, which Shoal does not: pip install jax.

    python examples/learning/ppo.py [seconds]

It writes network_as_strategy.npz, with which network_as_strategy.py, beside it, is a strategy like any other.
Schulman et al., "Proximal Policy Optimization Algorithms", arXiv 1707.06347; every buoy of every swarm is a sample.
"""

import sys
import time
from functools import partial
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np

import shoal
from shoal.learn.env import Observe, VectorEnv

SWARMS, ROLLOUT, EPOCHS, BATCH = 16, 64, 4, 6400
DISCOUNT, SMOOTHING, CLIP, RATE, ENTROPY = 0.97, 0.95, 0.2, 5e-4, 1e-3
HIDDEN = 64
FILE = Path(__file__).with_name("network_as_strategy.npz")


def network(key, sizes):
    """Weights and biases of each layer."""
    keys = jax.random.split(key, len(sizes) - 1)
    shapes = zip(keys, sizes[:-1], sizes[1:], strict=True)
    return [(jax.random.normal(each, (a, b)) / np.sqrt(a), jnp.zeros(b)) for each, a, b in shapes]


def forward(layers, x):
    for weights, bias in layers[:-1]:
        x = jnp.tanh(x @ weights + bias)
    weights, bias = layers[-1]
    return x @ weights + bias


def log_chance(policy, known, done):
    """How likely a buoy that knows this does that, and its mean: a normal distribution around the actor's output."""
    spread, mean = jnp.exp(policy["spread"]), forward(policy["actor"], known)
    return (-0.5 * ((done - mean) / spread) ** 2 - policy["spread"]).sum(-1)


@jax.jit
def act(policy, known, key):
    """What each buoy does, how likely that was, and what it thinks its state is worth."""
    mean = forward(policy["actor"], known)
    done = mean + jnp.exp(policy["spread"]) * jax.random.normal(key, mean.shape)
    return done, log_chance(policy, known, done), forward(policy["critic"], known)[..., 0]


def rollout(env, policy, key):
    """What all buoys knew, did, how likely that was, how much better it was than thought, and its worth: (S, ...).

    Also the share of steps with a buoy on target.
    """
    on_target = 0.0
    episodes, rows = env.episodes, []
    for each in jax.random.split(key, ROLLOUT):
        known = episodes.observations.copy()
        done, chance, worth = act(policy, known, each)
        _, _, _, truncated, _ = env.step(np.clip(done, -1.0, 1.0))
        on_target += env.episodes.terms[:, 0, 0].mean() / ROLLOUT
        rows.append((known, done, chance, worth, episodes.rewards.copy(), truncated[:, None]))
    known, done, chance, worth, rewards, ends = (np.stack(column) for column in zip(*rows, strict=True))
    after, gain, gains = np.asarray(act(policy, episodes.observations, key)[2]), 0.0, np.zeros_like(worth)
    for t in reversed(range(ROLLOUT)):  # an episode that is cut off is worth what its last state is thought to be
        after = np.where(ends[t], worth[t], after)
        gain = rewards[t] + DISCOUNT * after - worth[t] + DISCOUNT * SMOOTHING * ~ends[t] * gain
        gains[t], after = gain, worth[t]
    samples = (known, done, chance, gains, gains + worth)
    return tuple(each.reshape(-1, *each.shape[3:]) for each in samples), on_target


def loss(policy, known, done, chance, gains, returns):
    """The clipped objective, the error of the critic, and a little for chance."""
    ratio = jnp.exp(log_chance(policy, known, done) - chance)
    actor = -jnp.minimum(ratio * gains, jnp.clip(ratio, 1 - CLIP, 1 + CLIP) * gains).mean()
    critic = ((forward(policy["critic"], known)[..., 0] - returns) ** 2).mean()
    return actor + 0.5 * critic - ENTROPY * policy["spread"].sum()


@partial(jax.jit, donate_argnums=(0, 1))
def improve(policy, moments, samples):
    """A step of Adam, with gradients of a norm of 0.5 at most."""
    gradients = jax.grad(loss)(policy, *samples)
    norm = jnp.sqrt(sum((each**2).sum() for each in jax.tree.leaves(gradients)))
    gradients = jax.tree.map(lambda each: each * jnp.minimum(1.0, 0.5 / (norm + 1e-9)), gradients)
    first, second, count = moments
    first = jax.tree.map(lambda m, g: 0.9 * m + 0.1 * g, first, gradients)
    second = jax.tree.map(lambda v, g: 0.999 * v + 0.001 * g**2, second, gradients)
    count += 1
    rate = RATE * jnp.sqrt(1 - 0.999**count) / (1 - 0.9**count)
    policy = jax.tree.map(lambda p, m, v: p - rate * m / (jnp.sqrt(v) + 1e-8), policy, first, second)
    return policy, (first, second, count)


def learn(policy, moments, samples, rng):
    """Some epochs over all samples, in batches."""
    known, done, chance, gains, returns = samples
    gains = (gains - gains.mean()) / (gains.std() + 1e-8)
    for _ in range(EPOCHS):
        for chosen in rng.permutation(len(known)).reshape(-1, BATCH):
            batch = tuple(each[chosen] for each in (known, done, chance, gains, returns))
            policy, moments = improve(policy, moments, batch)
    return policy, moments


def time_on_target(env, policy, steps=500):
    """Mean over all swarms of a fresh seed, without noise."""
    env.reset(seed=1000)
    total, mean = 0.0, jax.jit(forward)
    for _ in range(steps):
        env.step(np.clip(mean(policy["actor"], env.episodes.observations), -1.0, 1.0))
        total += env.episodes.terms[:, 0, 0].mean()
    return total / steps


def save(policy, scenario):
    """Write the actor's layers, and what counted as 1, for network_as_strategy.py."""
    layers = {}
    for n, (weights, bias) in enumerate(policy["actor"]):
        layers |= {f"w{n}": weights, f"b{n}": bias}
    length = max(scenario.area.width, scenario.area.height) / 2
    np.savez(FILE, length=length, speed=max(fleet.max_speed for fleet in scenario.fleets), **layers)


def main(seconds):
    print("compiling: a minute or more the first time", flush=True)
    scenario = shoal.load("oceans2020", neighbors=8, steps=1000)
    reward = {"time_on_target": 0.2, "engaged": 1.0}
    env = VectorEnv(scenario, SWARMS, observe=Observe(reports=8), reward=reward, copy=False)
    knows, does = env.single_observation_space.shape[1], env.single_action_space.shape[1]
    key, rng = jax.random.key(1), np.random.default_rng(1)
    key, one, other = jax.random.split(key, 3)
    policy = {
        "actor": network(one, (knows, HIDDEN, HIDDEN, does)),
        "critic": network(other, (knows, HIDDEN, HIDDEN, 1)),
        "spread": jnp.full(does, -0.5),
    }
    moments = (jax.tree.map(jnp.zeros_like, policy), jax.tree.map(jnp.zeros_like, policy), jnp.array(0.0))
    print(f"untrained: {time_on_target(env, policy):.3f} of the time on target", flush=True)
    env.reset(seed=1)
    begun, rounds = time.process_time(), 0
    while time.process_time() - begun < seconds:
        key, each = jax.random.split(key)
        samples, on_target = rollout(env, policy, each)
        policy, moments = learn(policy, moments, samples, rng)
        rounds += 1
        if rounds % 10 == 0:
            used = time.process_time() - begun
            print(f"{used:.0f} of {seconds:g} s: {rounds} updates, {on_target:.3f} on target, with noise", flush=True)
    save(policy, scenario)
    steps = rounds * ROLLOUT * SWARMS * scenario.agents
    print(f"trained on {steps:,} steps of buoys: {time_on_target(env, policy):.3f}; weights: {FILE}")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 120.0)
