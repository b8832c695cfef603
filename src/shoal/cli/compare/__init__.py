"""shoal compare."""
