"""Numba behind one door: kernels, and the phases that are compiled once for all strategies."""
