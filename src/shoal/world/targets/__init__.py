"""How targets move: one file per kind, which declares itself; packages may offer more (see contract.py)."""
