"""A fleet of real buoys, each deciding by itself, in a stand-in for the sea that moves them and keeps a record."""
