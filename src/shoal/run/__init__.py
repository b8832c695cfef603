"""A run: a scenario becomes arrays, the engine advances them, and what it leaves becomes a record."""
