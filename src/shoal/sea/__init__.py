"""Read what the sea does and where it ends: currents, wind, coasts."""
