"""A record as voyages on the Earth at real times, and the files that charts and other programs read."""
