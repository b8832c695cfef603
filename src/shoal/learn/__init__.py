"""Learning: environments for libraries that learn, and a search for weights of strategies."""
