"""The vocabulary everybody shares; of ours it imports the compiler only."""
