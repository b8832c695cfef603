"""What disturbs a swarm: one file per kind, which declares itself; packages may offer more (see contract.py)."""
