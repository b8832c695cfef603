"""PPO with one policy for all buoys, on 16 swarms at a time. Needs PyTorch, which Shoal does not: pip install torch.

    python examples/learning/ppo.py [seconds]

Schulman et al., "Proximal Policy Optimization Algorithms", arXiv 1707.06347; every buoy of every swarm is a sample.
"""

import sys
import time

import torch
from torch import nn

import shoal
from shoal.learn.env import Observe, VectorEnv

SWARMS, ROLLOUT, EPOCHS, BATCH = 16, 64, 4, 6400
DISCOUNT, SMOOTHING, CLIP, RATE, ENTROPY = 0.97, 0.95, 0.2, 3e-4, 1e-3


class Policy(nn.Module):
    """What a buoy knows in; the mean of what it does and what that is worth out."""

    def __init__(self, knows: int, does: int) -> None:
        super().__init__()
        self.actor = nn.Sequential(nn.Linear(knows, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, does))
        self.critic = nn.Sequential(nn.Linear(knows, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), nn.Linear(64, 1))
        self.spread = nn.Parameter(torch.full((does,), -0.5))

    def around(self, known: torch.Tensor) -> torch.distributions.Normal:
        return torch.distributions.Normal(self.actor(known), self.spread.exp())

    def worth(self, known: torch.Tensor) -> torch.Tensor:
        return self.critic(known).squeeze(-1)


def rollout(env: VectorEnv, policy: Policy) -> tuple[torch.Tensor, ...]:
    """What all buoys knew, did, how likely that was, and how much better than thought it turned out: (T E N, ...)."""
    episodes = env.episodes
    seen = torch.from_dlpack(episodes.observations)  # no copy: the engine writes here
    earned = torch.from_dlpack(episodes.rewards)
    known, done, chance, rewards, values, ends = [], [], [], [], [], []
    for _ in range(ROLLOUT):
        with torch.no_grad():
            around = policy.around(seen)
            action = around.sample()
            known.append(seen.clone())
            done.append(action)
            chance.append(around.log_prob(action).sum(-1))
            values.append(policy.worth(seen))
        _, _, _, truncated, _ = env.step(action.clamp(-1.0, 1.0).numpy())
        rewards.append(earned.float())  # a copy
        ends.append(torch.from_numpy(truncated)[:, None].float())
    with torch.no_grad():
        after = policy.worth(seen)
    gain, gains = torch.zeros_like(after), []
    for t in reversed(range(ROLLOUT)):  # an episode that is cut off is worth what its last state is thought to be
        better = rewards[t] + DISCOUNT * after * (1 - ends[t]) + DISCOUNT * values[t] * ends[t] - values[t]
        gain = better + DISCOUNT * SMOOTHING * (1 - ends[t]) * gain
        gains.insert(0, gain)
        after = values[t]
    parts = (torch.stack(each) for each in (known, done, chance, gains, values))
    return tuple(part.reshape(-1, *part.shape[3:]) for part in parts)


def learn(policy: Policy, optimizer: torch.optim.Optimizer, samples: tuple[torch.Tensor, ...]) -> None:
    """Some epochs of clipped steps."""
    known, done, chance, gains, values = samples
    returns = gains + values
    gains = (gains - gains.mean()) / (gains.std() + 1e-8)
    for _ in range(EPOCHS):
        for chosen in torch.randperm(len(known)).split(BATCH):
            around = policy.around(known[chosen])
            ratio = (around.log_prob(done[chosen]).sum(-1) - chance[chosen]).exp()
            clipped = ratio.clamp(1 - CLIP, 1 + CLIP)
            actor = -torch.min(ratio * gains[chosen], clipped * gains[chosen]).mean()
            critic = (policy.worth(known[chosen]) - returns[chosen]).square().mean()
            loss = actor + 0.5 * critic - ENTROPY * around.entropy().sum(-1).mean()
            optimizer.zero_grad()
            loss.backward()
            nn.utils.clip_grad_norm_(policy.parameters(), 0.5)
            optimizer.step()


def time_on_target(env: VectorEnv, policy: Policy, steps: int = 500) -> float:
    """Mean over all swarms from a fresh seed, without noise."""
    env.reset(seed=1000)
    seen, total = torch.from_dlpack(env.episodes.observations), 0.0
    for _ in range(steps):
        with torch.no_grad():
            env.step(policy.actor(seen).clamp(-1.0, 1.0).numpy())
        total += env.episodes.terms[:, 0, 0].mean()
    return total / steps


def main(seconds: float) -> None:
    torch.manual_seed(1)
    torch.set_num_threads(1)
    reward = {"time_on_target": 0.2, "engaged": 1.0}
    env = VectorEnv(
        shoal.load("oceans2020", neighbors=8, steps=1000), SWARMS, observe=Observe(reports=8), reward=reward, copy=False
    )
    knows, does = env.single_observation_space.shape[1], env.single_action_space.shape[1]
    policy = Policy(knows, does)
    optimizer = torch.optim.Adam(policy.parameters(), RATE)
    print(f"untrained: {time_on_target(env, policy):.3f} of the time on target")
    env.reset(seed=1)
    begun, rounds = time.monotonic(), 0
    while time.monotonic() - begun < seconds:
        learn(policy, optimizer, rollout(env, policy))
        rounds += 1
    samples = rounds * ROLLOUT * SWARMS * env.episodes.scenario.agents
    print(f"trained on {samples:,} steps of buoys: {time_on_target(env, policy):.3f}")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 120.0)
