"""Runs on a graphics card: one block of threads per run, one thread per agent, the engine's own kernels inside."""
