"""Shoal's learning environment beside the same one in VMAS: time of an agent-step with observations, in turn.

    pip install torch vmas
    python benchmarks/bench_vmas.py [--rounds N]

Both have 50 agents that hear of their k = 8 nearest, actions are velocities, the reward is whether the target is
watched; one core each, the fastest stretch of processor time counts. VMAS is fastest with many swarms at once: each has
the best of the numbers tried.
"""

import argparse
import sys
import time
from pathlib import Path

import numpy as np
import torch
import vmas

import shoal
from shoal.learn.env import Observe, VectorEnv

sys.path.insert(0, str(Path(__file__).parent / "peers"))
from vmas_env import AGENTS, K, Swarm

SWARMS = (24, 256, 1024)
AT_ONCE = 9600  # steps of a stretch, of all swarms together
CHOICES = 10  # sets of actions, in turn


def shoal_stretch(swarms: int) -> float:
    """Seconds of an agent-step."""
    env = VectorEnv(shoal.load("oceans2020", neighbors=K), swarms, observe=Observe(reports=K), copy=False)
    env.reset(seed=1)
    chance = np.random.default_rng(1)
    actions = chance.uniform(-1.0, 1.0, (CHOICES, *env.action_space.shape)).astype(np.float32)
    env.step(actions[0])
    begun = time.process_time()
    for step in range(AT_ONCE // swarms):
        env.step(actions[step % CHOICES])
    return (time.process_time() - begun) / (AT_ONCE // swarms * swarms * AGENTS)


def vmas_stretch(swarms: int) -> float:
    """Seconds of an agent-step."""
    env = vmas.make_env(Swarm(), num_envs=swarms, device="cpu", continuous_actions=True, seed=1)
    actions = [[2 * torch.rand(swarms, 2) - 1 for _ in range(AGENTS)] for _ in range(CHOICES)]
    env.step(actions[0])
    begun = time.process_time()
    steps = max(AT_ONCE // swarms // 8, 4)  # a stretch about as long as the other's, in seconds
    for step in range(steps):
        env.step([each.clone() for each in actions[step % CHOICES]])
    return (time.process_time() - begun) / (steps * swarms * AGENTS)


def main() -> None:
    """Print both, and the ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    rounds = parser.parse_args().rounds
    torch.set_num_threads(1)
    best: dict[str, tuple[float, int]] = {}
    for swarms in SWARMS * rounds:
        for name, stretch in (("Shoal", shoal_stretch), ("VMAS", vmas_stretch)):
            best[name] = min(best.get(name, (np.inf, 0)), (stretch(swarms), swarms))
    for name, (seconds, swarms) in best.items():
        print(f"{name:6} {1e9 * seconds:8.0f} ns an agent-step, {1e-6 / seconds:6.2f} M/s, with {swarms} swarms")
    print(f"ratio  {best['VMAS'][0] / best['Shoal'][0]:8.1f}")


if __name__ == "__main__":
    main()
