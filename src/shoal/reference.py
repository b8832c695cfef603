"""The paper in slow, plain NumPy: Algorithms 1 and 2 and Eqs. 1-8, to read, and to referee the fast engine.

Kwa, Tokic, Yue, Bouffanais, "Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking", OCEANS 2020.
Lengths are arena units (1 m), times steps (0.1 s): 1 m/s is 0.1. Its gaps: docs/paper-notes.md. Nothing is shared with
engine/step.py, which the tests hold against this file; its options are in tests/oracle.py.
"""

from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np

Array = Any  # (N,) or (N, 2), a row for each agent; or for i, the numbers of the agents that decide together: all
length: Any = partial(np.linalg.norm, axis=-1)  # of vectors


class Swarm(NamedTuple):
    """All that changes: positions x (N, 2), velocities v (N, 2), repulsion strengths a_R (N,)."""

    x: Array
    v: Array
    a: Array


class Seen(NamedTuple):
    """What a step shows: whether f_i is -1 (N,), N_i (N, k), whose position Nbest is (N,), |u_i|, phi_i (N,)."""

    on_target: Array
    neighbors: Array
    followed: Array
    fluctuations: Array
    phi: Array


@dataclass(frozen=True, eq=False)
class Paper:
    """Top speeds (N,), the degree k, and the parameters as printed, or as the notes say."""

    max_speed: Array
    k: int
    omega: float = 1.0
    c: float = 0.5
    d: float = 6.0
    a_min: float = 0.375
    a_max: float = 1.5
    a_up: float = 0.01  # delta
    a_down: float = 0.01
    rho: float = 1.0
    clamp_x: float = 8.5
    clamp_y: float = 8.5

    def algorithm_2(self, swarm: Swarm, target: Array, r: Array) -> tuple[Swarm, Seen]:
        """Algorithm 2, dynamic k-nearest network PSO with adaptive repulsion: a step. r: draws from U(0, 1), (N,)."""
        x, v, a = (np.array(each, float) for each in swarm)
        limited, near, best = np.empty_like(v), np.empty((len(x), self.k), int), np.empty(len(x), int)
        f = self.on_target(x, target)
        for i in self.turns(len(x)):
            near[i] = self.neighbors(x, i)
            best[i] = self.neighborhood_best(f, near[i], i)
            n_best = x[np.where(best[i] < 0, i, best[i])]
            v_pso = self.omega * v[i] + self.c * r[i].reshape(len(i), -1) * (n_best - x[i])  # Eq. 2
            a[i] = self.algorithm_1(a[i], f[i] | f[near[i]].any(axis=1))
            v_rep = self.repulsion(x[i], x[near[i]], a[i])
            limited[i] = self.limited(v_pso + v_rep, self.max_speed[i])
            x[i], v[i] = self.moved(x[i], limited[i])
        u = length(swarm.v - swarm.v.mean(axis=0))  # Eq. 5
        return Swarm(x, v, a), Seen(f, near, best, u, self.phi(x, limited, v, target))

    def algorithm_1(self, a: Array, tracking: Array) -> Array:
        """Algorithm 1, adaptive repulsion: a_R falls while tracking and rises while exploring; tested, then stepped."""
        fallen = np.where(a > self.a_min, a - self.a_down, a)
        return np.where(tracking, fallen, np.where(a < self.a_max, a + self.a_up, a))

    def on_target(self, x: Array, target: Array) -> Array:
        """Eq. 1: f_i = -1, here true, within rho of the target."""
        return ((x - target) ** 2).sum(axis=1) <= self.rho**2

    def turns(self, agents: int) -> Any:
        """Agents that read the swarm and move together: all at once, on the state at t."""
        return [np.arange(agents)]

    def neighbors(self, x: Array, i: Array) -> Array:
        """N_i: the k nearest other agents; of two at one distance the lower index first."""
        squares = ((x[i, None] - x) ** 2).sum(axis=-1)
        squares[np.arange(len(i)), i] = np.inf
        return np.argsort(squares, axis=1, kind="stable")[:, : self.k]

    def neighborhood_best(self, f: Array, near: Array, i: Array) -> Array:
        """Whose position Nbest is: one's own if on target, else the nearest neighbor's that is, else one's own: -1."""
        nearest = near[np.arange(len(i)), f[near].argmax(axis=1)]  # argmax: the first that is true
        return np.where(f[i], i, np.where(f[near].any(axis=1), nearest, -1))

    def repulsion(self, x: Array, others: Array, a: Array) -> Array:
        """Eq. 4: - sum over N_i of (a_R / r_ij)^d r_ij / |r_ij|; at the same place there is no direction, no push."""
        r_ij = others - x[:, None]
        apart = (distance := length(r_ij)[..., None]) > 0.0
        push = (a[:, None, None] / np.where(apart, distance, 1.0)) ** self.d * apart
        return -(push * r_ij / np.where(apart, distance, 1.0)).sum(axis=1)

    def limited(self, v: Array, max_speed: Array) -> Array:
        """Scale velocities above the top speed down to it (read literally, the printed v / v_max limits nobody)."""
        return v * np.minimum(1.0, max_speed / np.maximum(length(v), 1e-99))[:, None]

    def moved(self, x: Array, v: Array) -> tuple[Array, Array]:
        """Eq. 3, and walls: where one acts v is the displacement really made; being put inside is not motion."""
        half = np.array([self.clamp_x, self.clamp_y])
        reached = np.clip(x + v, -half, half)
        return reached, np.where(reached != x + v, reached - np.clip(x, -half, half), v)

    def phi(self, x: Array, v: Array, made: Array, target: Array) -> Array:
        """Eq. 8: cosine between heading and bearing; 0 below 10 % of the top speed or exactly on the target."""
        bearing = target - x
        counts = (length(made) >= 0.1 * self.max_speed) & ((norm := length(v) * length(bearing)) > 0.0)
        return np.where(counts, np.clip((v * bearing).sum(axis=1) / np.where(counts, norm, 1.0), -1.0, 1.0), 0.0)

    def xi(self, fluctuations: Array) -> float:
        """Eq. 7: mean |u_i| of any number of steps over the mean top speed, Eq. 6."""
        return float(np.mean(fluctuations) / np.mean(self.max_speed))
