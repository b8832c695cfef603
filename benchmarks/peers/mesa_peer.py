"""The paper's step in Mesa: an object per agent in a continuous space, which knows each agent's nearest."""

from importlib.metadata import version

import mesa
import numpy as np
from mesa.experimental.continuous_space import ContinuousSpace, ContinuousSpaceAgent

from paper import A_MAX, A_MIN, A_START, A_STEP, MAX_SPEED, OMEGA, RHO, SEED, WALL, C, K, N, Target, measure, start


class Buoy(ContinuousSpaceAgent):
    """One agent: it decides on what all see at the beginning of a step, then all move."""

    def __init__(self, model: "Sea", space: ContinuousSpace, place: np.ndarray, max_speed: float) -> None:
        super().__init__(space, model)
        self.position = place
        self.v = np.zeros(2)
        self.wanted = np.zeros(2)
        self.a = A_START
        self.max_speed = max_speed
        self.on_target = False

    def sense(self) -> None:
        """Eq. 1."""
        offset = self.position - self.model.target.x[0]
        self.on_target = bool(offset @ offset <= RHO**2)

    def decide(self) -> None:
        """Eqs. 2 and 4, Algorithm 1."""
        others, distances = self.get_nearest_neighbors(K)
        away = self.position - np.array([other.position for other in others])
        found = [n for n, other in enumerate(others) if other.on_target]
        pull = np.zeros(2)
        if found and not self.on_target:
            pull = -C * self.model.rng.random() * away[min(found, key=distances.__getitem__)]
        if found or self.on_target:
            self.a -= A_STEP if self.a > A_MIN else 0.0
        elif self.a < A_MAX:
            self.a += A_STEP
        push = ((self.a / distances) ** 6 / distances) @ away
        self.wanted = OMEGA * self.v + pull + push
        self.wanted *= min(1.0, self.max_speed / max(float(np.hypot(*self.wanted)), 1e-99))

    def move(self) -> None:
        """Eq. 3, and the wall."""
        goal = self.position + self.wanted
        reached = np.clip(goal, -WALL, WALL)
        self.v = np.where(reached != goal, reached - self.position, self.wanted)
        self.position = reached


class Sea(mesa.Model):
    """The arena and its target."""

    def __init__(self) -> None:
        super().__init__(rng=SEED)
        self.space = ContinuousSpace([[-10, 10], [-10, 10]], torus=False, random=self.random, n_agents=N)
        self.target = Target(1, self.rng)
        for place, max_speed in zip(start(1, self.rng)[0], MAX_SPEED.tolist(), strict=True):
            Buoy(self, self.space, place, max_speed)

    def step(self) -> None:
        """One step of all."""
        self.agents.do("sense")
        self.agents.do("decide")
        self.agents.do("move")
        self.target.move()


def advance(steps: int) -> int:
    """Steps at which anybody was on target."""
    count = 0
    for _ in range(steps):
        sea.step()
        count += any(buoy.on_target for buoy in sea.agents)
    return count


if __name__ == "__main__":
    sea = Sea()
    measure(advance, 20, 1, "f64", version("mesa"))
