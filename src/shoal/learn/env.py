"""Environments to learn in: swarms by the dozen for Gymnasium, a swarm for PettingZoo; see docs/how-to/learn.md."""

from shoal.learn.parallel_env import ParallelEnv
from shoal.learn.spec import Act, Observe
from shoal.learn.vector_env import VectorEnv

__all__ = ["Act", "Observe", "ParallelEnv", "VectorEnv"]
