"""The paper's step in NumPy: all replicates in one array, the k nearest by partition."""

import numpy as np

from paper import A_MAX, A_MIN, A_START, A_STEP, MAX_SPEED, OMEGA, RHO, SEED, WALL, C, K, N, Target, measure, start

REPLICATES = 8  # more do not stay in the cache


class Swarm:
    """Positions and velocities (R, N, 2), repulsion strengths (R, N), and the targets."""

    def __init__(self) -> None:
        self.chance = np.random.default_rng(SEED)
        self.x = start(REPLICATES, self.chance)
        self.v = np.zeros_like(self.x)
        self.a = np.full((REPLICATES, N), A_START)
        self.target = Target(REPLICATES, self.chance)

    def step(self) -> int:
        """Make one step, and return in how many replicates anybody was on target."""
        x, y = self.x[..., 0], self.x[..., 1]
        dx, dy = x[:, :, None] - x[:, None, :], y[:, :, None] - y[:, None, :]
        squares = dx * dx + dy * dy
        squares[:, np.arange(N), np.arange(N)] = np.inf
        near = np.argpartition(squares, K - 1, axis=2)[..., :K]
        squares = np.take_along_axis(squares, near, axis=2)
        on_target = ((self.x - self.target.x[:, None]) ** 2).sum(axis=2) <= RHO**2
        heard = np.take_along_axis(on_target[:, None].repeat(N, axis=1), near, axis=2)

        distance = np.where(heard, squares, np.inf)
        best = np.take_along_axis(near, distance.argmin(axis=2)[..., None], axis=2)
        follows = heard.any(axis=2) & ~on_target
        pull = np.take_along_axis(self.x, best, axis=1) - self.x
        pull *= np.where(follows, C * self.chance.random((REPLICATES, N)), 0.0)[..., None]

        tracking = follows | on_target
        rises, falls = ~tracking & (self.a < A_MAX), tracking & (self.a > A_MIN)
        self.a += A_STEP * rises - A_STEP * falls
        square_square = squares * squares
        weight = 1.0 / (square_square * squares * np.sqrt(squares))  # r^-7: r^-6 along a vector of length r
        push = [(weight * np.take_along_axis(each, near, axis=2)).sum(axis=2) for each in (dx, dy)]
        wanted = OMEGA * self.v + pull + self.a[..., None] ** 6 * np.stack(push, axis=2)

        speed = np.sqrt((wanted**2).sum(axis=2))
        wanted *= np.minimum(1.0, MAX_SPEED / np.maximum(speed, 1e-99))[..., None]
        reached = np.clip(self.x + wanted, -WALL, WALL)
        self.x, self.v = reached, np.where(reached != self.x + wanted, reached - self.x, wanted)
        self.target.move()
        return int(on_target.any(axis=1).sum())


if __name__ == "__main__":
    swarm = Swarm()
    measure(lambda steps: sum(swarm.step() for _ in range(steps)), 100, REPLICATES, "f64", np.__version__)
