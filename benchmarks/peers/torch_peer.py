"""The paper's step in PyTorch: replicates as a batch, as in VMAS and other simulators that are written in it."""

import numpy as np
import torch

from paper import A_MAX, A_MIN, A_START, A_STEP, MAX_SPEED, OMEGA, RHO, SEED, WALL, C, K, N, Target, measure, start

REPLICATES = 32

torch.set_num_threads(1)
torch.set_default_dtype(torch.float64)
torch.set_grad_enabled(False)
FASTEST = torch.from_numpy(MAX_SPEED)
ITSELF = torch.diag(torch.full((N,), torch.inf))


class Swarm:
    """Positions and velocities (R, N, 2), repulsion strengths (R, N), and the targets."""

    def __init__(self) -> None:
        chance = np.random.default_rng(SEED)
        self.x = torch.from_numpy(start(REPLICATES, chance))
        self.v = torch.zeros_like(self.x)
        self.a = torch.full((REPLICATES, N), A_START)
        self.target = Target(REPLICATES, chance)

    def step(self) -> int:
        """Make one step, and return in how many replicates anybody was on target."""
        x = self.x
        squares = (x[:, :, None, 0] - x[:, None, :, 0]) ** 2 + (x[:, :, None, 1] - x[:, None, :, 1]) ** 2 + ITSELF
        squares, near = squares.topk(K, dim=2, largest=False, sorted=False)
        on_target = ((x - torch.from_numpy(self.target.x)[:, None]) ** 2).sum(dim=2) <= RHO**2
        replicate = torch.arange(REPLICATES)[:, None, None]
        heard = on_target[replicate, near]

        nearest = torch.where(heard, squares, torch.inf).argmin(dim=2, keepdim=True)
        best = near.gather(2, nearest)[..., 0]
        follows = heard.any(dim=2) & ~on_target
        pull = x[replicate[..., 0], best] - x
        pull *= torch.where(follows, C * torch.rand(REPLICATES, N), 0.0)[..., None]

        tracking = follows | on_target
        self.a += A_STEP * (~tracking & (self.a < A_MAX)) - A_STEP * (tracking & (self.a > A_MIN))
        weight = squares**-3.5  # r^-6 along a vector of length r
        push = weight.sum(dim=2)[..., None] * x - (weight[..., None] * x[replicate, near]).sum(dim=2)
        wanted = OMEGA * self.v + pull + (self.a**6)[..., None] * push

        wanted *= (FASTEST / wanted.norm(dim=2).clamp(min=1e-99)).clamp(max=1.0)[..., None]
        reached = (x + wanted).clamp(-WALL, WALL)
        self.x, self.v = reached, torch.where(reached != x + wanted, reached - x, wanted)
        self.target.move()
        return int(on_target.any(dim=1).sum())


if __name__ == "__main__":
    torch.manual_seed(SEED)
    swarm = Swarm()
    measure(lambda steps: sum(swarm.step() for _ in range(steps)), 20, REPLICATES, "f64", torch.__version__)
