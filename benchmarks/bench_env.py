"""An environment beside the engine: time of an agent-step through VectorEnv, with observations, in turn with `advance`.

    python benchmarks/bench_env.py [--rounds N]

Both have the paper's scenario with k = 8, in one process on one core, and the fastest short stretch of processor time
counts. The engine decides by the paper's strategy; in the environment velocities come from outside.
"""

import argparse
import time

import numpy as np

import shoal
from shoal.learn.env import Observe, VectorEnv

K, SWARMS, STEPS = 8, 24, 480  # steps of a stretch, of all swarms together


def main() -> None:
    """Print microseconds of a step of 50 agents, and the ratio."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=50)
    rounds = parser.parse_args().rounds
    scenario = shoal.load("oceans2020", neighbors=K)
    simulation = shoal.Simulation(scenario)
    env = VectorEnv(scenario, SWARMS, observe=Observe(reports=K), copy=False)
    env.reset(seed=1)
    chance = np.random.default_rng(1)
    actions = chance.uniform(-1.0, 1.0, (STEPS // SWARMS, *env.action_space.shape)).astype(np.float32)
    best = {"engine": np.inf, "environment": np.inf}
    for _ in range(rounds + 1):
        begun = time.process_time()
        simulation.advance(STEPS)
        between = time.process_time()
        for action in actions:
            env.step(action)
        ended = time.process_time()
        best["engine"] = min(best["engine"], (between - begun) / STEPS)
        best["environment"] = min(best["environment"], (ended - between) / STEPS)
    for name, seconds in best.items():
        rate = scenario.agents / seconds / 1e6
        print(f"{name:12} {1e6 * seconds:6.2f} us a step of {scenario.agents} agents, {rate:.1f} M agent-steps/s")
    print(f"ratio        {best['environment'] / best['engine']:6.2f}")


if __name__ == "__main__":
    main()
