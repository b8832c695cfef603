"""Studies from Python: comparisons, sweeps, checks and lists of what there is, as objects that a notebook shows."""
